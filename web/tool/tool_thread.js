// The worker of sweepface-tool: runs the module once.
import {MemoryFiles} from './tool_memory.js';
import {Wasi} from './tool_wasi.js';

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

async function run({module, args, files: given, tellsProgress}, tell) {
  const files = new MemoryFiles(given), decoder = new TextDecoder();
  let output = '';
  const wasi = new Wasi({
    args: ['sweepface', ...args],
    env: tellsProgress ? {SWEEPFACE_PROGRESS: '1'} : {},
    files,
    output: {isTerminal: false, write: (bytes) => output += decoder.decode(bytes, {stream: true})},
    errors: {isTerminal: false, write: lines((line) => tell({line}))},
  });
  const code = await wasi.run(module);
  tell({code, output, files: files.written()});
}

function serve(port, listen) {
  const tell = (message) => port.postMessage(message);
  listen((job) => run(job, tell).catch((error) => tell({failure: error.message})));
}

// Bundlers make scripts of workers in which nothing can be awaited.
const threads = 'node:worker_threads';  // in a variable, so that no bundler looks for it
if (globalThis.postMessage)
  serve(globalThis, (hear) => addEventListener('message', ({data}) => hear(data)));
else
  import(/* @vite-ignore */ /* webpackIgnore: true */ threads)
    .then(({parentPort}) => serve(parentPort, (hear) => parentPort.on('message', hear)));
