"""The type stubs are Python, and have every public name and every option."""
import ast
import pathlib
import unittest

import testing_support  # noqa: F401: numpy, or the test is skipped

import cbc3d


class Stubs(unittest.TestCase):
    def test_they_are_the_package(self):
        path = pathlib.Path(cbc3d.__file__).with_suffix(".pyi")
        tree = ast.parse(path.read_text())
        named = {node.name: node for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(set(cbc3d.__all__), set(named))
        options = {argument.arg for argument in named["mesh"].args.kwonlyargs}
        self.assertLessEqual({row["keyword"] for row in cbc3d.option_rows()}, options)
        choices = {row["keyword"] for row in cbc3d.input_rows()}
        for name in ("mesh", "improve", "evaluate"):
            self.assertLessEqual(choices, {argument.arg for argument in named[name].args.kwonlyargs})
        for name in ("Mesh", "QuadraticMesh"):
            self.expect_members(named[name], getattr(cbc3d, name))
        self.assertTrue((path.parent / "py.typed").exists())

    def expect_members(self, stub, kind):
        members = {node.name if isinstance(node, ast.FunctionDef) else node.target.id for node in stub.body}
        public = {name for name in vars(kind) if not name.startswith("_")}
        self.assertLessEqual(public, members)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
