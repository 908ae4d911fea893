// The meshes of the page, from the bytes that reports/viewer/mesh_payload.hpp describes.

export const ANGLE_STEPS = 3.5; // of a degree
export const RATIO_STEPS = 250;

/** Reads numbers that are stored with all their lowest bytes first, then all second ones, and so on. */
export class PlaneReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  read(count, planes) {
    if (this.at + count * planes > this.bytes.length) throw new Error('the mesh is cut short');
    const numbers = new Uint32Array(count);
    for (let plane = 0; plane < planes; ++plane) {
      for (let n = 0; n < count; ++n) numbers[n] += this.bytes[this.at + n] * 2 ** (8 * plane);
      this.at += count;
    }
    return numbers;
  }
}

function positionsOf(reader, count, header, centre) {
  const positions = new Float32Array(3 * count);
  for (let axis = 0; axis < 3; ++axis) {
    const steps = reader.read(count, 2);
    let place = 0;
    for (let v = 0; v < count; ++v) {
      place = (place + steps[v]) & 0xffff;
      positions[3 * v + axis] = header.origin[axis] - centre[axis] + place * header.step[axis];
    }
  }
  return positions;
}

function cornersOf(reader, count) {
  const codes = [0, 1, 2, 3].map(() => reader.read(count, 3));
  const corners = new Uint32Array(4 * count);
  let used = 0;
  for (let t = 0; t < count; ++t) {
    const first = used + 3 - codes[0][t];
    corners[4 * t] = first;
    for (let n = 1; n < 4; ++n) corners[4 * t + n] = corners[4 * t + n - 1] - codes[n][t];
    used = Math.max(used, first + 1);
  }
  return corners;
}

function labelsOf(reader, count) {
  const steps = reader.read(count, 2);
  const labels = new Uint16Array(count);
  let label = 0;
  for (let t = 0; t < count; ++t) labels[t] = label = (label + steps[t]) & 0xffff;
  return labels;
}

/** The centre of the box around a mesh. */
export function centreOf(header) {
  return header.origin.map((low, axis) => low + (65535 / 2) * header.step[axis]);
}

/**
 * The mesh of a header and its inflated bytes; positions in mm from `centre`. Of each tet the corners, the label's
 * number, the smallest dihedral angle and the mean ratio in steps, and bit i of `boundary` where the face opposite its
 * corner i is a facet.
 */
export function decodeMesh(header, bytes, centre = centreOf(header)) {
  const reader = new PlaneReader(bytes);
  const positions = positionsOf(reader, header.vertices, header, centre);
  const corners = cornersOf(reader, header.tets);
  const labels = labelsOf(reader, header.tets);
  const angle = Uint8Array.from(reader.read(header.tets, 1));
  const ratio = Uint8Array.from(reader.read(header.tets, 1));
  const boundary = Uint8Array.from(reader.read(header.tets, 1));
  return {positions, corners, labels, angle, ratio, boundary, count: header.tets};
}

/** The bytes of base64 text that were deflated. */
export async function inflate(text) {
  const packed = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
