// A face is the same, bit for bit, wherever it is read: WebAssembly gives the digests that every compiler's tests have.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {basename} from 'node:path';
import test from 'node:test';
import {fileURLToPath} from 'node:url';
import {everyFile} from './native.js';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const native = process.env.SWEEPFACE_DIGEST ?? here('../../build/release/web/test/web_digest');
const code = readFileSync(here('../../build/wasm/web/digest.wasm'));
const {exports: module} = (await WebAssembly.instantiate(code)).instance;
module._initialize();

function digests(file) {
  const bytes = readFileSync(file), place = module.malloc(bytes.length);
  new Uint8Array(module.memory.buffer).set(bytes, place);
  const answer = module.digest(place, bytes.length);  // memory may grow, and is another buffer then
  const text = Buffer.from(module.memory.buffer, answer);
  module.free(place);
  return text.toString('latin1', 0, text.indexOf(0));
}

const golden = here('../../tests/codec/');
for (const line of readFileSync(golden + 'golden_digests.txt', 'utf8').trim().split('\n')) {
  const [name, ...expected] = line.split(' ');
  test(`${name} is what it always was`, () => assert.equal(digests(golden + name), expected.join(' ')));
}

for (const file of everyFile())
  test(`${basename(file)} is what the native library reads`,
       () => assert.equal(digests(file), execFileSync(native, [file], {encoding: 'latin1'}).trimEnd()));
