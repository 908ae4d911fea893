#!/usr/bin/python3
"""SimNIBS' meshmesh, whose options and settings are those of its own help and of charm.ini. Not run where it was written.

It takes a NIfTI label image and the section [mesh] of a settings file, and writes Gmsh's .msh in physical mm, RAS, whose tets have the
label as tag; its surfaces have tags from 1001 on and are left out. The skin, which only a head has, is switched off.
"""
import os
import tempfile

import peer
from tool_files import run_tool

SETTINGS = """[mesh]
elem_sizes = {{"standard": {{"range": [{smallest}, {largest}], "slope": {slope}}}}}
smooth_size_field = 2
skin_facet_size = false
facet_distances = {{"standard": {{"range": [0.1, 3], "slope": 0.5}}}}
optimize = false
remove_spikes = true
skin_tag = false
hierarchy = false
smooth_steps = 10
skin_care = 0
"""


def write_labels(volume, path):
    """The materials, whose numbers fit, in index mm: the adapter itself turns the mesh into LPS."""
    import nibabel
    import numpy

    image = nibabel.Nifti1Image(volume.materials.astype(numpy.uint16), numpy.diag([*volume.spacing_mm, 1]))
    image.set_qform(image.affine, code=1)
    nibabel.save(image, path)


def mesh(volume, options, stages):
    import meshio
    import numpy

    with tempfile.TemporaryDirectory() as folder:
        write_labels(volume, os.path.join(folder, "labels.nii.gz"))
        with open(os.path.join(folder, "settings.ini"), "w", encoding="utf-8") as file:
            file.write(SETTINGS.format(smallest=min(1, options.cell_size), largest=options.cell_size, slope=options.slope))
        run_tool(["meshmesh", os.path.join(folder, "labels.nii.gz"), os.path.join(folder, "made.msh"), "--usesettings",
                  os.path.join(folder, "settings.ini"), "--nthreads", options.threads])
        stages.end("meshmesh")
        made = meshio.read(os.path.join(folder, "made.msh"))
    blocks = [(block.data, tags) for block, tags in zip(made.cells, made.cell_data["gmsh:physical"]) if block.type == "tetra"]
    tets, materials = (numpy.concatenate(parts) for parts in zip(*blocks))
    return peer.TetMesh(made.points, tets, materials.astype(int))


peer.run("simnibs", {
    "cell-size": (peer.positive, 5.0, "largest size of elements, mm"),
    "slope": (peer.positive, 1.0, "size of elements over the thickness of the label there")}, mesh,
    programs={"meshmesh": "install SimNIBS 4 (simnibs.github.io)"})
