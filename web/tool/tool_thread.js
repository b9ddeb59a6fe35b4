// The worker of sweepface-tool: runs the module once.
import {MemoryFiles} from './tool_memory.js';
import {Wasi} from './tool_wasi.js';

const threads = 'node:worker_threads';  // in a variable, so that no bundler looks for it
const port = globalThis.postMessage ? globalThis
                                    : (await import(/* @vite-ignore */ /* webpackIgnore: true */ threads)).parentPort;

/** Calls `tell` with every line of what is written. */
function lines(tell) {
  const decoder = new TextDecoder();
  let begun = '';
  return (bytes) => {
    const all = (begun + decoder.decode(bytes, {stream: true})).split('\n');
    begun = all.pop();
    for (const line of all) tell(line);
  };
}

async function run({module, args, files: given, tellsProgress}) {
  const files = new MemoryFiles(given), decoder = new TextDecoder();
  let output = '';
  const wasi = new Wasi({
    args: ['sweepface', ...args],
    env: tellsProgress ? {SWEEPFACE_PROGRESS: '1'} : {},
    files,
    output: {isTerminal: false, write: (bytes) => output += decoder.decode(bytes, {stream: true})},
    errors: {isTerminal: false, write: lines((line) => port.postMessage({line}))},
  });
  const code = await wasi.run(module);
  port.postMessage({code, output, files: files.written()});
}

const hear = (message) => run(message).catch((error) => port.postMessage({failure: error.message}));
if (port.on) port.on('message', hear); else port.addEventListener('message', ({data}) => hear(data));
