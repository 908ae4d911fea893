"""The peak of memory is within 1.2 of the command's, for a mid-size image."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from testing_support import numpy, write_nrrd

SPACING = (0.9, 0.9, 1.5)
MOST = 1.2
# Of its own, for the peak of a process only grows.
PYTHON = """
import sys
import numpy, cbc3d
labels = numpy.fromfile(sys.argv[1], "uint8").reshape({shape})
mesh = cbc3d.mesh(labels, {spacing})
assert len(mesh.tets) > 1000
"""


def balls(shape):
    """Three organs of some millions of voxels, one inside another."""
    k, j, i = numpy.ogrid[:shape[0], :shape[1], :shape[2]]
    labels = numpy.zeros(shape, "uint8")
    for label, radius in ((1, 0.45), (2, 0.3), (3, 0.15)):
        inside = (k / shape[0] - 0.5) ** 2 + (j / shape[1] - 0.5) ** 2 + (i / shape[2] - 0.45 - label / 50) ** 2 < radius ** 2
        labels[inside] = label
    return labels


def peak_bytes(command):
    """Of the child, which begins as small as /usr/bin/env does."""
    child = subprocess.Popen(["/usr/bin/env", *command])
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == 0, command
    return usage.ru_maxrss * 1024


def measure(folder, shape):
    """Peaks of the command and of Python. A process of its own makes the image, for a child's peak is not below its parent's."""
    script = f"import test_memory as t; t.write_images({folder!r}, {shape!r})"
    subprocess.run([sys.executable, "-c", script], check=True, cwd=pathlib.Path(__file__).parent)
    command = peak_bytes([os.environ["CBC3D_COMMAND"], "mesh", folder + "/balls.nrrd", "--out", folder + "/balls.vtu", "--quiet"])
    python = peak_bytes([sys.executable, "-c", PYTHON.format(shape=shape, spacing=SPACING), folder + "/balls.raw"])
    return command, python


def write_images(folder, shape):
    labels = balls(shape)
    write_nrrd(folder + "/balls.nrrd", labels, SPACING)
    labels.tofile(folder + "/balls.raw")


class Memory(unittest.TestCase):
    def test_it_is_the_command_s(self):
        with tempfile.TemporaryDirectory() as folder:
            command, python = measure(folder, (165, 353, 438))
        print(f"peak: command {command / 1e6:.0f} MB, Python {python / 1e6:.0f} MB, ratio {python / command:.3f}")
        self.assertLess(python, MOST * command)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
