"""Docstrings and signatures from the table of options."""
import inspect
import textwrap

_MESH = """Meshes an array of labels.

array      integers or booleans of three axes; 0 is background. No copy is made of an array whose i is fastest in memory: C order
           for array[k, j, i], Fortran order for array[i, j, k]
spacing    distance of voxel centres along i, j and k, mm, whatever `axes` says
origin     physical position of the centre of voxel (0, 0, 0), LPS mm
direction  3 x 3 or 9 numbers, row by row; its columns are the axes i, j, k in physical space [None: the identity]
axes       "kji": array[k, j, i], as SimpleITK's GetArrayFromImage gives it; "ijk": array[i, j, k], as nibabel's [kji]
preset     {presets} [{preset}]
many_labels
           take an array that looks grey or like noise [False]
threads    number of threads of the whole process [0: all cores]
progress   is called with the name of a step and the fraction done; the work ends with Cancelled when it returns False, and
           with what it raises. Ctrl-C ends the work between two steps [None]

Options, by group; where a default is not one for all presets, it stands after the preset's name, for voxels of 1 mm:
{options}

Returns a Mesh with `warnings` (list of str, also given to the warnings module as MeshWarning) and `seconds` (dict by stage).
Raises InputError, JobError or Cancelled.
"""

_CLASS = """A volume mesh of labelled tets, pyramids, wedges and hexes, in physical LPS mm.

Mesh(points, tets, labels, *, pyramids=None, wedges=None, hexes=None) makes one from arrays, which are copied; `labels` has one
label for each cell: tets, pyramids, wedges, hexes.

points          float64, one row of three coordinates for each point; may be written to
tets, pyramids, wedges, hexes
                uint32, one row of nodes for each cell; read only. Node orders are those of VTK, but that of a wedge is
                Verdict's: its triangle 0, 1, 2 has its normal towards the triangle 3, 4, 5
labels          int32, for all cells in that order; tet_labels, pyramid_labels, wedge_labels and hex_labels by kind
write(path)     writes .vtu, .vtk or .msh
Mesh.read(path) reads them
to_meshio(), Mesh.from_meshio(mesh, label="label")

The arrays are views of the mesh's memory and keep it alive.
"""


def defaults_text(row):
    values = set(row["defaults"].values())
    if len(values) == 1 and row["group"] != "Improvement":
        return values.pop()
    return ", ".join(f"{preset}: {value}" for preset, value in row["defaults"].items())


def option_text(row):
    text = row["text"]
    if row["kind"] in ("float", "int", "label_numbers"):
        text += f"; {row['range']}" + (f" {row['unit']}" if row["unit"] else "")
    if row["kind"] == "choice":
        text += f"; {row['range']}"
    if row["kind"] == "label_numbers":
        text += "; a dict from labels to numbers"
    return f"{text} [{defaults_text(row)}]"


def options_text(rows):
    lines, group = [], None
    for row in rows:
        if row["group"] != group:
            group = row["group"]
            lines += ["", group]
        lines += textwrap.wrap(f"{row['keyword']}: {option_text(row)}", 120, initial_indent="  ", subsequent_indent="      ")
    return "\n".join(lines)


def document(mesh, mesh_class, rows, presets):
    mesh.__doc__ = _MESH.format(presets=" or ".join(presets), preset=presets[0], options=options_text(rows))
    mesh_class.__doc__ = _CLASS
    signature = inspect.signature(mesh)
    parameters = [p for p in signature.parameters.values() if p.kind is not inspect.Parameter.VAR_KEYWORD]
    parameters += [inspect.Parameter(row["keyword"], inspect.Parameter.KEYWORD_ONLY, default=None) for row in rows]
    mesh.__signature__ = signature.replace(parameters=parameters)
