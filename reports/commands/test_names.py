"""Names of seven segments from a .seg.nrrd file to meshes, a mesh read back, warnings and the report as HTML; layers that overlap.

The file is made here; where there is one of 3D Slicer in CBC3D_DATA or in shared/data beside the project, that goes the same way.
"""
import hashlib
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

COMMAND, BENCH = os.environ["CBC3D_COMMAND"], os.environ["CBC3D_BENCH"]
PROJECT = pathlib.Path(__file__).resolve().parents[2]
OF_SLICER = "slicerio_Segmentation.seg.nrrd"
NAMES = ("left lung", "right lung", "heart", "aorta", "trachea", "liver", "spleen, part")
SIZE = (30, 14, 14)


def run(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.stderr)
    return done.stdout + done.stderr


def seg_nrrd(names, layers, values_at):
    """A file as 3D Slicer 5 writes it; `names` are (name, value, layer), `values_at` gives one value for each layer."""
    notes = "".join(f"Segment{n}_ID:=s{n}\nSegment{n}_Name:={name}\nSegment{n}_LabelValue:={value}\nSegment{n}_Layer:={layer}\n"
                    f"Segment{n}_Color:=0.5 0 1\n" for n, (name, value, layer) in enumerate(names))
    several = layers > 1
    header = (f"NRRD0004\ntype: unsigned char\ndimension: {4 if several else 3}\nspace: left-posterior-superior\n"
              f"sizes: {f'{layers} ' if several else ''}{SIZE[0]} {SIZE[1]} {SIZE[2]}\n"
              f"space directions: {'none ' if several else ''}(1,0,0) (0,1,0) (0,0,1)\n"
              f"kinds: {'list ' if several else ''}domain domain domain\nencoding: raw\nspace origin: (5,6,7)\n{notes}\n")
    voxels = bytes(value for k in range(SIZE[2]) for j in range(SIZE[1]) for i in range(SIZE[0]) for value in values_at(i, j, k))
    return header.encode() + voxels


def box_at(i, j, k):
    """Seven boxes along x; of the fifth one voxel alone, whose volume the paper's lattice does not keep."""
    if not (1 <= i < SIZE[0] - 1 and 2 <= j < 12 and 2 <= k < 12):
        return 0
    box = 1 + (i - 1) * 7 // (SIZE[0] - 2)
    return 4 if box == 5 and (i, j, k) != (19, 7, 7) else box


def slicer_file():
    folders = [pathlib.Path(f) for f in os.environ.get("CBC3D_DATA", "").split(":") if f] + [PROJECT.parent / "shared" / "data"]
    return next((folder / OF_SLICER for folder in folders if (folder / OF_SLICER).exists()), None)


class Names(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def expect_in_meshes(self, image, names, judged=True):
        """In files of three formats as other programs see them, and in what we read of each; `judged`: by the improver and the bench
        too."""
        mesh = [COMMAND, "mesh", image, "--preset", "paper", "--iterations", "0", "--quiet", "-o"]
        for extension in ("vtu", "msh", "inp"):
            file = self.folder / f"m.{extension}"
            run(*mesh, file)
            text = file.read_bytes().decode("latin-1")
            if extension == "msh":
                found = dict(re.findall(r'^3 (\d+) "(.*)"$', text, re.MULTILINE))
                self.assertEqual(found, {str(label): re.sub("[^A-Za-z0-9]+", "_", name) for label, name in names.items()})
            if extension == "inp":
                found = set(re.findall(r"^\*ELEMENT, .*ELSET=(.*)$", text, re.MULTILINE))
                self.assertEqual(found, {re.sub("[^A-Za-z0-9]+", "_", name) for name in names.values()})
            run(COMMAND, "surface", file, "--quiet", "-o", self.folder / "s.obj")
            groups = re.findall(r"^g (.*)$", (self.folder / "s.obj").read_text(), re.MULTILINE)
            self.assertEqual(set(groups), {re.sub("[^A-Za-z0-9]+", "_", name) for name in names.values()}, extension)
            if not judged:
                continue
            run(COMMAND, "improve", file, "--quiet", "-o", self.folder / "i.vtu", "--report", self.folder / "i.json")
            improved = json.loads((self.folder / "i.json").read_text())
            self.assertEqual({row["label"]: row["name"] for row in improved["labels"]}, names, extension)
            run(BENCH, "evaluate", file, image, "--quiet", "--no-certified", "--json", self.folder / "e.json")
            evaluated = json.loads((self.folder / "e.json").read_text())
            self.assertEqual(evaluated["label_names"], {str(label): name for label, name in names.items()}, extension)

    def expect_in_report(self, image, names):
        manifests, out = self.folder / "manifests", self.folder / "out"
        manifests.mkdir()
        case = {"name": "segments", "title": "Segments", "suites": ["own"], "image": {
            "file": image.name, "sha256": hashlib.sha256(image.read_bytes()).hexdigest(), "source": "this test"}}
        (manifests / "segments.json").write_text(json.dumps(case))
        run(BENCH, "run", "--manifests", manifests, "--data", image.parent, "--case", "segments", "--mesher", "cbc3d-paper",
            "--no-pictures", "--quiet", "--out", out)
        run(BENCH, "report", out, "--manifests", manifests, "--out", self.folder / "r.html")
        page = (self.folder / "r.html").read_text()
        for label, name in names.items():
            self.assertIn(f"{label} {name}", page)

    def test_of_seven_segments(self):
        image = self.folder / "seven.seg.nrrd"
        image.write_bytes(seg_nrrd([(name, n + 1, 0) for n, name in enumerate(NAMES)], 1, lambda i, j, k: [box_at(i, j, k)]))
        there = {n + 1: name for n, name in enumerate(NAMES)}
        text = run(COMMAND, "mesh", image, "--preset", "paper", "--iterations", "0", "-o", self.folder / "w.vtu")
        self.assertRegex(text, r"warning: .*trachea \(5\)")
        self.expect_in_report(image, there)
        self.expect_in_meshes(image, there)

    def test_of_a_file_of_slicer(self):
        image = slicer_file()
        if image is None:
            self.skipTest(f"{OF_SLICER} is not there")
        info = json.loads(run(COMMAND, "info", "--json", image))
        names = {row["label"]: row["name"] for row in info["labels"]}
        self.assertEqual(len(names), 7)
        self.expect_in_meshes(image, names, judged=False)
        self.expect_in_report(image, names)

    def test_of_layers_that_overlap(self):
        """The segment that comes last in the file has the voxel, which a warning says."""
        image = self.folder / "two.seg.nrrd"
        inside = lambda i, j, k: 1 <= i < 29 and 2 <= j < 12 and 2 <= k < 12  # noqa: E731
        image.write_bytes(seg_nrrd([("lung", 1, 0), ("tumour", 1, 1)], 2, lambda i, j, k: [
            int(inside(i, j, k)), int(10 <= i < 20 and inside(i, j, k))]))
        text = run(COMMAND, "mesh", image, "--preset", "paper", "--iterations", "0", "-o", self.folder / "m.msh")
        self.assertIn("1000 voxels lie in several segments (tumour (2) over lung (1)); each has the one that comes last in the file",
                      text)
        self.assertEqual(re.findall(r'^3 (\d) "(.*)"$', (self.folder / "m.msh").read_text(), re.MULTILINE),
                         [("1", "lung"), ("2", "tumour")])


if __name__ == "__main__":
    unittest.main()
