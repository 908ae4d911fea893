#!/usr/bin/python3
"""pygalmesh: CGAL's Mesh_3 on the label image itself."""
import peer


def materials_of(volume, points, tets, references):
    """References are numbered anew where a label was lost, so each stands for what most centroids of its tets lie in."""
    import numpy

    places = numpy.rint(points[tets].mean(axis=1) / volume.spacing_mm).astype(int)
    places = numpy.clip(places, 0, numpy.array(volume.materials.shape) - 1)
    found, materials = volume.materials[tuple(places.T)], numpy.zeros(len(tets), int)
    for reference in numpy.unique(references):
        counts = numpy.bincount(found[references == reference], minlength=len(volume.values))
        materials[references == reference] = 1 + counts[1:].argmax()
    return materials


def mesh(volume, options, stages):
    import numpy
    import pygalmesh

    if len(volume.values) > 256:
        raise peer.BadInput(f"the image has {len(volume.values) - 1} labels; pygalmesh takes 255 here")
    made = pygalmesh.generate_from_array(
        volume.materials.astype(numpy.uint8), tuple(float(s) for s in volume.spacing_mm), verbose=False,
        max_cell_circumradius=options.cell_size, max_radius_surface_delaunay_ball=options.cell_size,
        max_facet_distance=options.facet_distance_share * options.cell_size, min_facet_angle=30,
        max_circumradius_edge_ratio=3, seed=options.seed)
    stages.end("mesh")
    cells = [(block.data, data) for block, data in zip(made.cells, made.cell_data["medit:ref"]) if block.type == "tetra"]
    tets = numpy.concatenate([block for block, _ in cells])
    references = numpy.concatenate([data for _, data in cells]).astype(int)
    return peer.TetMesh(made.points, tets, materials_of(volume, made.points, tets, references))


def versions():
    import pygalmesh

    return {"pygalmesh": pygalmesh.__version__}


peer.run("pygalmesh", {
    "cell-size": (peer.positive, 2.5, "largest circumradius of tets and of surface balls, mm"),
    "facet-distance-share": (peer.positive, 0.25, "largest distance of facets from the boundary over the cell size"),
    "seed": (int, 0, "seed")}, mesh, modules={"pygalmesh": "python3-pygalmesh"}, versions=versions)
