import assert from 'node:assert/strict';
import test from 'node:test';

import {facesOf, sectionOf, surfaceOf} from './surface.js';

// The corner of a cube, and its mirror image beyond the plane x + y + z = 1, as labels 0 and 1; all faces but the common
// one are outside, and that one is between labels.
const mesh = {
  positions: Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1]),
  corners: Uint32Array.from([3, 2, 1, 0, 4, 3, 2, 1]),
  labels: Uint16Array.from([0, 1]),
  boundary: Uint8Array.from([15, 15]),
  count: 2,
};

const triangle = ({positions}, n) => [0, 3, 6].map((at) => [...positions.subarray(9 * n + at, 9 * n + at + 3)]);
const minus = (a, b) => a.map((x, n) => x - b[n]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a.reduce((sum, x, n) => sum + x * b[n], 0);
const areaVector = ([a, b, c]) => cross(minus(b, a), minus(c, a)).map((x) => x / 2);
const area = (triangles) => Array.from({length: triangles.count}, (_, n) => Math.hypot(...areaVector(triangle(triangles, n))))
  .reduce((sum, one) => sum + one, 0);

test('every facet is drawn, outwards, for the tet that it belongs to', () => {
  const surface = surfaceOf(mesh, [true, true]);
  assert.equal(surface.count, 8);
  assert.deepEqual([...surface.tets], [0, 0, 0, 0, 1, 1, 1, 1]);
  const centres = [[0.25, 0.25, 0.25], [0.5, 0.5, 0.5]];
  for (let n = 0; n < surface.count; ++n) {
    const corners = triangle(surface, n);
    assert.ok(dot(areaVector(corners), minus(corners[0], centres[surface.tets[n]])) > 0, `triangle ${n}`);
  }
});

test('labels that are off are not drawn, and what is no facet neither', () => {
  assert.deepEqual([...surfaceOf(mesh, [false, true]).tets], [1, 1, 1, 1]);
  assert.equal(surfaceOf({...mesh, boundary: Uint8Array.from([0b0001, 0])}, [true, true]).count, 1);
});

test('a section of one corner is a triangle, of two a quadrilateral without its diagonal', () => {
  const one = sectionOf(mesh, [true, false], {normal: [0, 0, 1], offset: 0.5});
  assert.equal(one.count, 1);
  assert.ok(Math.abs(area(one) - 1 / 8) < 1e-6);
  const two = sectionOf(mesh, [true, false], {normal: [1, 1, 0], offset: 0.5});
  assert.equal(two.count, 2);
  // Between (.5,0,0) (0,.5,0) (0,.5,.5) (.5,0,.5): a rectangle of sqrt(.5) by .5.
  assert.ok(Math.abs(area(two) - Math.SQRT1_2 / 2) < 1e-6);
  const hidden = [0, 1].map((n) => [0, 1, 2].filter((side) => [0, 3, 6].every((corner) => two.sides[9 * n + corner + side] === 255)));
  assert.deepEqual(hidden.map((sides) => sides.length), [1, 1]);
  assert.ok(triangle(two, 0).every((point) => Math.abs(point[0] + point[1] - 0.5) < 1e-6));
});

test('a plane beside the mesh has no section', () => {
  assert.equal(sectionOf(mesh, [true, true], {normal: [1, 0, 0], offset: 3}).count, 0);
});

test('single tets have four faces, and many make the list grow', () => {
  const tet = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
  assert.equal(facesOf([tet]).count, 4);
  assert.equal(facesOf([]).count, 0);
  const many = {...mesh, corners: new Uint32Array(4 * 5000).map((_, n) => mesh.corners[n % 4]), labels: new Uint16Array(5000),
    boundary: new Uint8Array(5000).fill(15), count: 5000};
  assert.equal(surfaceOf(many, [true]).count, 20000);
});
