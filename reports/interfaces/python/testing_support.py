"""What the tests of the Python package share."""
import importlib
import pathlib
import sys


def needs(*modules):
    """Imports modules, or ends the test as skipped, saying which one is missing."""
    found = []
    for name in modules:
        try:
            found.append(importlib.import_module(name))
        except ImportError as error:
            print(f"skipped: {error}")
            sys.exit(77)
    return found


numpy, = needs("numpy")


def two_balls(axes="kji", dtype="uint8"):
    """Balls of labels 3 and 8 with a common interface, in 40 x 32 x 24 voxels of 1 x 1 x 1.25 mm; spacing is in SPACING."""
    i, j, k = numpy.meshgrid(numpy.arange(40), numpy.arange(32), numpy.arange(24), indexing="ij")
    x, y, z = i * SPACING[0], j * SPACING[1], k * SPACING[2]
    labels = numpy.zeros(i.shape, dtype, order="F")
    labels[(x - 25) ** 2 + (y - 16) ** 2 + (z - 15) ** 2 < 81] = 8
    labels[(x - 14) ** 2 + (y - 16) ** 2 + (z - 15) ** 2 < 81] = 3
    return labels if axes == "ijk" else labels.transpose()


def write_nrrd(path, array, spacing):
    """An uncompressed NRRD of array[k, j, i] in LPS."""
    kinds = {"uint8": "uint8", "int16": "int16"}
    k, j, i = array.shape
    directions = " ".join("(" + ",".join(str(spacing[a] if a == b else 0) for b in range(3)) + ")" for a in range(3))
    header = (f"NRRD0004\ntype: {kinds[str(array.dtype)]}\ndimension: 3\nspace: left-posterior-superior\nsizes: {i} {j} {k}\n"
              f"space directions: {directions}\nspace origin: (0,0,0)\nkinds: domain domain domain\nendian: little\n"
              "encoding: raw\n\n")
    pathlib.Path(path).write_bytes(header.encode() + numpy.ascontiguousarray(array).tobytes())


SPACING = (1.0, 1.0, 1.25)
