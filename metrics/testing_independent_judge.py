#!/usr/bin/env python3
"""Computes figures of a tetrahedral mesh again, from its file alone and without any code of the harness.

Usage: testing_independent_judge.py MESH.vtu...
Needs numpy (Debian: python3-numpy). The conventions are those of metrics/README.md; the tests and `cbc3d-bench evaluate`
must agree with what is printed here to all the digits that are printed.
"""
import base64
import re
import sys
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

TYPES = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4", "UInt8": "<u1", "Int16": "<i2"}
EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
FACES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))  # counter-clockwise seen from outside


def read_vtu(path):
    """Returns the points, the tets and the labels of a VTU file with compressed, appended arrays."""
    data = open(path, "rb").read()
    start = data.index(b"<AppendedData")
    encoding = re.search(rb'encoding="(\w+)"', data[start:start + 100]).group(1)
    blob = data[data.index(b"_", start) + 1:]
    tree = ElementTree.fromstring(data[:start] + b"</VTKFile>")
    assert tree.get("compressor") == "vtkZLibDataCompressor"
    word = np.dtype({"UInt32": "<u4", "UInt64": "<u8"}[tree.get("header_type", "UInt32")])

    def raw(offset, size):
        if encoding == b"raw":
            return blob[offset:offset + size]
        return base64.b64decode(blob[offset:offset + 4 * ((size + 2) // 3)])[:size]

    def array(element):
        offset = int(element.get("offset"))
        blocks = int(np.frombuffer(raw(offset, word.itemsize), word)[0])
        header_size = (3 + blocks) * word.itemsize
        sizes = np.frombuffer(raw(offset, header_size), word)[3:]
        body = offset + (header_size if encoding == b"raw" else 4 * ((header_size + 2) // 3))
        packed, text, at = raw(body, int(sizes.sum())), b"", 0
        for size in sizes:
            text += zlib.decompress(packed[at:at + int(size)])
            at += int(size)
        return np.frombuffer(text, TYPES[element.get("type")])

    arrays = {}
    for element in tree.iter("DataArray"):
        arrays[element.get("Name")] = array(element)
    assert (arrays["types"] == 10).all(), "only tets are judged here"
    return arrays["Points"].astype(float).reshape(-1, 3), arrays["connectivity"].reshape(-1, 4), arrays["label"]


def norm(vectors):
    return np.sqrt((vectors * vectors).sum(axis=-1))


def rank(values, percent):
    """The smallest value that at least so many percent of the values do not exceed."""
    return np.sort(values)[max(int(np.ceil(len(values) * percent / 100)) - 1, 0)]


def element_figures(points, tets):
    p = points[tets]
    six_volumes = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0])
    lengths = np.stack([norm(p[:, a] - p[:, b]) for a, b in EDGES], axis=1)
    areas = np.stack([norm(np.cross(p[:, b] - p[:, a], p[:, c] - p[:, a])) / 2 for a, b, c in FACES], axis=1)
    volumes = six_volumes / 6
    inradius = 3 * volumes / areas.sum(axis=1)
    # Circumradius by the products of opposite edges (Crelle).
    a, b, c = lengths[:, 0] * lengths[:, 5], lengths[:, 1] * lengths[:, 4], lengths[:, 2] * lengths[:, 3]
    product = np.maximum((a + b + c) * (a + b - c) * (a - b + c) * (-a + b + c), 0)
    circumradius = np.sqrt(product) / (24 * volumes)
    mean_ratio = 12 * np.cbrt(3 * volumes) ** 2 / (lengths ** 2).sum(axis=1)
    heights = 3 * volumes[:, None] / areas
    return {"mean_ratio": mean_ratio, "radius_ratio": 3 * inradius / circumradius,
            "edge_ratio": lengths.max(axis=1) / lengths.min(axis=1),
            "height_ratio": np.sqrt(1.5) * heights.min(axis=1) / lengths.max(axis=1)}, volumes


def facet_table(tets):
    """All facets with their sorted corners, equal ones side by side: corners as oriented, cell."""
    oriented = np.concatenate([tets[:, f] for f in FACES])
    cells = np.tile(np.arange(len(tets)), 4)
    keys = np.sort(oriented, axis=1)
    order = np.lexsort((cells, keys[:, 2], keys[:, 1], keys[:, 0]))
    return oriented[order], keys[order], cells[order]


def gradation_figures(points, tets, volumes, pairs, surface):
    edges = np.unique(np.sort(np.concatenate([tets[:, e] for e in EDGES]), axis=1), axis=0)
    lengths = norm(points[edges[:, 0]] - points[edges[:, 1]])
    ends, both = np.concatenate([edges[:, 0], edges[:, 1]]), np.concatenate([lengths, lengths])
    valence = np.bincount(ends, minlength=len(points))
    longest, shortest = np.zeros(len(points)), np.full(len(points), np.inf)
    np.maximum.at(longest, ends, both)
    np.minimum.at(shortest, ends, both)
    used = valence > 0
    size = np.cbrt(np.abs(volumes))
    ratio = np.maximum(size[pairs[:, 0]] / size[pairs[:, 1]], size[pairs[:, 1]] / size[pairs[:, 0]])
    inside = used.copy()
    inside[surface] = False
    return valence[used], (longest / shortest)[used], ratio, inside.sum(), used.sum()


def surface_figures(points, facets):
    """Angles at edges with exactly two facets; facets off the area-weighted normals of their corners."""
    p = points[facets]
    area_vectors = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]) / 2
    unit = area_vectors / norm(area_vectors)[:, None]
    rows = np.concatenate([facets[:, (0, 1)], facets[:, (1, 2)], facets[:, (2, 0)]])
    of = np.tile(np.arange(len(facets)), 3)
    keys = np.sort(rows, axis=1)
    order = np.lexsort((of, keys[:, 1], keys[:, 0]))
    keys, of = keys[order], of[order]
    starts = np.flatnonzero(np.r_[True, (keys[1:] != keys[:-1]).any(axis=1)])
    counts = np.diff(np.r_[starts, len(keys)])
    first = starts[counts == 2]
    angle = np.degrees(np.arccos(np.clip((unit[of[first]] * unit[of[first + 1]]).sum(axis=1), -1, 1)))
    length = norm(points[keys[first, 0]] - points[keys[first, 1]])
    sums = np.zeros_like(points)
    for corner in range(3):
        np.add.at(sums, facets[:, corner], area_vectors)
    normals = sums / np.maximum(norm(sums), 1e-300)[:, None]
    cosines = np.stack([(unit * normals[facets[:, c]]).sum(axis=1) for c in range(3)], axis=1)
    mean = normals[facets].sum(axis=1)
    mean /= np.maximum(norm(mean), 1e-300)[:, None]
    squares = sum((norm(p[:, a] - p[:, b]) ** 2 for a, b in ((0, 1), (1, 2), (2, 0))))
    return {"angle": angle, "length": length, "cosines": cosines, "mean_cosine": (unit * mean).sum(axis=1),
            "mean_ratio": 4 * np.sqrt(3) * norm(area_vectors) / squares}


def print_quantiles(name, values):
    print(f"  {name:14} min {values.min():.4g}  .1 % {rank(values, .1):.4g}  1 % {rank(values, 1):.4g}  5 % {rank(values, 5):.4g}"
          f"  median {rank(values, 50):.4g}  99 % {rank(values, 99):.4g}  max {values.max():.4g}  below .3: {100 * (values < .3).mean():.4g} %")


def print_surface(name, figures):
    angle, cosines, length = figures["angle"], figures["cosines"], figures["length"]
    print(f"  {name}: rms {np.sqrt((angle ** 2).mean()):.4g} (by length {np.sqrt((length * angle ** 2).sum() / length.sum()):.4g})"
          f"  95 % {rank(angle, 95):.4g}  99 % {rank(angle, 99):.4g}"
          f"  over 60, 90, 120: {(angle > 60).sum()} {(angle > 90).sum()} {(angle > 120).sum()}"
          f"  facets {len(cosines)}  off normal {100 * (figures['mean_cosine'] < .5).mean():.4g} %  off corner {100 * (cosines.min(axis=1) < .5).mean():.4g} %"
          f"  mean ratio median {rank(figures['mean_ratio'], 50):.4g} min {figures['mean_ratio'].min():.4g}")


def judge(path):
    points, tets, labels = read_vtu(path)
    print(f"{path}: {len(tets)} tets, {len(points)} vertices")
    shapes, volumes = element_figures(points, tets)
    for name, values in shapes.items():
        print_quantiles(name, values)
    oriented, keys, cells = facet_table(tets)
    same = (keys[1:] == keys[:-1]).all(axis=1)
    second = np.flatnonzero(same) + 1
    pairs = np.stack([cells[second - 1], cells[second]], axis=1)
    lone = np.ones(len(keys), bool)
    lone[second] = lone[second - 1] = False
    between = second[labels[pairs[:, 0]] != labels[pairs[:, 1]]]
    valence, edge_ratio, size_ratio, inside, used = gradation_figures(points, tets, volumes, pairs, np.unique(keys[lone]))
    print(f"  valence max {valence.max()}  99 % {rank(valence, 99)}; edges at a vertex, longest over shortest: 99 % {rank(edge_ratio, 99):.4g} max {edge_ratio.max():.4g}")
    print(f"  size ratio of neighbours: 99 % {rank(size_ratio, 99):.4g} max {size_ratio.max():.4g}; {inside} of {used} vertices inside")
    print_surface("outer", surface_figures(points, oriented[lone]))
    for label in np.unique(labels):
        mine = np.concatenate([oriented[lone & (labels[cells] == label)], oriented[between][labels[cells[between]] == label],
                               oriented[between - 1][labels[cells[between - 1]] == label]])
        print_surface(f"label {label}", surface_figures(points, mine))


for argument in sys.argv[1:]:
    judge(argument)
