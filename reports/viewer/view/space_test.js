import assert from 'node:assert/strict';
import test from 'node:test';

import {cutPlane, radiusOf, worstPoints} from './space.js';

const header = {origin: [10, 20, 30], step: [2 / 65535, 4 / 65535, 8 / 65535]}; // a box of 2 x 4 x 8 mm
const centre = [11, 22, 34];
const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, `${a} ${b}`);

test('a cut goes through the box from end to end', () => {
  assert.equal(cutPlane('', 0.5, false, header, centre), null);
  near(cutPlane('y', 0.5, false, header, centre).offset, 0);
  near(cutPlane('z', 0.75, false, header, centre).offset, 2);
  const end = cutPlane('x', 1, false, header, centre).offset;
  assert.ok(end < 1 && end > 0.99);
  near(cutPlane('x', 0.5, false, header, [0, 0, 0]).offset, 11);
});

test('the other side is the same plane', () => {
  const {normal, offset} = cutPlane('x', 0.25, true, header, centre);
  assert.equal(normal[0], -1);
  near(offset, 0.5);
});

test('a cut that faces the camera has its direction', () => {
  const {normal, offset} = cutPlane('view', 0.5, false, header, centre, [3, 0, 4]);
  [0.6, 0, 0.8].forEach((one, n) => near(normal[n], one));
  near(offset, 0);
});

test('places are around the centre', () => {
  near(radiusOf(header), Math.hypot(1, 2, 4));
  assert.deepEqual(worstPoints({points: [0, 0, 0, 1, 2, 3]}, header, centre), [-1, -2, -4, 0, 0, -1]);
});
