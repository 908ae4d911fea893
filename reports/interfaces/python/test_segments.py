"""The seven segments of a file of 3D Slicer's through every format of meshes and back: counts by label, places, names and colours.

The file is looked for in CBC3D_DATA and in shared/data beside the project; where it is absent the test is skipped. What our own readers
find is held against what VTK reads of the .vtu file, formats that we do not read against it by meshio or Python's XML.
"""
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import types
import unittest
import xml.etree.ElementTree

from testing_support import needs, numpy

import cbc3d

if importlib.util.find_spec("h5py") is None:
    sys.modules["h5py"] = types.ModuleType("h5py")  # meshio imports it for XDMF's text too, which does not need it
meshio, vtk, vtk_arrays = needs("meshio", "vtk", "vtk.util.numpy_support")
OF_SLICER = "slicerio_Segmentation.seg.nrrd"
PROJECT = pathlib.Path(__file__).resolve().parents[3]
EXTENSIONS = {"vtu": "vtu", "vtk": "vtk", "vtk-ascii": "vtk", "gmsh22": "msh", "gmsh41": "msh", "abaqus": "inp", "medit": "mesh",
              "febio": "feb", "xdmf": "xdmf"}


def slicer_file():
    folders = [pathlib.Path(f) for f in os.environ.get("CBC3D_DATA", "").split(":") if f] + [PROJECT.parent / "shared" / "data"]
    found = [folder / OF_SLICER for folder in folders if (folder / OF_SLICER).exists()]
    if not found:
        print(f"skipped: {OF_SLICER} is in none of {', '.join(map(str, folders))}")
        sys.exit(77)
    return found[0]


IMAGE = slicer_file()


def segments_of(image):
    """Names and colours by label as the file's header has them."""
    header = image.read_bytes().split(b"\n\n")[0].decode()
    fields = {(number, key): value.strip() for number, key, value in re.findall(r"^Segment(\d+)_(\w+):=(.*)$", header, re.MULTILINE)}
    labels = {number: int(fields[number, "LabelValue"]) for number, _ in fields}
    colours = {number: tuple(round(255 * float(c)) for c in fields[number, "Color"].split()) for number in labels}
    return ({label: fields[number, "Name"] for number, label in labels.items()},
            {label: colours[number] for number, label in labels.items()})


def by_label(points, tets, labels):
    """The corners of the tets of every label."""
    return {int(label): points[tets[labels == label]] for label in numpy.unique(labels)}


def read_by_vtk(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    tets = vtk_arrays.vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    return by_label(vtk_arrays.vtk_to_numpy(grid.GetPoints().GetData()), tets,
                    vtk_arrays.vtk_to_numpy(grid.GetCellData().GetArray("label")))


def read_xdmf(path):
    """With what our comments state."""
    mesh, text = meshio.read(path), path.read_text()
    names = {int(label): name for label, name in re.findall("<!-- name (\\d+) = (.*) -->", text)}
    colours = {int(label): tuple(bytes.fromhex(c)) for label, c in re.findall("<!-- colour (\\d+) = #(.*) -->", text)}
    return by_label(mesh.points, mesh.cells[0].data, mesh.cell_data["label"][0]), names, colours


def read_febio(path):
    """By the names of parts, which are words of letters and digits; there are neither labels nor colours."""
    mesh = xml.etree.ElementTree.parse(path).getroot().find("Mesh")
    points = numpy.array([[float(x) for x in node.text.split(",")] for node in mesh.find("Nodes")])
    tets = {part.get("name"): numpy.array([[int(n) for n in tet.text.split(",")] for tet in part]) - 1 for part in mesh.findall("Elements")}
    return {name: points[nodes] for name, nodes in tets.items()}


def read_by_us(path):
    mesh = cbc3d.read(str(path))
    return by_label(mesh.points, mesh.tets, mesh.labels), mesh.names, mesh.colours


class Segments(unittest.TestCase):
    def mesh(self, folder, name):
        path = pathlib.Path(folder) / f"{name}.{EXTENSIONS[name]}"
        subprocess.run([os.environ["CBC3D_COMMAND"], "mesh", IMAGE, "--preset", "paper", "--iterations", "0", "--fidelity", "0.3",
                        "--format", name, "--quiet", "-o", path], check=True, stderr=subprocess.DEVNULL)
        return path

    def expect_places(self, found, expected, name):
        """Tets of a label keep their order and their corners' in every format."""
        self.assertEqual({label: len(tets) for label, tets in found.items()}, {label: len(tets) for label, tets in expected.items()}, name)
        for label, tets in expected.items():
            numpy.testing.assert_allclose(found[label], tets, rtol=0, atol=1e-8, err_msg=f"{name}, label {label}")

    def test_every_format(self):
        names, colours = segments_of(IMAGE)
        self.assertEqual(len(names), 7)
        self.assertEqual(sorted(cbc3d.mesh_format_names()), sorted(EXTENSIONS))
        with tempfile.TemporaryDirectory() as folder:
            expected = read_by_vtk(self.mesh(folder, "vtu"))
            self.assertEqual(set(expected), set(names))
            for name in EXTENSIONS:
                path = self.mesh(folder, name)
                if name == "febio":
                    words = {label: re.sub("[^A-Za-z0-9]+", "_", text) for label, text in names.items()}
                    self.expect_places(read_febio(path), {words[label]: tets for label, tets in expected.items()}, name)
                    continue
                tets, *found = (read_xdmf if name == "xdmf" else read_by_us)(path)
                self.expect_places(tets, expected, name)
                self.assertEqual(found, [names, colours], name)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
