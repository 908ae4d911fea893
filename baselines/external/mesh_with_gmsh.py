#!/usr/bin/python3
"""Gmsh: its volume mesher between the surfaces of surface_net.py, which it keeps."""
import numpy
import peer
import surface_net

ALGORITHMS = {"delaunay": 1, "hxt": 10}


def add_surfaces(gmsh, net):
    """A discrete surface for each pair of regions; gives those of each region."""
    surfaces, pairs = {}, numpy.unique(numpy.sort(net.sides, axis=1), axis=0)
    sorted_sides = numpy.sort(net.sides, axis=1)
    for tag, pair in enumerate(pairs, 1):
        gmsh.model.addDiscreteEntity(2, tag)
        for region in pair:
            surfaces.setdefault(int(region), []).append(tag)
        if tag == 1:
            gmsh.model.mesh.addNodes(2, 1, numpy.arange(1, len(net.points) + 1), net.points.ravel())
        triangles = net.triangles[(sorted_sides == pair).all(axis=1)] + 1
        gmsh.model.mesh.addElementsByType(tag, 2, [], triangles.ravel())
    return surfaces


def fill(gmsh, net):
    """Volumes between the surfaces, but for holes; gives the regions in order of the volumes."""
    surfaces = add_surfaces(gmsh, net)
    gmsh.model.mesh.reclassifyNodes()
    regions = [region for region in range(1, len(net.materials)) if net.materials[region] > 0 and region in surfaces]
    for tag, region in enumerate(regions, 1):
        gmsh.model.geo.addSurfaceLoop(surfaces[region], tag)
        gmsh.model.geo.addVolume([tag], tag)
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(3)
    return regions


def set_options(gmsh, options):
    for name, value in {"General.Terminal": 0, "General.NumThreads": options.threads, "Mesh.Optimize": 1,
                        "Mesh.Algorithm3D": ALGORITHMS[options.algorithm], "Mesh.CharacteristicLengthFromPoints": 0,
                        "Mesh.CharacteristicLengthExtendFromBoundary": 1,
                        "Mesh.CharacteristicLengthMax": options.growth * options.size}.items():
        gmsh.option.setNumber(name, value)


def mesh(volume, options, stages):
    import gmsh

    net = surface_net.surface_net(volume, options.size)
    stages.end("surface")
    gmsh.initialize()
    set_options(gmsh, options)
    regions = fill(gmsh, net)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    points = numpy.zeros((int(tags.max()) + 1, 3))
    points[tags.astype(int)] = coordinates.reshape(-1, 3)
    tets, materials = [numpy.zeros((0, 4), int)], [numpy.zeros(0, int)]
    for tag, region in enumerate(regions, 1):
        _, nodes = gmsh.model.mesh.getElementsByType(4, tag)
        tets.append(nodes.astype(int).reshape(-1, 4))
        materials.append(numpy.full(len(tets[-1]), net.materials[region]))
    stages.end("volume")
    return peer.TetMesh(points, numpy.concatenate(tets), numpy.concatenate(materials))


def versions():
    import gmsh

    return {"gmsh": gmsh.option.getString("General.Version")}


def algorithm(text):
    if text not in ALGORITHMS:
        raise peer.argparse.ArgumentTypeError(f"'{text}' is none of {', '.join(ALGORITHMS)}")
    return text


peer.run("gmsh", {
    "size": (peer.positive, 3.0, "edge of the grid that the surfaces are made on, mm"),
    "growth": (peer.positive, 3.0, "largest edges inside over that"),
    "algorithm": (algorithm, "delaunay", "delaunay or hxt")}, mesh, modules={"gmsh": "python3-gmsh"}, versions=versions)
