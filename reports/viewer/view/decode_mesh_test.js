import assert from 'node:assert/strict';
import test from 'node:test';
import {deflateSync} from 'node:zlib';

import {centreOf, decodeMesh, inflate, PlaneReader} from './decode_mesh.js';

/** Numbers with all lowest bytes first, as mesh_payload.cpp writes them. */
const planes = (numbers, count) => Array.from({length: count}, (_, plane) => numbers.map((n) => (n >> (8 * plane)) & 255)).flat();

// Two tets with a common face: vertices 3 2 1 0, then 4 3 2 1.
const header = {vertices: 5, tets: 2, origin: [10, 20, 30], step: [0.5, 1, 2], worst: []};
const bytes = Uint8Array.from([
  ...planes([0, 2, 0xffff, 0, 1], 2), // x: 0 2 1 1 2
  ...planes([0, 0, 300, 0, 0], 2), // y: 0 0 300 300 300
  ...planes([7, 0, 0, 0xfffa, 0], 2), // z: 7 7 7 1 1
  ...planes([0, 3], 3), ...planes([1, 1], 3), ...planes([1, 1], 3), ...planes([1, 1], 3),
  ...planes([1, 0xffff], 2), 35, 70, 250, 125, 1, 15,
]);

test('a mesh is read as it was written', () => {
  const mesh = decodeMesh(header, bytes, [10, 20, 30]);
  assert.deepEqual([...mesh.corners], [3, 2, 1, 0, 4, 3, 2, 1]);
  assert.deepEqual([...mesh.positions], [0, 0, 14, 1, 0, 14, 0.5, 300, 14, 0.5, 300, 2, 1, 300, 2]);
  assert.deepEqual([...mesh.labels], [1, 0]);
  assert.deepEqual([[...mesh.angle], [...mesh.ratio], [...mesh.boundary]], [[35, 70], [250, 125], [1, 15]]);
});

test('a mesh that is cut short is refused', () => {
  assert.throws(() => decodeMesh(header, bytes.subarray(0, bytes.length - 1)), /cut short/);
});

test('large numbers have three planes', () => {
  assert.deepEqual([...new PlaneReader(Uint8Array.from([1, 2, 0, 1, 1, 0])).read(2, 3)], [65537, 258]);
});

test('what was deflated and written in base64 comes back', async () => {
  const text = deflateSync(bytes).toString('base64');
  assert.deepEqual(await inflate(text), bytes);
});

test('the centre is that of the box', () => {
  assert.deepEqual(centreOf({origin: [0, 0, -65535], step: [2, 1, 2]}), [65535, 32767.5, 0]);
});
