import assert from 'node:assert/strict';
import test from 'node:test';

import {colouring, cornerColours, rgbOf, scaleColour} from './colours.js';

test('the scale gets lighter all the way and stays at its ends', () => {
  const lightness = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
  for (let n = 1; n <= 20; ++n) assert.ok(lightness(scaleColour(n / 20)) > lightness(scaleColour((n - 1) / 20)));
  assert.deepEqual(scaleColour(-3), scaleColour(0));
  assert.deepEqual(scaleColour(7), scaleColour(1));
});

test('tets have the colour of their label or of their quality', () => {
  const mesh = {labels: [1, 0], angle: [0, 247], ratio: [250, 0]};
  const byLabel = colouring(mesh, ['#ff0000', '#0010ff'], 'label');
  assert.deepEqual([byLabel(0), byLabel(1)], [[0, 16, 255], [255, 0, 0]]);
  const byAngle = colouring(mesh, [], 'angle');
  assert.deepEqual([byAngle(0), byAngle(1)], [scaleColour(0), scaleColour(1)]);
  assert.deepEqual(colouring(mesh, [], 'ratio')(0), scaleColour(1));
  assert.deepEqual(rgbOf('#d96b5c'), [217, 107, 92]);
});

test('all corners of a triangle have its colour', () => {
  const colours = cornerColours({count: 2, tets: [5, 6]}, (tet) => [tet, 0, 1]);
  assert.deepEqual([...colours], [5, 0, 1, 5, 0, 1, 5, 0, 1, 6, 0, 1, 6, 0, 1, 6, 0, 1]);
});
