"""The peak of memory is within 1.2 of the command's, for a mid-size image: the liver, of 25 million voxels, with the default preset."""
import gzip
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import unittest

import testing_support  # noqa: F401: numpy, or the test is skipped

LIVER = pathlib.Path(os.environ["CBC3D_DATA_FOLDER"]) / "liver.inr.gz"
MOST = 1.2
PYTHON = """
import numpy, cbc3d
labels = numpy.fromfile({file!r}, "uint8").reshape({shape})
mesh = cbc3d.mesh(labels, {spacing})
assert len(mesh.tets) > 100000
"""


def read_header(image):
    """Of an INRIMAGE: 256 bytes of NAME=VALUE lines."""
    return dict(line.split("=", 1) for line in image[:256].decode().splitlines() if "=" in line)


def peak_bytes(command):
    """Of the child, which begins as small as /usr/bin/env does."""
    child = subprocess.Popen(["/usr/bin/env", *command], stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == 0, command
    return usage.ru_maxrss * 1024


def median_peaks(python, command):
    """The peak of one run depends on how its threads took turns, by some 50 MB on a busy machine; so the median of five counts."""
    runs = int(os.environ.get("CBC3D_MEMORY_RUNS", "5"))
    pairs = [(peak_bytes(python), peak_bytes(command)) for _ in range(runs)]
    return [statistics.median(peaks) for peaks in zip(*pairs)]


def unpack(file):
    """In a child, for a child's peak is not below its parent's."""
    script = f"import gzip, pathlib; pathlib.Path({file!r}).write_bytes(gzip.open({str(LIVER)!r}).read()[256:])"
    subprocess.run([sys.executable, "-c", script], check=True)


@unittest.skipIf(not LIVER.exists(), "there is no liver image (ci/setup fetches it)")
class Memory(unittest.TestCase):
    def test_it_is_the_command_s(self):
        with gzip.open(LIVER) as image:
            header = read_header(image.read(256))
        shape = tuple(int(header[name]) for name in ("ZDIM", "YDIM", "XDIM"))
        spacing = tuple(float(header[name]) for name in ("VX", "VY", "VZ"))
        with tempfile.TemporaryDirectory() as folder:
            unpack(folder + "/liver.raw")
            script = PYTHON.format(file=folder + "/liver.raw", shape=shape, spacing=spacing)
            mesh = [os.environ["CBC3D_COMMAND"], "mesh", str(LIVER), "--out", folder + "/liver.vtu", "--quiet"]
            python, command = median_peaks([sys.executable, "-c", script], mesh)
        print(f"peak: command {command / 1e6:.0f} MB, Python {python / 1e6:.0f} MB, ratio {python / command:.3f}")
        self.assertLess(python, MOST * command)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
