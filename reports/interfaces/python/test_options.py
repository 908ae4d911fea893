"""Options by keyword: every row of the table is known, documented and checked."""
import inspect
import unittest

from testing_support import SPACING, numpy, two_balls

import cbc3d


class Options(unittest.TestCase):
    def test_every_option_is_documented(self):
        rows = cbc3d.option_rows()
        self.assertGreater(len(rows), 25)
        parameters = inspect.signature(cbc3d.mesh).parameters
        for row in rows:
            self.assertIn(row["keyword"], parameters)
            self.assertIn(f"  {row['keyword']}: {row['text'].split()[0]}", cbc3d.mesh.__doc__)
            self.assertTrue(row["defaults"], row)
        self.assertEqual(cbc3d.preset_names()[0], "quality")

    def test_choices_about_the_array_are_documented(self):
        keywords = [row["keyword"] for row in cbc3d.input_rows()]
        self.assertEqual(keywords, ["volume", "background", "labels", "keep_rest", "names", "many_labels"])
        for function in (cbc3d.mesh, cbc3d.improve, cbc3d.evaluate):
            self.assertLessEqual(set(keywords), set(inspect.signature(function).parameters))
            for keyword in keywords:
                self.assertIn(keyword, function.__doc__)
        self.assertNotIn("--", cbc3d.mesh.__doc__)
        self.assertIn("order      1: tets of four nodes", cbc3d.mesh.__doc__)

    def test_every_option_refuses_nonsense(self):
        for row in cbc3d.option_rows():
            for value in ("nonsense", object(), {1: "x"}):
                if row["kind"] == "bool" and not isinstance(value, str):
                    continue
                with self.assertRaises(cbc3d.InputError) as caught:
                    cbc3d.mesh(two_balls(), SPACING, **{row["keyword"]: value})
                self.assertIn(row["keyword"], str(caught.exception))
                self.assertNotIn("--", str(caught.exception))

    def test_values_of_python_and_numpy(self):
        for goal in (10, 10.0, "10", numpy.float32(10), numpy.int16(10)):
            cbc3d.mesh(two_balls(), SPACING, preset="paper", iterations=numpy.int64(0), min_dihedral=goal, lattice_spacing=6)
        fine = cbc3d.mesh(two_balls(), SPACING, size={8: 2.0})
        coarse = cbc3d.mesh(two_balls(), SPACING, size=None)
        self.assertGreater((fine.labels == 8).sum(), 2 * (coarse.labels == 8).sum())

    def test_errors_name_keywords(self):
        for options, text, parameter in (({"lattice_spacing": -1}, "lattice_spacing -1: give a number in (0, 1e+09]", None),
                                         ({"lattice_spacing": 1e-9}, "lattice_spacing", "lattice_spacing"),
                                         ({"size": {5: 1}}, "no label 5", None), ({"colour": 1}, "no such option", None),
                                         ({"iterations": 1.5}, "iterations 1.5: give a whole number", None),
                                         ({"preset": "best"}, "best", None)):
            with self.assertRaises(cbc3d.InputError) as caught:
                cbc3d.mesh(two_balls(), SPACING, **options)
            self.assertIn(text, str(caught.exception))
            self.assertNotIn("_mm", str(caught.exception))
            if parameter:
                self.assertEqual(caught.exception.parameter, parameter)
            self.assertIsInstance(caught.exception, ValueError)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
