import matplotlib.pyplot as pyplot
import numpy as np

import cbc3d

k, j, i = np.mgrid[:24, :32, :40]
labels = ((i - 20) ** 2 + (j - 16) ** 2 + 1.4 * (k - 12) ** 2 < 144).astype(np.uint8)
labels[(i > 20) & (labels == 1)] = 2
mesh = cbc3d.mesh(labels, spacing=(1, 1, 1.2), names={1: "left half", 2: "right half"}, order=2)
mesh.to_meshio().write("halves.vtu")
pyplot.plot(*mesh.points[np.abs(mesh.points[:, 2] - 14) < 1][:, :2].T, ".")
pyplot.savefig("halves.png")
