"""The class Mesh: arrays without copies, files, meshio."""
import gc
import pathlib
import tempfile
import unittest

from testing_support import SPACING, numpy, two_balls

import cbc3d

try:
    import meshio
except ImportError:
    meshio = None


def volumes(points, tets):
    a, b, c, d = (points[tets[:, n]] for n in range(4))
    return numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) / 6


class Meshes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = cbc3d.mesh(two_balls(), SPACING)
        cls.mixed = cbc3d.mesh(numpy.pad(numpy.ones((40, 40, 40), "uint8"), 2), preset="paper", mixed=True, iterations=0,
                               lattice_spacing=4)

    def test_arrays_are_views_that_keep_the_mesh_alive(self):
        mesh = cbc3d.mesh(two_balls(), SPACING, preset="paper", iterations=0, lattice_spacing=6)
        points, tets, labels = mesh.points, mesh.tets, mesh.labels
        self.assertEqual((points.dtype, tets.dtype, labels.dtype), (numpy.float64, numpy.uint32, numpy.int32))
        self.assertTrue(numpy.shares_memory(points, mesh.points))
        self.assertTrue(numpy.shares_memory(labels, mesh.tet_labels))
        self.assertIs(points.base, mesh)
        mesh.points[0] += 1
        self.assertTrue((points[0] == mesh.points[0]).all())
        with self.assertRaises(ValueError):
            tets[0, 0] = 1
        expected = points.copy()
        del mesh
        gc.collect()
        numpy.testing.assert_array_equal(points, expected)

    def test_every_cell_is_positive_and_labelled(self):
        self.assertTrue((volumes(self.mesh.points, self.mesh.tets) > 0).all())
        self.assertEqual(set(self.mesh.labels.tolist()), {3, 8})
        self.assertEqual(cbc3d.mesh(two_balls() == 3, SPACING).warnings, [])
        self.assertGreater(sum(self.mesh.seconds.values()), 0)
        self.assertIn("tets", repr(self.mesh))

    def test_mixed_cells(self):
        mixed = self.mixed
        self.assertGreater(len(mixed.hexes), 0)
        self.assertEqual(len(mixed.labels), sum(len(n) for n in (mixed.tets, mixed.pyramids, mixed.wedges, mixed.hexes)))

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("mesh.vtu", "mesh.vtk", "mesh.msh"):
                path = pathlib.Path(folder) / name
                self.mesh.write(path)
                again = cbc3d.read(str(path))
                numpy.testing.assert_array_equal(again.tets, self.mesh.tets)
                numpy.testing.assert_allclose(again.points, self.mesh.points)
                numpy.testing.assert_array_equal(again.labels, self.mesh.labels)
            with self.assertRaises(cbc3d.InputError):
                self.mesh.write(folder + "/mesh.docx")
            with self.assertRaises(cbc3d.InputError):
                cbc3d.read(folder + "/absent.vtu")

    def test_every_format_is_written_and_has_names(self):
        mesh = cbc3d.Mesh(self.mesh.points, self.mesh.tets, self.mesh.labels)
        mesh.names[3] = "left ball"
        mesh.colours = {8: (1, 2, 250)}
        read = 0
        with tempfile.TemporaryDirectory() as folder:
            for name in cbc3d.mesh_format_names():
                for extension in ("vtu", "vtk", "msh", "inp", "mesh", "feb", "xdmf"):
                    path = f"{folder}/{name}.{extension}"
                    try:
                        mesh.write(path, format=name, coordinates="RAS")
                    except cbc3d.InputError:
                        continue
                    if extension in ("feb", "xdmf"):
                        with self.assertRaises(cbc3d.InputError):
                            cbc3d.read(path)
                        continue
                    again = cbc3d.read(path)
                    read += 1
                    self.assertEqual((again.names, again.colours), ({3: "left ball"}, {8: (1, 2, 250)}), name)
                    # Some formats keep the vertices in another order.
                    of_both = [points[numpy.lexsort(points.round(6).T)] for points in (again.points, mesh.points)]
                    numpy.testing.assert_allclose(*of_both, atol=1e-9, err_msg=name)
            self.assertEqual(read, 7)
            mesh.write(folder + "/split.vtu", split_interfaces=True)
            self.assertGreater(len(cbc3d.read(folder + "/split.vtu").points), len(mesh.points))
            for arguments in ({"format": "gmsh41"}, {"coordinates": "voxel"}, {"format": "x"}):
                with self.assertRaises(cbc3d.InputError):
                    mesh.write(folder + "/n.vtu", **arguments)
            self.assertFalse(pathlib.Path(folder + "/n.vtu").exists())
        for names in ({"a": "b"}, {3: 5}):
            mesh.names = names
            with self.assertRaises(cbc3d.InputError):
                mesh.write("n.vtu")
        with self.assertRaises(cbc3d.InputError):
            cbc3d.Mesh.read("absent.vtu", label_array="part")

    def test_quadratic_tets(self):
        mesh = cbc3d.mesh(two_balls(), SPACING, preset="paper", iterations=0, order=2, names={3: "left ball"})
        self.assertEqual(mesh.tets.shape[1], 10)
        linear = mesh.linear()
        numpy.testing.assert_array_equal(linear.tets, mesh.tets[:, :4])
        numpy.testing.assert_array_equal(linear.labels, mesh.labels)
        self.assertEqual(linear.names, {3: "left ball"})
        self.assertLess(mesh.corners, len(mesh.points))
        self.assertLess(mesh.tets[:, :4].max(), mesh.corners)
        edges = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
        for n, (a, b) in enumerate(edges):
            ends = mesh.points[mesh.tets[:, [a, b]]]
            moved = numpy.linalg.norm(mesh.points[mesh.tets[:, 4 + n]] - ends.mean(axis=1), axis=1)
            self.assertTrue((moved <= 0.2001 * numpy.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)).all())
        with tempfile.TemporaryDirectory() as folder:
            for extension in ("vtu", "vtk", "msh", "inp", "mesh", "feb", "xdmf"):
                mesh.write(f"{folder}/m.{extension}")
        if meshio is not None:
            out = mesh.to_meshio()
            self.assertEqual(out.cells[0].type, "tetra10")
            self.assertTrue(numpy.shares_memory(out.points, mesh.points))
        with self.assertRaises(cbc3d.InputError):
            cbc3d.mesh(two_balls(), SPACING, order=3)

    def test_meshes_from_arrays(self):
        mesh = self.mixed
        again = cbc3d.Mesh(mesh.points, mesh.tets, mesh.labels, pyramids=mesh.pyramids, hexes=mesh.hexes)
        numpy.testing.assert_array_equal(again.hexes, mesh.hexes)
        numpy.testing.assert_array_equal(again.labels, mesh.labels)
        for points, tets, labels, text in (([[0, 0]], [[0, 1, 2, 3]], [1], "points"), (numpy.eye(3), [[0, 1, 2, 3]], [1], "node 3"),
                                           (numpy.eye(3), [[0, 1, 2]], [1], "tets"), (numpy.eye(3), [[0, 1, 2, -1]], [1], "node -1"),
                                           (numpy.eye(3), [[0, 1, 2, 0]], [1, 2], "labels")):
            with self.assertRaises(cbc3d.InputError) as caught:
                cbc3d.Mesh(points, tets, labels)
            self.assertIn(text, str(caught.exception))

    @unittest.skipIf(meshio is None, "python3-meshio is not installed")
    def test_meshio(self):
        for mesh in (self.mesh, self.mixed):
            out = mesh.to_meshio()
            self.assertTrue(numpy.shares_memory(out.points, mesh.points))
            again = cbc3d.Mesh.from_meshio(out)
            numpy.testing.assert_array_equal(again.tets, mesh.tets)
            numpy.testing.assert_array_equal(again.hexes, mesh.hexes)
            numpy.testing.assert_array_equal(again.labels, mesh.labels)
        with self.assertRaises(cbc3d.InputError):
            cbc3d.Mesh.from_meshio(self.mesh.to_meshio(), label="colour")


if __name__ == "__main__":
    unittest.main(warnings="ignore")
