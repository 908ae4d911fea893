# %% [markdown]
# From a numpy array to a mesh, to meshio, to a finite-element solve: cells as of a notebook, which run in the tests too.
# Usage: python3 mesh_and_solve.py [FOLDER]

# %% An organ with a lesion, as a segmentation would have it: labels[k, j, i], 0 is background.
import pathlib
import sys

import numpy as np

import cbc3d

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
folder.mkdir(parents=True, exist_ok=True)
spacing = (1.0, 1.0, 1.5)
k, j, i = np.mgrid[:32, :44, :48]
x, y, z = i * spacing[0], j * spacing[1], k * spacing[2]
labels = np.zeros(k.shape, np.uint8)
labels[((x - 24) / 18) ** 2 + ((y - 22) / 15) ** 2 + ((z - 24) / 16) ** 2 < 1] = 1
labels[(x - 30) ** 2 + (y - 22) ** 2 + (z - 24) ** 2 < 36] = 2

# %% The mesh, and what it is worth.
mesh = cbc3d.mesh(labels, spacing, progress=lambda stage, done: print(f"{100 * done:3.0f} % {stage}"))
found = cbc3d.evaluate(mesh, labels, spacing)
print(mesh)
print(f"smallest dihedral angle {found['quality']['min_dihedral_deg']:.1f} degrees, "
      f"Hausdorff distance {found['fidelity']['hausdorff_mm']:.2f} mm")
assert found["quality"]["min_dihedral_deg"] > 19.9
mesh.write(folder / "organ.vtu")

# %% To meshio, which writes many more formats.
try:
    import meshio  # noqa: F401
except ImportError:
    print("meshio is not installed; no Medit file is written")
else:
    mesh.to_meshio().write(folder / "organ.mesh")

# %% Heat in the lesion, with linear elements: -div(c grad u) = f, u = 0 on the outside, c = 2 in the lesion.
try:
    import scipy.sparse
    import scipy.sparse.linalg
except ImportError:
    print("scipy is not installed; nothing is solved")
    sys.exit(0)

tets = mesh.tets.astype(np.int64)
corners = mesh.points[tets]
edges = corners[:, 1:] - corners[:, :1]
volumes = np.linalg.det(edges) / 6
inverse = np.linalg.inv(edges)  # its columns are the gradients of the last three shape functions
gradients = np.concatenate([-inverse.sum(axis=2, keepdims=True), inverse], axis=2)
conductivity = np.where(mesh.labels == 2, 2.0, 1.0)
stiffness = np.einsum("cdi,cdj,c->cij", gradients, gradients, volumes * conductivity)
rows, columns = np.repeat(tets, 4, axis=1).ravel(), np.tile(tets, (1, 4)).ravel()
matrix = scipy.sparse.coo_matrix((stiffness.ravel(), (rows, columns))).tocsr()
source = np.bincount(tets.ravel(), np.repeat(volumes * (mesh.labels == 2) / 4, 4), len(mesh.points))

facets = np.sort(tets[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3), axis=1)
unique, counts = np.unique(facets, axis=0, return_counts=True)
inner = np.setdiff1d(np.unique(tets), unique[counts == 1])
u = np.zeros(len(mesh.points))
u[inner] = scipy.sparse.linalg.spsolve(matrix[inner][:, inner], source[inner])
print(f"{len(inner)} unknowns, temperature up to {u.max():.3f}")
# Energy balance, and the maximum principle of a source that is nowhere negative.
assert abs(u @ (matrix @ u) - u @ source) < 1e-9 * abs(u @ source)
assert u.max() > 0 and mesh.points[u.argmax()][0] > 24

# %% A picture of the nodes near the middle plane.
try:
    import matplotlib
except ImportError:
    print("matplotlib is not installed; no picture is drawn")
else:
    matplotlib.use("Agg")
    from matplotlib import pyplot

    near = np.abs(mesh.points[:, 2] - 24) < 1.5
    pyplot.figure(figsize=(5, 4))
    pyplot.tricontourf(mesh.points[near, 0], mesh.points[near, 1], u[near], 12)
    pyplot.axis("equal")
    pyplot.savefig(folder / "temperature.png", dpi=80)
