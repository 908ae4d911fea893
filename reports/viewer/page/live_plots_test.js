import assert from 'node:assert/strict';
import test from 'node:test';

import {nearestPoint, tipPlace} from './live_plots.js';

test('the nearest point within reach is found', () => {
  const points = [{x: 0, y: 0}, {x: 10, y: 0}, {x: 100, y: 100}];
  assert.equal(nearestPoint(points, 6, 1), 1);
  assert.equal(nearestPoint(points, 50, 50), -1);
  assert.equal(nearestPoint([], 0, 0), -1);
});

test('a tip stays within the window', () => {
  const size = {width: 100, height: 40};
  const phone = {width: 390, height: 800};
  assert.deepEqual(tipPlace(10, 10, size, phone), {left: 24, top: 24});
  for (const [x, y] of [[380, 790], [200, 400], [0, 795], [389, 0]]) {
    const {left, top} = tipPlace(x, y, size, phone);
    assert.ok(left >= 0 && left + size.width <= phone.width, `${x} ${left}`);
    assert.ok(top >= 0 && top + size.height <= phone.height, `${y} ${top}`);
  }
});
