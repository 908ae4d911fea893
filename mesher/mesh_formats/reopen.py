"""Opens a mesh file with meshio and says what is in it: reopen.py FILE, one line of JSON.

points; cells by meshio's type; how far edge nodes of quadratic tets are from the middle at most; volume of the tets by label (of whatever array or set the format has); names of groups.
"""
import importlib.util
import json
import sys
import types

import meshio
import numpy as np

if importlib.util.find_spec("h5py") is None:
    sys.modules["h5py"] = types.ModuleType("h5py")  # meshio imports it for XDMF's text too, which does not need it

mesh = meshio.read(sys.argv[1])
kinds = {}
volumes = {}
bent = 0.0
labels = {}
for key in ("label", "gmsh:physical", "medit:ref"):
    if key in mesh.cell_data:
        labels = {i: np.asarray(a).ravel() for i, a in enumerate(mesh.cell_data[key])}
for i, block in enumerate(mesh.cells):
    kinds[block.type] = kinds.get(block.type, 0) + len(block.data)
    if block.type in ("tetra", "tetra10"):
        p = mesh.points[np.asarray(block.data)[:, :4]]
        six = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0])
        if block.type == "tetra10":
            q = mesh.points[np.asarray(block.data)]
            for n, (a, b) in enumerate([(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]):
                bent = max(bent, float(np.abs(q[:, 4 + n] - (q[:, a] + q[:, b]) / 2).max()))
        of = labels.get(i)
        for label in [0] if of is None else sorted(set(of.tolist())):
            chosen = six if of is None else six[of == label]
            volumes[str(label)] = volumes.get(str(label), 0) + float(chosen.sum() / 6)
names = {k: [int(x) for x in v] for k, v in mesh.field_data.items()} if mesh.field_data else {}
sets = {}
for k, v in (getattr(mesh, "cell_sets", None) or {}).items():
    sets[k] = int(sum(len(x) for x in v if x is not None))
print(json.dumps({"points": len(mesh.points), "cells": kinds, "volumes": volumes, "names": names, "bent": bent, "sets": sets}))
