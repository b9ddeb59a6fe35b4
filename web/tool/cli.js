#!/usr/bin/env node
// The tool on the command line. It works in a thread of its own, so that this one can be interrupted.
import fs from 'node:fs';
import tty from 'node:tty';
import {isMainThread, parentPort, Worker} from 'node:worker_threads';

import {currentFolder, place, wordOf} from './tool_places.js';
import {Wasi} from './tool_wasi.js';

const INTERRUPTED = 130, PIPE_CLOSED = 141;  // as shells tell them

/** Writes all bytes, also to a pipe that is full for a moment. Where nobody reads any more, the work ends silently. */
function writeAll(stream, bytes) {
  for (let begin = 0; begin < bytes.length;) {
    try {
      begin += fs.writeSync(stream, bytes, begin);
    } catch (error) {
      if (error.code === 'EPIPE') {
        parentPort.postMessage({code: PIPE_CLOSED});
        process.exit();
      }
      if (error.code !== 'EAGAIN') throw error;
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 5);
    }
  }
}

/** The files of this machine. `begun` and `ended` are told of files that are written beside others to replace them. */
function filesOf(begun, ended) {
  return {
    ...fs,
    openSync(path, how, mode) {
      const file = fs.openSync(path, how, mode);
      if (how & fs.constants.O_EXCL) begun(path);
      return file;
    },
    /** The module knows no permissions: a file that may not be written stays, and what replaces one gets its permissions. */
    renameSync(from, to) {
      if (fs.existsSync(to)) {
        fs.accessSync(to, fs.constants.W_OK);
        fs.chmodSync(from, fs.statSync(to).mode & 0o777);
      }
      fs.renameSync(from, to);
      ended(from);
    },
    unlinkSync(path) {
      fs.unlinkSync(path);
      ended(path);
    },
  };
}

/** Runs the module; returns its exit code. */
async function run() {
  const streamOf = (number) => ({isTerminal: tty.isatty(number), write: (bytes) => writeAll(number, bytes)});
  const wasi = new Wasi({
    args: ['sweepface', ...process.argv.slice(2).map(wordOf)],
    env: {...process.env, PWD: currentFolder()},
    files: filesOf((begun) => parentPort.postMessage({begun}), (ended) => parentPort.postMessage({ended})),
    place,
    output: streamOf(1),
    errors: streamOf(2),
  });
  const module = await WebAssembly.compile(fs.readFileSync(new URL('sweepface_tool.wasm', import.meta.url)));
  return wasi.run(module);
}

/** Lets a thread do the work, and ends it when a signal asks for that. */
function supervise() {
  const worker = new Worker(new URL(import.meta.url), {argv: process.argv.slice(2), execArgv: []});
  const begun = new Set();
  let hasEnded = false;
  const end = (code, sentence) => {
    if (hasEnded) return;
    hasEnded = true;
    if (sentence) process.stderr.write(`${process.stderr.isTTY ? '\r\x1b[K' : ''}sweepface: ${sentence}\n`);
    process.exitCode = code;
  };
  worker.on('message', (message) => {
    if (message.begun !== undefined) begun.add(message.begun);
    else if (message.ended !== undefined) begun.delete(message.ended);
    else end(message.code);
  });
  worker.on('error', ({message}) => end(1, `The tool failed: ${message}.`));
  worker.on('exit', () => {
    for (const path of begun) fs.rmSync(path, {force: true});
    end(1, 'The tool failed: its thread ended.');
  });
  const stop = () => {
    end(INTERRUPTED, 'Interrupted; no unfinished file is left.');
    worker.terminate();
  };
  for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) process.once(signal, stop);
}

if (isMainThread) supervise(); else parentPort.postMessage({code: await run()});
