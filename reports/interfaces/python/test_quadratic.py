"""Tets of ten nodes: the session of ten lines, and a solve with quadratic elements that have a linear field exactly."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from testing_support import SPACING, needs, numpy, two_balls

import cbc3d

meshio, sparse, solvers = needs("meshio", "scipy.sparse", "scipy.sparse.linalg")
SESSION = pathlib.Path(__file__).parent / "examples" / "session.py"
# Of the rule of degree 3 with five points, which integrates the gradients of curved elements exactly.
WEIGHTS = numpy.array([-4 / 5, 9 / 20, 9 / 20, 9 / 20, 9 / 20]) / 6
EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))


def quadratic_gradients():
    """Of the ten shape functions at the points of the rule, in the coordinates of the reference tet."""
    points = numpy.vstack([numpy.full(4, 1 / 4), numpy.full((4, 4), 1 / 6) + numpy.eye(4) / 3])
    of_corners = numpy.vstack([[-1, -1, -1], numpy.eye(3)])
    return numpy.array([[(4 * p[n] - 1) * of_corners[n] for n in range(4)]
                        + [4 * (p[a] * of_corners[b] + p[b] * of_corners[a]) for a, b in EDGES] for p in points])


def jacobians_of(mesh, nodes, reference):
    return numpy.einsum("cnd,qna->cqda", mesh.points[nodes], reference)


def solve(mesh, values, fixed):
    """Laplace's equation on the curved elements; nodes that are fixed have their values."""
    nodes = mesh.cells[0].data.astype(numpy.int64)
    reference = quadratic_gradients()
    jacobians = jacobians_of(mesh, nodes, reference)
    determinants = numpy.linalg.det(jacobians)
    assert (determinants > 0).all()
    gradients = numpy.einsum("qna,cqad->cqnd", reference, numpy.linalg.inv(jacobians))
    stiffness = numpy.einsum("cqnd,cqmd,cq->cnm", gradients, gradients, determinants * WEIGHTS)
    rows, columns = numpy.repeat(nodes, 10, axis=1).ravel(), numpy.tile(nodes, (1, 10)).ravel()
    matrix = sparse.coo_matrix((stiffness.ravel(), (rows, columns))).tocsr()
    free = ~fixed
    solution = values.copy()
    solution[free] = solvers.spsolve(matrix[free][:, free], -matrix[free][:, fixed] @ values[fixed])
    return solution


class Quadratic(unittest.TestCase):
    def test_a_linear_field_is_exact(self):
        mesh = cbc3d.mesh(two_balls(), SPACING, order=2).to_meshio()
        nodes = mesh.cells[0].data
        facets = numpy.array([[1, 2, 3, 5, 9, 8], [0, 2, 3, 6, 9, 7], [0, 1, 3, 4, 8, 7], [0, 1, 2, 4, 5, 6]])
        facets = nodes[:, facets].reshape(-1, 6)
        _, inverse, counts = numpy.unique(numpy.sort(facets[:, :3], axis=1), axis=0, return_inverse=True, return_counts=True)
        fixed = numpy.zeros(len(mesh.points), bool)
        fixed[facets[counts[inverse.ravel()] == 1]] = True
        self.assertTrue(0 < fixed.sum() < len(fixed))
        exact = mesh.points @ (1, -2, 3) + 4
        solution = solve(mesh, numpy.where(fixed, exact, 0), fixed)
        self.assertLess(numpy.abs(solution - exact).max(), 1e-8 * numpy.abs(exact).max())

    def test_curved_parts_keep_their_volume(self):
        quadratic = cbc3d.mesh(two_balls(), SPACING, order=2)
        linear, mesh = quadratic.linear(), quadratic.to_meshio()
        curved = (numpy.linalg.det(jacobians_of(mesh, mesh.cells[0].data, quadratic_gradients())) * WEIGHTS).sum(axis=1)
        voxels = numpy.prod(SPACING) * (two_balls() > 0).sum()
        self.assertLess(abs(curved.sum() / voxels - 1), 0.03)
        # Flat tets have the volumes of the clean image to 0.04 %; nodes as far from the boundary as their edges' ends add 6 %.
        corners = linear.points[linear.tets]
        flat = numpy.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
        for label in (3, 8):
            share = curved[quadratic.labels == label].sum() / flat[linear.labels == label].sum()
            self.assertLess(abs(share - 1), 0.001, label)

    def test_the_session_of_ten_lines(self):
        needs("matplotlib")
        lines = [line for line in SESSION.read_text().splitlines() if line.strip()]
        self.assertLessEqual(len(lines), 10)
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, SESSION], check=True, cwd=folder, env={**os.environ, "MPLBACKEND": "Agg"})
            read = meshio.read(folder + "/halves.vtu")
            self.assertGreater((pathlib.Path(folder) / "halves.png").stat().st_size, 5000)
        self.assertEqual(read.cells[0].type, "tetra10")
        self.assertEqual(set(read.cell_data["label"][0].tolist()), {1, 2})


if __name__ == "__main__":
    unittest.main(warnings="ignore")
