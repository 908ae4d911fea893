#!/usr/bin/env python3
"""Frames of generated headers against readers that are not ours: frames.py CBC3D FOLDER

Writes NIfTI-1 and -2 files (all pairs of qform and sform codes, units, byte orders, both handednesses), NRRD files (spaces in
their spellings, units, spacings with mins) and MetaImage files (matrices, anatomical orientations), asks `CBC3D info --json` where
their corner voxels lie and compares with nibabel for NIfTI and with the few lines below for the others: within a
tenth of a voxel, or refused in words. Ends with 0 when all agree, 77 where nibabel is missing.
"""
import itertools
import json
import math
import os
import random
import struct
import subprocess
import sys

try:
    import nibabel
    import numpy
except ImportError:
    print("frames.py: python3-nibabel is missing")
    sys.exit(77)

SIZE = (5, 4, 3)
CORNERS = [(i * 4, j * 3, k * 2) for i, j, k in itertools.product((0, 1), repeat=3)]
VOXELS = bytes(n % 3 for n in range(60))
RAS_TO_LPS = numpy.diag([-1, -1, 1, 1])


def rotation(rng):
    """A random rotation by a unit quaternion, whose real part is positive."""
    q = [rng.gauss(0, 1) for _ in range(4)]
    norm = math.sqrt(sum(x * x for x in q))
    a, b, c, d = (x / norm * (1 if q[0] > 0 else -1) for x in q)
    return (b, c, d), numpy.array([
        [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
        [2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)],
        [2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c]])


def nifti(rng, version, order, qform, sform, unit):
    """A header, and whether it may be refused."""
    spacing = [rng.uniform(0.3, 3) for _ in range(3)]
    quaternion, _ = rotation(rng)
    _, turned = rotation(rng)
    matrix = turned * numpy.array(spacing) * numpy.array([1, 1, rng.choice((-1, 1))])
    origin = [rng.uniform(-100, 100) for _ in range(6)]
    header = nibabel.Nifti2Header(endianness=order) if version == 2 else nibabel.Nifti1Header(endianness=order)
    header.set_data_shape(SIZE)
    header.set_data_dtype(numpy.uint8)
    header["pixdim"][:4] = [rng.choice((-1, 1))] + spacing
    header["qform_code"], header["sform_code"] = qform, sform
    header["quatern_b"], header["quatern_c"], header["quatern_d"] = quaternion
    header["qoffset_x"], header["qoffset_y"], header["qoffset_z"] = origin[:3]
    for row, name in enumerate(("srow_x", "srow_y", "srow_z")):
        header[name] = list(matrix[row]) + [origin[3 + row]]
    header["xyzt_units"] = unit
    header["vox_offset"] = 544 if version == 2 else 352
    header["magic"] = b"n+2" if version == 2 else b"n+1"
    header["scl_slope"], header["scl_inter"] = 1, 0
    return header.binaryblock + bytes(4) + VOXELS


def expected_nifti(path, unit):
    """nibabel's choice of the affine, its unit in mm; where no code is set, the standard's method 1."""
    header = nibabel.load(path).header
    if header["sform_code"] > 0:
        affine = header.get_sform()
    elif header["qform_code"] > 0:
        affine = header.get_qform()
    else:
        affine = numpy.diag(list(header["pixdim"][1:4]) + [1])
    mm = {1: 1000, 3: 0.001}.get(unit & 7, 1)
    return numpy.diag([mm, mm, mm, 1]) @ RAS_TO_LPS @ affine


SPACES = {"left-posterior-superior": (1, 1), "LPS": (1, 1), "Left-Posterior-Superior": (1, 1),
          "right-anterior-superior": (-1, -1), "RAS": (-1, -1), "ras": (-1, -1),
          "left-anterior-superior": (1, -1), "LAS": (1, -1)}
UNITS = {None: 1, "mm": 1, "um": 1e-3, "microns": 1e-3, "\u00b5m": 1e-3, "cm": 10, "m": 1000, "nm": 1e-6}


def nrrd(rng, space, unit):
    _, turned = rotation(rng)
    scale = 1 / UNITS[unit]
    steps = turned * [rng.uniform(0.3, 3) * scale for _ in range(3)]
    origin = [rng.uniform(-100, 100) * scale for _ in range(3)]
    text = f"NRRD0005\ntype: uchar\ndimension: 3\nspace: {space}\nsizes: 5 4 3\nencoding: raw\nspace directions:"
    text += "".join(" (" + ",".join(repr(float(x)) for x in steps[:, axis]) + ")" for axis in range(3)) + "\n"
    if unit:
        text += "space units: " + " ".join(['"%s"' % unit] * 3) + "\n"
    return (text + "space origin: (" + ",".join(repr(x) for x in origin) + ")\n\n").encode() + VOXELS


def expected_nrrd(path):
    fields = {}
    for line in open(path, "rb").read().split(b"\n\n")[0].decode().split("\n")[1:]:
        key, value = line.split(": ", 1)
        fields[key] = value
    if "space" not in fields:
        spacing = [float(x) for x in fields["spacings"].split()]
        mins = [float(x) for x in fields.get("axis mins", "nan nan nan").split()]
        node = fields.get("centerings", "").startswith("node")
        origin = [0 if math.isnan(m) else m + (0 if node else s / 2) for m, s in zip(mins, spacing)]
        return numpy.array([[spacing[0], 0, 0, origin[0]], [0, spacing[1], 0, origin[1]],
                            [0, 0, spacing[2], origin[2]], [0, 0, 0, 1]])
    unit = fields.get("space units", '"mm" ').split('"')[1]
    vectors = [[float(x) for x in v.strip("()").split(",")]
               for v in fields["space directions"].split() + [fields["space origin"]]]
    affine = numpy.vstack([numpy.array(vectors).T, [0, 0, 0, 1]])
    x, y = SPACES[fields["space"]]
    return numpy.diag([x * UNITS[unit], y * UNITS[unit], UNITS[unit], 1]) @ affine


def plain_nrrd(rng, mins, centering):
    text = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 5 4 3\nencoding: raw\nspacings: %r %r %r\n" % tuple(
        rng.uniform(0.3, 3) for _ in range(3))
    if mins:
        text += "axis mins: %r %r %r\n" % tuple(rng.uniform(-50, 50) for _ in range(3))
    if centering:
        text += f"centerings: {centering} {centering} {centering}\n"
    return (text + "\n").encode() + VOXELS


LETTERS = {"R": (1, 0, 0), "L": (-1, 0, 0), "A": (0, 1, 0), "P": (0, -1, 0), "I": (0, 0, 1), "S": (0, 0, -1)}


def metaimage(rng, letters, matrix):
    text = "ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementType = MET_UCHAR\n"
    text += "ElementSpacing = %r %r %r\n" % tuple(rng.uniform(0.3, 3) for _ in range(3))
    text += rng.choice(("Offset", "Origin", "Position")) + " = %r %r %r\n" % tuple(rng.uniform(-50, 50) for _ in range(3))
    if matrix:
        _, turned = rotation(rng)
        text += matrix + " = " + " ".join(repr(float(x)) for x in turned.T.flatten()) + "\n"
    if letters:
        text += f"AnatomicalOrientation = {letters}\n"
    return (text + "ElementDataFile = LOCAL\n").encode() + VOXELS


def expected_metaimage(path):
    fields = {}
    for line in open(path, "rb").read().decode("latin-1").split("\n"):
        if " = " in line:
            key, value = line.split(" = ", 1)
            fields[key] = value
    first = lambda *keys: next((fields[k] for k in keys if k in fields), None)
    matrix = first("TransformMatrix", "Orientation", "Rotation")
    if matrix:
        axes = numpy.array([float(x) for x in matrix.split()]).reshape(3, 3).T
    else:
        letters = fields.get("AnatomicalOrientation", "RAI")
        axes = numpy.array([LETTERS[c] for c in letters]).T
    affine = numpy.eye(4)
    affine[:3, :3] = axes * [float(x) for x in fields["ElementSpacing"].split()]
    affine[:3, 3] = [float(x) for x in first("Offset", "Origin", "Position").split()]
    return affine


def ours(command, path):
    run = subprocess.run([command, "info", path, "--json"], capture_output=True, text=True)
    if run.returncode != 0:
        return None, run.stderr.strip() or run.stdout.strip()
    info = json.loads(run.stdout)
    affine = numpy.eye(4)
    affine[:3, :3] = numpy.array(info["axes"]).T * info["spacing_mm"]
    affine[:3, 3] = info["origin_mm"]
    return affine, ""


def cases(rng):
    for version, order, qform, sform, unit in itertools.product((1, 2), "<>", (0, 1, 4), (0, 2, 3), (0, 1, 2, 3, 10)):
        yield ".nii", nifti(rng, version, order, qform, sform, unit), lambda path, u=unit: expected_nifti(path, u)
    for space, unit in itertools.product(SPACES, UNITS):
        yield ".nrrd", nrrd(rng, space, unit), expected_nrrd
    for mins, centering in itertools.product((False, True), (None, "cell", "node")):
        yield ".nrrd", plain_nrrd(rng, mins, centering), expected_nrrd
    orientations = ["".join(o) for axes in itertools.permutations(("RL", "AP", "IS")) for o in itertools.product(*axes)]
    for letters in orientations:
        yield ".mha", metaimage(rng, letters, None), expected_metaimage
    for matrix, letters in itertools.product(("TransformMatrix", "Orientation", "Rotation"), (None, "RAI", "???")):
        yield ".mha", metaimage(rng, letters, matrix), expected_metaimage


def main():
    command, folder = sys.argv[1:3]
    rng = random.Random(21)
    count = refused = failed = 0
    for suffix, content, expected in cases(rng):
        path = os.path.join(folder, f"frame{count}{suffix}")
        with open(path, "wb") as file:
            file.write(content)
        count += 1
        affine, words = ours(command, path)
        if affine is None:
            refused += 1
            if not words.startswith("cbc3d: "):
                failed += 1
                print(f"{path}: no words: {words}")
            continue
        wanted = expected(path)
        voxel = min(numpy.linalg.norm(wanted[:3, axis]) for axis in range(3))
        apart = max(numpy.linalg.norm(((affine - wanted) @ [*corner, 1])[:3]) for corner in CORNERS)
        if not apart <= 0.1 * voxel:
            failed += 1
            print(f"{path}: voxel centres {apart:g} mm apart, voxel {voxel:g} mm")
    print(f"{count} headers, {refused} refused in words, {failed} failed")
    return 1 if failed or count < 200 or refused > count // 20 else 0


if __name__ == "__main__":
    sys.exit(main())
