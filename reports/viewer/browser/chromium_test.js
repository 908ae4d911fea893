import assert from 'node:assert/strict';
import test from 'node:test';

import {MessageSplitter} from './chromium.js';

test('messages are whole however they come', () => {
  const messages = [];
  const splitter = new MessageSplitter((message) => messages.push(message));
  const bytes = Buffer.from('{"id":1,"x":"ä"}\0{"id":2}\0');
  for (const size of [1, 3, bytes.length]) {
    for (let at = 0; at < bytes.length; at += size) splitter.add(bytes.subarray(at, at + size));
  }
  assert.deepEqual(messages.map(({id}) => id), [1, 2, 1, 2, 1, 2]);
  assert.equal(messages[0].x, 'ä');
});
