#!/usr/bin/python3
"""Netgen: its volume mesher between the surfaces of surface_net.py, which it keeps."""
import numpy
import peer
import surface_net


def front_of(net):
    """Netgen's mesh of surfaces alone; its domains are the materials."""
    from netgen import meshing

    front = meshing.Mesh()
    front.dim = 3
    points = [front.Add(meshing.MeshPoint(meshing.Pnt(*point))) for point in net.points.tolist()]
    sides = net.materials[net.sides]
    faces = {}
    for triangle, (behind, ahead) in zip(net.triangles.tolist(), sides.tolist()):
        if (behind, ahead) not in faces:
            number = len(faces) + 1
            faces[behind, ahead] = front.Add(
                meshing.FaceDescriptor(surfnr=number, domin=behind, domout=ahead, bc=number))
        front.Add(meshing.Element2D(faces[behind, ahead], [points[corner] for corner in triangle]))
    return front


def mesh(volume, options, stages):
    from netgen import meshing

    net = surface_net.surface_net(volume, options.size)
    stages.end("surface")
    meshing.SetMessageImportance(0)
    front = front_of(net)
    front.GenerateVolumeMesh(mp=meshing.MeshingParameters(
        maxh=options.growth * options.size, grading=options.grading, optsteps3d=options.steps))
    stages.end("volume")
    points = numpy.array([point.p for point in front.Points()])
    elements = [([vertex.nr - 1 for vertex in element.vertices], element.index) for element in front.Elements3D()]
    tets = numpy.array([nodes for nodes, _ in elements], int).reshape(-1, 4)
    return peer.TetMesh(points, tets, numpy.array([index for _, index in elements], int))


peer.run("netgen", {
    "size": (peer.positive, 3.0, "edge of the grid that the surfaces are made on, mm"),
    "growth": (peer.positive, 3.0, "largest edges inside over that"),
    "grading": (peer.positive, 0.3, "how fast edges may grow"),
    "steps": (int, 3, "rounds of improvement")}, mesh, modules={"netgen": "python3-netgen"})
