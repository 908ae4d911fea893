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
order      {order} [1]
threads    number of threads of the whole process [0: all cores]
progress   is called with the name of a step and the fraction done; the work ends with Cancelled when it returns False, and
           with what it raises. Ctrl-C raises KeyboardInterrupt at once; what it interrupts ends at its next step, unheard [None]

{choices}

Options, by group; where a default is not one for all presets, it stands after the preset's name, for voxels of 1 mm:
{options}

Returns a Mesh, of order 2 a QuadraticMesh, with `warnings` (list of str, also given to the warnings module as MeshWarning),
`seconds` (dict by stage) and `names` and `colours` (dicts by label).
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
names, colours  dicts by label, of texts and of red, green, blue; files that are written have them, files that are read give them
write(path, *, format=None, split_interfaces=False, coordinates="LPS")
                writes a file of one of mesh_format_names(), by its extension or `format`; coordinates may be RAS.
                split_interfaces: {split}
Mesh.read(path, *, label_array="")
                reads what the command reads
to_meshio(), Mesh.from_meshio(mesh, label="label")

The arrays are views of the mesh's memory and keep it alive.
"""

_QUADRATIC = """A mesh of labelled tets of ten nodes, in physical LPS mm: mesh(array, order=2).

points   float64; the first `corners` of them are the tets' corners, the others lie on edges
tets     uint32, ten nodes for each: corners, then the nodes on the edges 01, 12, 20, 03, 13, 23, as VTK and meshio have them
labels, names, colours, write(), to_meshio()
         as of Mesh
linear() the Mesh of the straight tets between the corners
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


def choices_text(rows):
    lines = [rows[0]["group"]]
    for row in rows:
        text = f"{row['keyword']}: {row['text'].replace(row['flag'], row['keyword'])}"
        for other in rows:
            text = text.replace(other["flag"], other["keyword"])
        kinds = {"labels": "; a label or a sequence of labels", "names": "; its path, or a dict from labels to names"}
        text += f"{kinds.get(row['kind'], '')} [{row['default']}]"
        lines += textwrap.wrap(text, 120, initial_indent="  ", subsequent_indent="      ")
    return "\n".join(lines)


def add_keywords(function, rows):
    signature = inspect.signature(function)
    parameters = [p for p in signature.parameters.values() if p.kind is not inspect.Parameter.VAR_KEYWORD]
    parameters += [inspect.Parameter(row["keyword"], inspect.Parameter.KEYWORD_ONLY, default=None) for row in rows]
    function.__signature__ = signature.replace(parameters=parameters)


def document(mesh, others, classes, core):
    rows, choices, presets = core.option_rows(), core.input_rows(), core.preset_names()
    mesh.__doc__ = _MESH.format(presets=" or ".join(presets), preset=presets[0], order=core.order_text,
                                choices=choices_text(choices), options=options_text(rows))
    add_keywords(mesh, choices + rows)
    for other in others:
        other.__doc__ = other.__doc__.format(keywords=", ".join(row["keyword"] for row in choices))
        add_keywords(other, choices)
    classes[0].__doc__ = _CLASS.format(split=core.split_interfaces_text)
    classes[1].__doc__ = _QUADRATIC
