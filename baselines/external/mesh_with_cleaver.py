#!/usr/bin/python3
"""CLEAVER 2 by cleaver-cli, whose options are those of its manual (cleaver.readthedocs.io). Not run where it was written.

It takes the image as NRRD with its spacing alone, so that its coordinates are index mm, and writes TetGen's .node and .ele with the
material of each tet behind its corners, counted from 0 in the order of the label values; background is a material too.
"""
import os
import tempfile

import peer
from tool_files import read_rows, run_tool, write_nrrd


def mesh(volume, options, stages):
    import numpy

    if sorted(volume.values) != volume.values:
        raise peer.BadInput("the image has labels below 0; cleaver-cli takes them above")
    with tempfile.TemporaryDirectory() as folder:
        write_nrrd(os.path.join(folder, "labels.nrrd"), volume.materials, volume.spacing_mm)
        run_tool(["cleaver-cli", "--segmentation", "--input_files", os.path.join(folder, "labels.nrrd"),
                  "--sampling_rate", options.sampling_rate, "--feature_scaling", options.feature_scaling,
                  "--lipschitz", options.lipschitz, "--blend_sigma", options.blend_sigma, "--fix_tet_windup",
                  "--strip_exterior", "--output_format", "tetgen", "--output_path", folder + "/", "--output_name", "made"])
        stages.end("cleaver-cli")
        nodes, cells = (read_rows(os.path.join(folder, "made." + kind)) for kind in ("node", "ele"))
    first = int(nodes[0, 0])
    materials = cells[:, 5].astype(int)
    if materials.min() < 0 or materials.max() >= len(volume.values):
        raise peer.Failed(f"cleaver-cli's mesh has materials {materials.min()} to {materials.max()}, the image 0 to {len(volume.values) - 1}")
    inside = materials > 0
    return peer.TetMesh(nodes[:, 1:4], cells[inside, 1:5].astype(int) - first, materials[inside].astype(numpy.int64))


peer.run("cleaver-cli", {
    "sampling-rate": (peer.positive, 1.0, "samples of the volume over its voxels"),
    "feature-scaling": (peer.positive, 1.0, "more is coarser"),
    "lipschitz": (peer.positive, 0.2, "largest change of the element size over a length"),
    "blend-sigma": (float, 1.0, "by which labels are blurred, voxels")}, mesh,
    programs={"cleaver-cli": "build it from github.com/SCIInstitute/Cleaver and put it there"})
