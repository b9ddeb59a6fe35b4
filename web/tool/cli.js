#!/usr/bin/env node
// The tool on the command line: the module with the files of the machine.
import fs from 'node:fs';

import {place, pathOf, wordOf} from './tool_places.js';
import {Wasi} from './tool_wasi.js';

/** Writes all bytes, also to a pipe that is full for a moment. */
function writeAll(stream, bytes) {
  for (let begin = 0; begin < bytes.length;) {
    try {
      begin += fs.writeSync(stream, bytes, begin);
    } catch (error) {
      if (error.code !== 'EAGAIN') throw error;
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 5);
    }
  }
}
/** The module knows no permissions: a file that may not be written stays, and what replaces one gets its permissions. */
function renameSync(from, to) {
  if (fs.existsSync(to)) {
    fs.accessSync(to, fs.constants.W_OK);
    fs.chmodSync(from, fs.statSync(to).mode & 0o777);
  }
  fs.renameSync(from, to);
}

const streamOf = (number, stream) =>
  ({isTerminal: Boolean(stream.isTTY), write: (bytes) => writeAll(number, bytes)});

const wasi = new Wasi({
  args: ['sweepface', ...process.argv.slice(2).map(wordOf)],
  env: {...process.env, PWD: pathOf(process.cwd())},
  files: {...fs, renameSync},
  place,
  output: streamOf(1, process.stdout),
  errors: streamOf(2, process.stderr),
});
try {
  const module = await WebAssembly.compile(fs.readFileSync(new URL('sweepface_tool.wasm', import.meta.url)));
  process.exitCode = await wasi.run(module);
} catch (error) {
  console.error(`sweepface: The tool failed: ${error.message}.`);
  process.exitCode = 1;
}
