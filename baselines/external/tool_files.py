"""Files of tools with command lines, and their runs."""
import subprocess

import numpy
import peer


def run_tool(command):
    """Runs a tool; the last line that it says is the reason when it fails."""
    ended = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    if ended.returncode != 0:
        lines = [line for line in ended.stdout.splitlines() if line.strip()] or ["no word"]
        raise peer.Failed(f"{command[0]} ended with {ended.returncode}: {lines[-1]}")


def write_nrrd(path, materials, spacing_mm):
    """Labels of two bytes with their spacing and no other frame."""
    header = f"NRRD0004\ntype: uint16\ndimension: 3\nsizes: {' '.join(map(str, materials.shape))}\nencoding: raw\n" \
             f"endian: little\nspacings: {' '.join(repr(float(s)) for s in spacing_mm)}\n\n"
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(materials.astype("<u2").tobytes(order="F"))


def read_rows(path):
    """The rows of a .node or .ele file of TetGen, without its first line and comments."""
    with open(path, encoding="utf-8") as file:
        rows = [line.split("#")[0].split() for line in file]
    rows = [row for row in rows if row]
    return numpy.array(rows[1:1 + int(rows[0][0])], float)
