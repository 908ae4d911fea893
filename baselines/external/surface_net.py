"""The surfaces between labels, for meshers that fill closed surfaces.

A surface net (Gibson, MICCAI 1998) on a grid of a chosen size: labels are told apart by their masks, blurred by a Gaussian of 0.4
grid edges; a grid cell that sees more than one region has one vertex, the mean of the places where its edges change label; four
cells around such an edge have a quadrilateral. It conforms: where three labels meet they share edges and vertices. Means lie inside what
is curved, and so do flat triangles: each vertex then goes as far away from the mean of its neighbours as it is from it, which gives
back most of the volume. Vertices stay within 0.45 of their cell's edges from its centre, so that no two of them meet. Labels thinner
than about a grid edge are lost.
"""
from dataclasses import dataclass

import numpy
from scipy import ndimage

REACH = 0.45
BLUR = 0.4


@dataclass
class Net:
    """Points in index mm; the normals of triangles lead from `sides[:, 0]` to `sides[:, 1]`. Sides are regions, 0 the outside;
    `materials[r]` is what region r is of. Regions are connected by faces of the grid; holes are regions of the material 0."""

    points: numpy.ndarray
    triangles: numpy.ndarray
    sides: numpy.ndarray
    materials: numpy.ndarray


def sample_masks(volume, size_mm):
    """Blurred masks of all materials on the grid, and the grid's origin and edges in index mm."""
    spacing = volume.spacing_mm
    box = ndimage.find_objects((volume.materials > 0).astype(numpy.int32))[0]
    low = numpy.array([s.start for s in box]) - 1
    high = numpy.array([s.stop for s in box])
    voxels = numpy.pad(volume.materials[box], 1)
    counts = numpy.maximum(2, numpy.ceil((high - low) * spacing / size_mm)).astype(int) + 3
    edges = (high - low) * spacing / (counts - 3)
    origin = low * spacing - edges
    axes = [(origin[a] + numpy.arange(counts[a]) * edges[a]) / spacing[a] - low[a] for a in range(3)]
    masks = numpy.zeros((len(volume.values), *counts), numpy.float32)
    for material in range(1, len(volume.values)):
        mask = ndimage.gaussian_filter((voxels == material).astype(numpy.float32), BLUR * edges / spacing, mode="constant")
        masks[material] = resample(mask, axes)
    masks[0] = 1 - masks[1:].sum(axis=0)
    for axis in range(1, 4):  # a layer of background around all
        for end in (0, -1):
            masks.swapaxes(0, axis)[end, ...] = 0
            background = masks[0].swapaxes(0, axis - 1)
            background[end] = 1
    return masks, origin, edges


def resample(field, axes):
    """Linear interpolation along one axis after the other; 0 outside."""
    for axis, places in enumerate(axes):
        padded = numpy.concatenate([field, numpy.zeros_like(field.take([0], axis))], axis)
        floor = numpy.floor(places).astype(int)
        share = (places - floor).astype(numpy.float32).reshape([-1 if a == axis else 1 for a in range(3)])
        outside = field.shape[axis]
        lower = numpy.where((floor >= 0) & (floor < outside), floor, outside)
        upper = numpy.where((floor + 1 >= 0) & (floor + 1 < outside), floor + 1, outside)
        field = padded.take(lower, axis) * (1 - share) + padded.take(upper, axis) * share
    return field


def regions_of(labels):
    """Connected regions, the outside 0, and their materials."""
    regions, materials = numpy.zeros(labels.shape, numpy.int32), [0]
    for material in numpy.unique(labels):
        parts, count = ndimage.label(labels == material)
        for part in range(1, count + 1):
            is_outside = material == 0 and part == parts[0, 0, 0]
            if not is_outside:
                regions[parts == part] = len(materials)
                materials.append(int(material))
    return regions, numpy.array(materials)


def edge_crossings(masks, labels, regions):
    """For each axis: the grid points from which an edge to the next along it changes region, and where on it."""
    for axis in range(3):
        here = [slice(None)] * 3
        there = [slice(None)] * 3
        here[axis], there[axis] = slice(None, -1), slice(1, None)
        starts = numpy.argwhere(regions[tuple(here)] != regions[tuple(there)])
        ends = starts + numpy.eye(3, dtype=int)[axis]
        a, b = labels[tuple(starts.T)], labels[tuple(ends.T)]
        first = masks[(a, *starts.T)] - masks[(b, *starts.T)]
        last = masks[(b, *ends.T)] - masks[(a, *ends.T)]
        share = numpy.where(first + last > 0, first / numpy.maximum(first + last, 1e-12), 0.5)
        yield axis, starts, share


def surface_net(volume, size_mm):
    masks, origin, edges = sample_masks(volume, size_mm)
    labels = masks.argmax(axis=0)
    regions, materials = regions_of(labels)
    shape = numpy.array(labels.shape)
    flat = lambda cells: numpy.ravel_multi_index(tuple(numpy.moveaxis(cells, -1, 0)), shape)  # noqa: E731
    sums, counts = numpy.zeros((shape.prod(), 3)), numpy.zeros(shape.prod())
    quads, sides = [], []
    for axis, starts, share in edge_crossings(masks, labels, regions):
        u, v = numpy.eye(3, dtype=int)[(axis + 1) % 3], numpy.eye(3, dtype=int)[(axis + 2) % 3]
        places = starts + share[:, None] * numpy.eye(3)[axis]
        around = numpy.stack([starts - u - v, starts - v, starts, starts - u], axis=1)
        for corner in range(4):
            numpy.add.at(sums, flat(around[:, corner]), places)
            numpy.add.at(counts, flat(around[:, corner]), 1)
        quads.append(flat(around))
        ends = starts + numpy.eye(3, dtype=int)[axis]
        sides.append(numpy.stack([regions[tuple(starts.T)], regions[tuple(ends.T)]], axis=1))
    cells = numpy.flatnonzero(counts)
    if len(cells) == 0:
        return Net(numpy.zeros((0, 3)), numpy.zeros((0, 3), int), numpy.zeros((0, 2), int), materials)
    centres = numpy.stack(numpy.unravel_index(cells, shape), axis=1) + 0.5
    quads = numpy.searchsorted(cells, numpy.concatenate(quads))
    sides = numpy.concatenate(sides)
    means = sums[cells] / counts[cells, None]
    grown = 2 * means - means_of_neighbours(means, quads)
    points = numpy.clip(grown, centres - REACH, centres + REACH) * edges + origin
    return Net(points, halve(points, quads), numpy.repeat(sides, 2, axis=0), materials)


def means_of_neighbours(points, quads):
    sides = numpy.concatenate([quads[:, [0, 1]], quads[:, [1, 2]], quads[:, [2, 3]], quads[:, [3, 0]]])
    pairs = numpy.unique(numpy.sort(sides, axis=1), axis=0)
    sums, counts = numpy.zeros_like(points), numpy.zeros(len(points))
    for here, there in (pairs.T, pairs.T[::-1]):
        numpy.add.at(sums, here, points[there])
        numpy.add.at(counts, here, 1)
    return sums / counts[:, None]


def halve(points, quads):
    """Two triangles of each quadrilateral, along its shorter diagonal."""
    lengths = [numpy.linalg.norm(points[quads[:, a]] - points[quads[:, a + 2]], axis=1) for a in (0, 1)]
    turned = numpy.where((lengths[1] < lengths[0])[:, None], numpy.roll(quads, -1, axis=1), quads)
    return turned[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
