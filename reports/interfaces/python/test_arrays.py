"""Arrays of every integer type, order and layout give the same mesh; others are refused."""
import unittest

from testing_support import SPACING, numpy, two_balls

import cbc3d


def coarse(array, **options):
    return cbc3d.mesh(array, SPACING, preset="paper", iterations=0, lattice_spacing=6, fidelity=0.5, **options)


class Arrays(unittest.TestCase):
    def setUp(self):
        self.expected = coarse(two_balls())

    def expect_same(self, mesh):
        numpy.testing.assert_array_equal(mesh.points, self.expected.points)
        numpy.testing.assert_array_equal(mesh.tets, self.expected.tets)
        numpy.testing.assert_array_equal(mesh.labels, self.expected.labels)

    def test_all_integer_types(self):
        for dtype in ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "longlong", "ulonglong"):
            for order in "CF":
                with self.subTest(dtype=dtype, order=order):
                    self.expect_same(coarse(numpy.array(two_balls(dtype=dtype), order=order)))

    def test_other_axes_and_views(self):
        ijk = two_balls("ijk")
        self.expect_same(coarse(ijk, axes="ijk"))
        self.expect_same(coarse(numpy.ascontiguousarray(ijk), axes="ijk"))
        padded = numpy.zeros((26, 66, 43), "int16")
        view = padded[1:25, 1:65:2, 2:42]
        view[...] = two_balls()
        self.expect_same(coarse(view))
        self.expect_same(coarse(two_balls(dtype="int16")[::-1][::-1]))
        self.expect_same(coarse(two_balls(dtype=">i4")))
        self.expect_same(coarse(two_balls().tolist()))

    def test_large_and_negative_labels(self):
        array = two_balls(dtype="int32")
        array[array == 8] = -70000
        array[array == 3] = 1 << 20
        for layout in (array, numpy.asfortranarray(array)):
            self.assertEqual(set(coarse(layout).labels.tolist()), {-70000, 1 << 20})

    def test_booleans(self):
        mesh = coarse(two_balls() == 3)
        self.assertEqual(set(mesh.labels.tolist()), {1})

    def test_frames(self):
        direction = numpy.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]])
        mesh = cbc3d.mesh(two_balls(), SPACING, (10, -20, 5), direction, preset="paper", iterations=0, lattice_spacing=6,
                          fidelity=0.5)
        numpy.testing.assert_allclose(mesh.points, self.expected.points @ direction.T + (10, -20, 5), atol=1e-9)
        again = cbc3d.mesh(two_balls(), SPACING, (10, -20, 5), tuple(direction.ravel()), preset="paper", iterations=0,
                           lattice_spacing=6, fidelity=0.5)
        numpy.testing.assert_array_equal(again.points, mesh.points)

    def test_affine_of_nibabel(self):
        affine = numpy.array([[-0.9, 0, 0, 90], [0, 0.8, 0, -100], [0, 0, 2, 7], [0, 0, 0, 1.0]])
        spacing, origin, direction = cbc3d.frame_of_affine(affine)
        numpy.testing.assert_allclose(spacing, (0.9, 0.8, 2))
        numpy.testing.assert_allclose(origin, (-90, 100, 7))
        numpy.testing.assert_allclose(direction, numpy.diag([1, -1, 1]))
        with self.assertRaises(ValueError):
            cbc3d.frame_of_affine(affine[:3])

    def test_refusals(self):
        balls = two_balls()
        for array, text in ((balls.astype(float), "float64"), (balls[0], "2 axes"), (balls * 0, "background"),
                            (numpy.zeros((0, 3, 3), int), "size"),
                            (numpy.where(balls, 1 << 40, 0), str(1 << 40)),
                            (numpy.asfortranarray(numpy.where(balls, 1 << 40, 0)), str(1 << 40))):
            with self.assertRaises(cbc3d.InputError) as caught:
                coarse(array)
            self.assertIn(text, str(caught.exception))
        for arguments, text in (({"spacing": (1, 2)}, "spacing"), ({"spacing": (1, 2, -1)}, "spacing"),
                                ({"direction": numpy.ones((3, 3))}, "direction"), ({"axes": "jki"}, "axes"),
                                ({"origin": "here"}, "origin")):
            with self.assertRaises(cbc3d.InputError) as caught:
                cbc3d.mesh(balls, **arguments)
            self.assertIn(text, str(caught.exception))


if __name__ == "__main__":
    unittest.main(warnings="ignore")
