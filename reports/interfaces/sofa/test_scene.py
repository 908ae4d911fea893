"""The scene names components with the plugins and the data that SOFA's documentation gives them, its links lead somewhere, and the
meshes are of the versions that its loaders take. Where runSofa is installed, it runs the scene."""
import array
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

SCENE = pathlib.Path(__file__).with_name("mesh.scn")
# Components, the plugin of each (empty: part of the core) and the data that the scene may set.
COMPONENTS = {
    "DefaultAnimationLoop": ("", set()),
    "VisualStyle": ("Sofa.Component.Visual", {"displayFlags"}),
    "EulerImplicitSolver": ("Sofa.Component.ODESolver.Backward", {"rayleighStiffness", "rayleighMass"}),
    "CGLinearSolver": ("Sofa.Component.LinearSolver.Iterative", {"iterations", "tolerance", "threshold"}),
    "MeshVTKLoader": ("Sofa.Component.IO.Mesh", {"filename"}),
    "TetrahedronSetTopologyContainer": ("Sofa.Component.Topology.Container.Dynamic", {"src"}),
    "TetrahedronSetGeometryAlgorithms": ("Sofa.Component.Topology.Container.Dynamic", {"template"}),
    "MechanicalObject": ("Sofa.Component.StateContainer", {"template", "src"}),
    "MeshMatrixMass": ("Sofa.Component.Mass", {"massDensity", "topology"}),
    "TetrahedronFEMForceField": ("Sofa.Component.SolidMechanics.FEM.Elastic",
                                 {"template", "method", "youngModulus", "poissonRatio"}),
    "BoxROI": ("Sofa.Component.Engine.Select", {"template", "box", "position"}),
    "FixedProjectiveConstraint": ("Sofa.Component.Constraint.Projective", {"template", "indices"}),
}


def write_ball(path):
    """A ball of label 2 in 20 x 20 x 20 voxels of 2 mm, uncompressed NRRD."""
    labels = array.array("B", (2 if (i - 10) ** 2 + (j - 10) ** 2 + (k - 10) ** 2 < 64 else 0
                               for k in range(20) for j in range(20) for i in range(20)))
    header = ("NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 20 20 20\n"
              "space directions: (2,0,0) (0,2,0) (0,0,2)\nspace origin: (0,0,0)\nkinds: domain domain domain\nencoding: raw\n\n")
    pathlib.Path(path).write_bytes(header.encode() + labels.tobytes())


class Scene(unittest.TestCase):
    def setUp(self):
        self.root = ElementTree.parse(SCENE).getroot()
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def components(self):
        return [e for e in self.root.iter() if e.tag not in ("Node", "RequiredPlugin")]

    def test_components_are_known_and_their_plugins_required(self):
        required = [plugin.get("name") for plugin in self.root.iter("RequiredPlugin")]
        self.assertEqual(len(required), len(set(required)))
        used = set()
        for component in self.components():
            plugin, data = COMPONENTS[component.tag]
            used.add(plugin)
            self.assertLessEqual(set(component.attrib) - {"name"}, data, component.tag)
        self.assertEqual(used - {""}, set(required))

    def test_links_lead_to_components_before_them(self):
        named = {}
        for component in self.components():
            for value in component.attrib.values():
                if value.startswith("@"):
                    self.assertIn(value[1:].split(".")[0], named)
            named[component.get("name")] = component
        self.assertEqual(len(self.root.find("Node[@name='organ']/BoxROI").get("box").split()), 6)

    def mesh(self, name):
        write_ball(self.path / "ball.nrrd")
        subprocess.run([os.environ["CBC3D_COMMAND"], "mesh", "ball.nrrd", "--out", name, "--quiet"], cwd=self.path, check=True)
        return (self.path / name).read_bytes()

    def test_the_vtk_file_is_what_the_loader_takes(self):
        data = self.mesh("mesh.vtk")
        self.assertTrue(data.startswith(b"# vtk DataFile Version 4.2\n"))
        lines = data.split(b"\n", 4)
        self.assertEqual(lines[2:4], [b"BINARY", b"DATASET UNSTRUCTURED_GRID"])
        head, _, rest = lines[4].partition(b"\n")
        keyword, points, kind = head.split()
        self.assertEqual((keyword, kind), (b"POINTS", b"double"))
        body = rest[24 * int(points):].lstrip(b"\n")
        keyword, cells, numbers = body.split(b"\n", 1)[0].split()
        self.assertEqual((keyword, int(numbers)), (b"CELLS", 5 * int(cells)))
        nodes = struct.unpack(f">{numbers.decode()}i", body.split(b"\n", 1)[1][:4 * int(numbers)])
        self.assertEqual(set(nodes[::5]), {4})
        self.assertLess(max(nodes), int(points))
        held = [struct.unpack_from(">3d", rest, 24 * p)[2] > 20 for p in range(int(points))]
        self.assertTrue(any(held) and not all(held))

    def test_the_msh_file_is_what_the_loader_takes(self):
        self.assertTrue(self.mesh("mesh.msh").startswith(b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"))

    @unittest.skipIf(shutil.which("runSofa") is None, "runSofa is not installed")
    def test_sofa_runs_it(self):
        self.mesh("mesh.vtk")
        shutil.copy(SCENE, self.path)
        done = subprocess.run(["runSofa", "-g", "batch", "-n", "3", "mesh.scn"], cwd=self.path, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("[ERROR]", done.stdout)


if __name__ == "__main__":
    unittest.main()
