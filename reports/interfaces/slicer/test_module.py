"""Runs the module as 3D Slicer does: asks for its description, fills it in, runs it on files and follows its progress."""
import array
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

MODULE = os.environ["CBC3D_SLICER"]
SCHEMA = pathlib.Path(__file__).with_name("module.xsd")
KINDS = {"integer": int, "double": float}


def description():
    return subprocess.run([MODULE, "--xml"], check=True, capture_output=True).stdout


def write_balls(path):
    """Two balls, labels 1 and 7, as the uncompressed NRRD that Slicer hands to modules."""
    size = (32, 24, 20)
    labels = array.array("h", bytes(2 * size[0] * size[1] * size[2]))
    for k in range(size[2]):
        for j in range(size[1]):
            for i in range(size[0]):
                for label, x in ((1, 11), (7, 20)):
                    if (i - x) ** 2 + (j - 12) ** 2 + (1.2 * k - 12) ** 2 < 64:
                        labels[(k * size[1] + j) * size[0] + i] = label
    header = ("NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 32 24 20\n"
              "space directions: (1,0,0) (0,1,0) (0,0,1.2)\nkinds: domain domain domain\nendian: little\nencoding: raw\n"
              "space origin: (-50,20,300)\n\n")
    pathlib.Path(path).write_bytes(header.encode() + labels.tobytes())


def command_line(root, folder, values, empty_texts):
    """The arguments that Slicer makes of a panel: flags with values, then the files by their places."""
    arguments, files = [], {}
    for parameter in root.findall("parameters/*"):
        if parameter.tag in ("image", "geometry"):
            files[int(parameter.findtext("index"))] = folder / ("in.nrrd" if parameter.tag == "image" else "out.vtk")
        elif parameter.tag not in ("label", "description"):
            value = values.get(parameter.findtext("name"), parameter.findtext("default") or "")
            flag = parameter.findtext("longflag")
            if parameter.tag == "boolean":
                arguments += [flag] if value == "true" else []
            elif value or empty_texts:
                arguments += [flag, value]
    return [MODULE, *arguments, *(str(files[place]) for place in sorted(files))]


class Module(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        self.root = ElementTree.fromstring(description())

    def test_the_description_is_valid(self):
        if shutil.which("xmllint") is None:
            print("xmllint is not installed (Debian: libxml2-utils)")
            sys.exit(77)
        file = self.path / "module.xml"
        file.write_bytes(description())
        checked = subprocess.run(["xmllint", "--noout", "--schema", str(SCHEMA), str(file)], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        broken = file.read_text().replace("<channel>input", "<channel>inward")
        file.write_text(broken)
        self.assertNotEqual(subprocess.run(["xmllint", "--noout", "--schema", str(SCHEMA), str(file)],
                                           capture_output=True).returncode, 0)

    def test_defaults_are_values(self):
        for parameter in self.root.findall("parameters/*"):
            default = parameter.findtext("default")
            if parameter.tag == "string-enumeration":
                self.assertIn(default, [element.text for element in parameter.findall("element")])
            elif parameter.tag in KINDS:
                value = KINDS[parameter.tag](default)
                self.assertLessEqual(float(parameter.findtext("constraints/minimum")), value)
                self.assertGreaterEqual(float(parameter.findtext("constraints/maximum")), value)

    def test_every_option_is_asked_for_once(self):
        described = subprocess.run([os.environ["CBC3D_COMMAND"], "mesh", "--describe-options"], check=True, capture_output=True,
                                   text=True).stdout
        flags = [flag.text for flag in self.root.findall("parameters/*/longflag")]
        for name in {option["name"] for preset in json.loads(described)["presets"] for option in preset["options"]}:
            self.assertEqual(flags.count("--" + name), 1, name)

    def test_choices_about_the_label_map_are_the_table_s(self):
        group, = [group for group in self.root.findall("parameters") if group.findtext("label") == "Input image"]
        described = json.loads(subprocess.run([os.environ["CBC3D_COMMAND"], "mesh", "--describe-options"], check=True,
                                              capture_output=True, text=True).stdout)["input"]
        texts = {"--" + option["name"]: option["text"] for option in described}
        flags = [flag.text for flag in group.findall("*/longflag")]
        self.assertEqual(flags, ["--background", "--labels", "--keep-rest", "--many-labels"])
        for parameter in group.findall("*"):
            if parameter.find("longflag") is not None:
                self.assertTrue(parameter.findtext("description").startswith(texts[parameter.findtext("longflag")]))

    def run_with(self, values, empty_texts=False):
        write_balls(self.path / "in.nrrd")
        command = command_line(self.root, self.path, values, empty_texts)
        return subprocess.run(command, capture_output=True, text=True)

    def check_progress(self, lines):
        self.assertTrue(lines.startswith("<filter-start>\n<filter-name>CBC3D</filter-name>"))
        fractions = [float(text) for text in re.findall(r"<filter-progress>(.*)</filter-progress>", lines)]
        self.assertGreater(len(fractions), 4)
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual((fractions[0], fractions[-1]), (0, 1))
        self.assertRegex(lines, r"<filter-end>\n<filter-name>CBC3D</filter-name>\n<filter-time>[\d.e-]+</filter-time>\n</filter-end>\n$")
        ElementTree.fromstring(f"<all>{lines}</all>")  # every line is well-formed

    def check_model(self):
        head = (self.path / "out.vtk").read_bytes()[:200].split(b"\n")
        self.assertEqual(head[0], b"# vtk DataFile Version 4.2")
        self.assertIn(b"SPACE=LPS", head[1])
        info = subprocess.run([os.environ["CBC3D_COMMAND"], "improve", "out.vtk", "in.nrrd", "--out", "again.vtu", "--quiet"],
                              cwd=self.path, capture_output=True, text=True)
        self.assertEqual(info.returncode, 0, info.stderr)  # it is read, and lies where the image lies

    def test_it_runs_with_the_panel_s_defaults(self):
        for empty_texts in (False, True):
            done = self.run_with({}, empty_texts)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.check_progress(done.stdout)
            self.check_model()

    def test_it_runs_with_other_values(self):
        done = self.run_with({"preset": "paper", "connectivity": "face", "mixed": "true", "size": "1=3,7=2", "iterations": "2",
                              "topologyChecks": "true"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_progress(done.stdout)

    def labels_of_model(self):
        """Of the cells, from the model as text; and how many nodes the first cell has."""
        subprocess.run([os.environ["CBC3D_COMMAND"], "improve", "out.vtk", "--out", "again.inp", "--quiet"], cwd=self.path,
                       check=True, capture_output=True)
        return set(re.findall(r"ELSET=(\w+)", (self.path / "again.inp").read_text()))

    def test_it_meshes_what_is_chosen(self):
        for values, labels in (({"labels": "7"}, {"label_7"}), ({"labels": "1", "keepRest": "true"}, {"label_1", "rest"}),
                               ({"background": "0,1"}, {"label_7"})):
            done = self.run_with({"preset": "paper", "iterations": "0", **values})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.labels_of_model(), labels)

    def test_it_writes_quadratic_tets_and_split_interfaces(self):
        sizes = {}
        for name, values in (("linear", {}), ("quadratic", {"order": "2"}), ("split", {"splitInterfaces": "true"})):
            done = self.run_with({"preset": "paper", "iterations": "0", **values})
            self.assertEqual(done.returncode, 0, done.stderr)
            bytes_ = (self.path / "out.vtk").read_bytes()
            points = int(re.search(rb"POINTS (\d+)", bytes_).group(1))
            cells, numbers = map(int, re.search(rb"CELLS (\d+) (\d+)", bytes_).groups())
            sizes[name] = points, cells, numbers
        self.assertEqual(sizes["quadratic"][2], 11 * sizes["quadratic"][1])
        self.assertEqual(sizes["linear"][2], 5 * sizes["linear"][1])
        self.assertEqual(sizes["split"][1:], sizes["linear"][1:])
        self.assertGreater(sizes["split"][0], sizes["linear"][0])

    def test_it_refuses_in_one_line(self):
        for values, text in (({"labels": "9"}, "no label 9"), ({"labels": "one"}, "labels"), ({"minDihedral": "steep"}, "min-dihedral"), ({"size": "9=1"}, "no label 9")):
            done = self.run_with(values)
            self.assertEqual(done.returncode, 2)
            self.assertIn(text, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertFalse((self.path / "out.vtk").exists())
        write_balls(self.path / "in.nrrd")
        self.assertEqual(subprocess.run([MODULE, str(self.path / "in.nrrd")], capture_output=True).returncode, 2)


if __name__ == "__main__":
    unittest.main()
