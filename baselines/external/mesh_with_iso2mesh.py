#!/usr/bin/python3
"""iso2mesh's cgalv2m in GNU Octave, whose parameters are those of its own help. Not run where it was written.

It takes labels of one byte and knows no spacing: sizes are in voxels of the shortest edge, and the mesh is stretched afterwards.
Octave has to find iso2mesh, by its startup file or as Debian's octave-iso2mesh.
"""
import os
import subprocess
import tempfile

import peer
from tool_files import run_tool

SCRIPT = """
file = fopen("{folder}/labels.raw"); volume = reshape(fread(file, Inf, "uint8=>uint8"), {size}); fclose(file);
choice = struct("radbound", {size_voxels:.17g}, "angbound", 30, "surfapprox", {distance:.17g}, "reratio", 3);
[node, element] = cgalv2m(volume, choice, {largest_volume:.17g});
file = fopen("{folder}/node", "w"); fwrite(file, node(:, 1:3).', "double"); fclose(file);
file = fopen("{folder}/element", "w"); fwrite(file, element(:, 1:5).', "double"); fclose(file);
"""


def mesh(volume, options, stages):
    import numpy

    if len(volume.values) > 256:
        raise peer.BadInput(f"the image has {len(volume.values) - 1} labels; iso2mesh takes 255 here")
    size = options.cell_size / volume.spacing_mm.min()
    with tempfile.TemporaryDirectory() as folder:
        volume.materials.astype(numpy.uint8).ravel(order="F").tofile(os.path.join(folder, "labels.raw"))
        run_tool(["octave-cli", "--quiet", "--eval", SCRIPT.format(
            folder=folder, size=list(volume.materials.shape), size_voxels=size,
            distance=options.facet_distance_share * size, largest_volume=size**3 / 6)])
        stages.end("cgalv2m")
        nodes = numpy.fromfile(os.path.join(folder, "node")).reshape(-1, 3)
        cells = numpy.fromfile(os.path.join(folder, "element")).reshape(-1, 5).astype(int)
    return peer.TetMesh(nodes * volume.spacing_mm, cells[:, :4] - 1, cells[:, 4])


def has_iso2mesh():
    """Octave is asked only where it is there."""
    asked = subprocess.run(["octave-cli", "--quiet", "--eval", "exit(exist('cgalv2m') != 2)"], capture_output=True, check=False)
    if asked.returncode != 0:
        raise peer.BadInput("Octave does not find iso2mesh; install it (iso2mesh.sf.net, octave-iso2mesh) and add it to Octave's path")


peer.run("iso2mesh", {
    "cell-size": (peer.positive, 2.5, "largest radius of surface balls, and the volume of tets of that edge, mm"),
    "facet-distance-share": (peer.positive, 0.25, "largest distance of facets from the boundary over the cell size")}, mesh,
    programs={"octave-cli": "install octave, and iso2mesh for it"}, check=has_iso2mesh)
