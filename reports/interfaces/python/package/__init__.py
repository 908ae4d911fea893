"""CBC3D: from an array of labels to a tetrahedral or mixed mesh.

    import cbc3d
    mesh = cbc3d.mesh(labels, spacing=(0.9, 0.9, 1.5))     # labels[k, j, i]: integers, 0 is background
    mesh.points, mesh.tets, mesh.labels                    # numpy arrays, without copies
    cbc3d.evaluate(mesh, labels, spacing=(0.9, 0.9, 1.5))  # quality, distances, topology
    mesh.write("mesh.vtu")

Lengths are mm, coordinates physical LPS mm as in ITK and SimpleITK; `frame_of_affine` turns an affine of nibabel into such a
frame. The same array and options give the same mesh at any number of threads.
"""
import json as _json
import operator as _operator
import os as _os
import warnings as _warnings

import numpy as _np


def _load_core():
    """OpenMP reads how its waiting threads behave when it is loaded: they spin briefly and then sleep, unless that is set."""
    chosen = {"OMP_WAIT_POLICY": "passive", "GOMP_SPINCOUNT": "1000"}
    if any(name in _os.environ for name in chosen):
        chosen = {}
    _os.environ.update(chosen)
    try:
        from . import _core
        return _core
    finally:
        for name in chosen:
            del _os.environ[name]


_core = _load_core()

from . import _documentation  # noqa: E402: what stands above comes first
from ._core import Cancelled, Error, InputError, JobError, Mesh, QuadraticMesh  # noqa: E402
from ._frames import frame_of_affine  # noqa: E402

__version__ = _core.__version__
__all__ = ["Cancelled", "Error", "InputError", "JobError", "Mesh", "MeshWarning", "QuadraticMesh", "evaluate", "frame_of_affine",
           "improve", "input_rows", "mesh", "mesh_format_names", "option_rows", "preset_names", "read"]


class MeshWarning(UserWarning):
    """What a mesh lacks of its image, and what was taken for granted."""


_IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def _refusal(text, parameter):
    error = InputError(text)
    error.parameter = parameter
    return error


def _numbers(values, count, name):
    try:
        numbers = tuple(float(v) for v in _np.asarray(values, dtype=float).reshape(-1))
    except (TypeError, ValueError):
        numbers = ()
    if len(numbers) != count:
        raise _refusal(f"{name} {values!r}: give {count} numbers", name)
    return numbers


def _chosen_volume(array, axes, volume):
    """One volume of an array of four axes: the first axis counts them with "kji", the last with "ijk"."""
    if volume is None:
        return array
    count = array.shape[0 if axes == "kji" else -1] if array.ndim == 4 else 0
    try:
        volume = _operator.index(volume)
    except TypeError:
        volume = -1
    if not 0 <= volume < count:
        raise _refusal(f"volume: the label array has {array.ndim} axes; of an array of four give a whole number below the number "
                       f"of its volumes{f', {count}' if count else ''}", "volume")
    return array[volume] if axes == "kji" else array[..., volume]


def _placed(array, spacing, origin, direction, axes, volume):
    array = _chosen_volume(_np.asarray(array), axes, volume)
    if not array.dtype.isnative:
        array = array.astype(array.dtype.newbyteorder("="))
    return (array, _numbers(spacing, 3, "spacing"), _numbers(origin, 3, "origin"),
            _IDENTITY if direction is None else _numbers(direction, 9, "direction"), axes)


def _warned(mesh):
    for text in mesh.warnings:
        _warnings.warn(text, MeshWarning, stacklevel=3)
    return mesh


def mesh(array, spacing=(1.0, 1.0, 1.0), origin=(0.0, 0.0, 0.0), direction=None, *, preset="quality", axes="kji", order=1,
         threads=0, progress=None, **options):
    placed = _placed(array, spacing, origin, direction, axes, options.pop("volume", None))
    return _warned(_core.mesh_array(placed, preset, order, threads, options, progress))


def improve(mesh, array=None, spacing=(1.0, 1.0, 1.0), origin=(0.0, 0.0, 0.0), direction=None, *, axes="kji",
            min_dihedral=None, max_deviation=0.0, decimate=False, threads=0, progress=None, **choices):
    """Improves a mesh of labelled tets, towards the boundaries of the array that it was made from or towards its own.

    mesh           a Mesh of tets; it stays as it is
    array, spacing, origin, direction, axes
                   as for mesh(); without an array the mesh keeps its own surfaces
    min_dihedral   goal of the smallest dihedral angle, degrees [20]
    max_deviation  every boundary voxel, or without an array every surface vertex, keeps a surface vertex within this distance,
                   mm [0: as the mesh has it, at most 0.9 voxel diagonals, or half the mean surface edge]
    decimate       fit the surfaces to the boundary and thin the mesh out as well [False: repair what is below the goal]
    threads, progress
                   as for mesh()
    {keywords}
                   choices about the array, as for mesh(); names that it does not give are those of the mesh

    Returns a new Mesh with `warnings` and `seconds`.
    """
    volume = choices.pop("volume", None)
    placed = None if array is None else _placed(array, spacing, origin, direction, axes, volume)
    return _warned(_core.improve_mesh(mesh, placed, min_dihedral, max_deviation, decimate, threads, choices, progress))


def evaluate(mesh, array, spacing=(1.0, 1.0, 1.0), origin=(0.0, 0.0, 0.0), direction=None, *, axes="kji", smooth=True,
             certified=True, tolerance_mm=0.0, threads=0, progress=None, **choices):
    """Judges a mesh against the array that it was made from.

    array, spacing, origin, direction, axes, threads, progress
                  as for mesh()
    smooth        also distances to, and smoothness against, the smooth surfaces of the labels
    certified     certified bounds of the distances between surfaces
    tolerance_mm  upper less lower bound; 0: 2 % of the smallest voxel spacing
    {keywords}
                  choices about the array, as for mesh(); names that it does not give are those of the mesh

    Returns a dict with the keys of `cbc3d-bench evaluate --json`: counts, quality, fidelity, topology and others. A figure that
    the mesh cannot have is None.
    """
    placed = _placed(array, spacing, origin, direction, axes, choices.pop("volume", None))
    return _json.loads(_core.evaluate_mesh(mesh, placed, smooth, certified, tolerance_mm, threads, choices, progress))


def read(path, *, label_array=""):
    """Reads a mesh from a file that cbc3d writes, or one like it; `label_array` names the cell array with the labels."""
    return Mesh.read(path, label_array=label_array)


def input_rows():
    """The choices about the array, one dict each: keyword, flag, group, kind, text, default."""
    return _core.input_rows()


def option_rows():
    """The options of mesh(), one dict each: keyword, flag, group, kind, unit, range, choices, text, defaults by preset."""
    return _core.option_rows()


def preset_names():
    """The names of the presets; the first is the default."""
    return _core.preset_names()


def mesh_format_names():
    """The formats of write(): an extension stands for the first of its own."""
    return _core.mesh_format_names()


# VTK's wedge, which meshio has, turns the other way than Verdict's, which a Mesh has.
_VTK_WEDGE = [0, 2, 1, 3, 5, 4]
_MESHIO_KINDS = (("tetra", "tets", None), ("pyramid", "pyramids", None), ("wedge", "wedges", _VTK_WEDGE),
                 ("hexahedron", "hexes", None))


def _to_meshio(self):
    """The mesh as a meshio.Mesh: cells by kind, their labels as the cell data "label". Tets share the mesh's memory."""
    import meshio

    cells, labels = [], []
    for kind, name, order in _MESHIO_KINDS:
        nodes = getattr(self, name)
        if len(nodes):
            cells.append((kind, nodes if order is None else nodes[:, order]))
            labels.append(getattr(self, {"tets": "tet_labels", "pyramids": "pyramid_labels", "wedges": "wedge_labels",
                                         "hexes": "hex_labels"}[name]))
    return meshio.Mesh(self.points, cells, cell_data={"label": labels})


def _from_meshio(cls, mesh, label="label"):
    """A Mesh of a meshio.Mesh's volume cells; the cell data `label` are their labels. Other cells are left out."""
    nodes = {name: [] for _, name, _ in _MESHIO_KINDS}
    labels = {name: [] for _, name, _ in _MESHIO_KINDS}
    if label not in mesh.cell_data:
        raise InputError(f"label {label!r}: the mesh has no such cell data; it has {', '.join(mesh.cell_data) or 'none'}")
    for block, values in zip(mesh.cells, mesh.cell_data[label]):
        for kind, name, order in _MESHIO_KINDS:
            if block.type == kind:
                nodes[name].append(block.data if order is None else block.data[:, order])
                labels[name].append(_np.asarray(values))
    joined = {name: _np.concatenate(blocks) for name, blocks in nodes.items() if blocks}
    all_labels = [values for _, name, _ in _MESHIO_KINDS for values in labels[name]]
    return cls(mesh.points, joined.pop("tets", None), _np.concatenate(all_labels) if all_labels else [], **joined)


def _quadratic_to_meshio(self):
    """The mesh as a meshio.Mesh of "tetra10", the labels as the cell data "label"; it shares the mesh's memory."""
    import meshio

    return meshio.Mesh(self.points, [("tetra10", self.tets)], cell_data={"label": [self.labels]})


Mesh.to_meshio = _to_meshio
QuadraticMesh.to_meshio = _quadratic_to_meshio
Mesh.from_meshio = classmethod(_from_meshio)
_documentation.document(mesh, (improve, evaluate), (Mesh, QuadraticMesh), _core)
