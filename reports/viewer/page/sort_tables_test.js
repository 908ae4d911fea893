import assert from 'node:assert/strict';
import test from 'node:test';

import {compareCells, numberOf, orderRows} from './sort_tables.js';

const cell = (text) => ({text, number: numberOf(text)});
const sorted = (texts, direction) => {
  const rows = texts.map((text) => [cell(text)]);
  return orderRows(rows, 0, direction).map((n) => texts[n]);
};

test('numbers are read as the tables write them', () => {
  assert.equal(numberOf('1,234,567 [1,200-1,300]'), 1234567);
  assert.equal(numberOf('0.5 missed (label 4) [1]'), 0.5);
  assert.equal(numberOf('-3.25'), -3.25);
  assert.equal(numberOf('12.34', '12.3449'), 12.3449);
  assert.ok(Number.isNaN(numberOf('- [2]')));
  assert.equal(numberOf('25%'), 25);
  for (const text of ['liver', '2-boxes', '']) assert.ok(Number.isNaN(numberOf(text)), text);
});

test('numbers go by size, not by digits, and a missing figure is last either way', () => {
  assert.deepEqual(sorted(['10', '-', '9', '1,000'], 1), ['9', '10', '1,000', '-']);
  assert.deepEqual(sorted(['10', '- [1]', '9', '1,000'], -1), ['1,000', '10', '9', '- [1]']);
});

test('texts go by the alphabet, numbers within them by size', () => {
  assert.deepEqual(sorted(['phantom-10', 'Liver', 'phantom-9'], 1), ['Liver', 'phantom-9', 'phantom-10']);
  assert.equal(compareCells(cell('a'), cell('1'), -1) > 0, true);
});

test('equal rows stay in their order', () => {
  const rows = [[cell('1'), cell('a')], [cell('0'), cell('b')], [cell('1'), cell('c')]];
  assert.deepEqual(orderRows(rows, 0, 1), [1, 0, 2]);
  assert.deepEqual(orderRows(rows, 0, -1), [0, 2, 1]);
});

test('figures of different units are sorted apart', () => {
  const rows = [['a', 'mm', '3'], ['a', 'deg', '1'], ['b', 'mm', '2'], ['b', 'deg', '4']].map((row) => row.map(cell));
  assert.deepEqual(orderRows(rows, 2, 1, 1), [2, 0, 1, 3]);
  assert.deepEqual(orderRows(rows, 0, -1, 1), [2, 3, 0, 1], 'the columns before have no unit');
});
