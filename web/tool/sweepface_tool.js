// The tool as functions: it runs in a worker, on files in memory.

const isNode = Boolean(globalThis.process?.versions?.node);

/** A module of Node; its name is no constant, so that no bundler looks for it. */
const nodeModule = (name) => import(/* @vite-ignore */ /* webpackIgnore: true */ `node:${name}`);

async function fetchModule(url) {
  if (isNode && url.protocol === 'file:') return (await nodeModule('fs/promises')).readFile(url);
  const response = await fetch(url);
  if (!response.ok) throw new Error(`Could not load ${url}: the server answered ${response.status}.`);
  return response.arrayBuffer();
}

let compiled;
/** The module beside this file, fetched and compiled once. */
function moduleBeside() {
  compiled ??= fetchModule(new URL('./sweepface_tool.wasm', import.meta.url)).then((code) => WebAssembly.compile(code));
  compiled.catch(() => compiled = undefined);  // to try again
  return compiled;
}

/** Starts a worker, which calls `heard` with its messages and `failed` with why it ended. */
async function startWorker(heard, failed) {
  if (isNode) {
    const {Worker: Thread} = await nodeModule('worker_threads');
    return new Thread(new URL('./tool_thread.js', import.meta.url)).on('message', heard).on('error', failed);
  }
  const worker = new Worker(new URL('./tool_thread.js', import.meta.url), {type: 'module'});
  worker.addEventListener('message', ({data}) => heard(data));
  worker.addEventListener('error', (event) => failed(new Error(event.message || 'its worker did not start')));
  return worker;
}

function bytesOf(given, name) {
  if (typeof given === 'string') return new TextEncoder().encode(given);
  if (given instanceof ArrayBuffer) return new Uint8Array(given);
  if (ArrayBuffer.isView(given)) return new Uint8Array(given.buffer, given.byteOffset, given.byteLength);
  throw new TypeError(`The file ${name} must be given as bytes or as a text.`);
}

/** "sweepface: 42 % fitting" in what the tool prints as it works. */
const PROGRESS = /^sweepface: (\d+) % (.*)$/;

/** Runs the tool; see sweepface_tool.d.ts. */
export async function runTool(args, {files = {}, onProgress, signal, wasm} = {}) {
  const given = Object.fromEntries(Object.entries(files).map(([name, bytes]) => [name, bytesOf(bytes, name)]));
  const module = await (wasm ?? moduleBeside());
  signal?.throwIfAborted();
  let settle;
  const result = new Promise((resolve, reject) => settle = {resolve, reject});
  const fail = (message) => settle.reject(new Error(`The tool failed: ${message}.`));
  let errors = '';
  const worker = await startWorker(({line, failure, ...ended}) => {
    const progress = line?.match(PROGRESS);
    if (progress) onProgress?.({share: Number(progress[1]) / 100, what: progress[2]});
    else if (line !== undefined) errors += line + '\n';
    else if (failure !== undefined) fail(failure);
    else settle.resolve({...ended, errors});
  }, ({message}) => fail(message));
  const stop = () => settle.reject(signal.reason);
  signal?.addEventListener('abort', stop);
  if (signal?.aborted) stop();
  worker.postMessage({module, args: args.map(String), files: given, tellsProgress: Boolean(onProgress)});
  try {
    return await result;
  } finally {
    signal?.removeEventListener('abort', stop);
    worker.terminate();
  }
}

/** {maxBytes: 65536, pack: true, mesh: ['A', 'B']} as --max-bytes 65536 --pack --mesh A --mesh B. */
function words(options) {
  return Object.entries(options).flatMap(([key, value]) => {
    const name = '--' + key.replace(/[A-Z]/g, (letter) => '-' + letter.toLowerCase());
    if (value === undefined || value === null || value === false) return [];
    if (value === true) return [name];
    if (key === 'strip' && Array.isArray(value)) return value.length > 0 ? [name, value.join(',')] : [];
    return [value].flat().flatMap((one) => [name, String(one)]);
  });
}

/** Of the names of meshes those that are targets: what comes with a .gltf or an .obj is not. */
const isMesh = (name) => /\.(obj|ply)$/i.test(name);

/** Converts a model into a .sweep file; see sweepface_tool.d.ts. */
export async function convert(given, {onProgress, signal, wasm, ...options} = {}) {
  const isOne = ArrayBuffer.isView(given) || given instanceof ArrayBuffer;
  const files = isOne ? {'model.glb': given} : given;
  const [first, ...others] = Object.keys(files);
  if (first === undefined) throw new TypeError('convert() needs a model.');
  const targets = isMesh(first) ? others.filter(isMesh) : [];
  const output = 'converted.sweep';
  const ran = await runTool(
    ['convert', '--json', '-o', output, ...words(options), '--', first, ...targets],
    {files, onProgress, signal, wasm});
  const messages = ran.errors.split('\n').filter((line) => line !== '').map((line) => line.replace(/^sweepface: /, ''));
  if (ran.code !== 0) throw new Error(messages[0] ?? `The tool ended with ${ran.code}.`);
  return {
    bytes: ran.files[output],
    report: JSON.parse(ran.output),
    warnings: messages.map((message) => message.replace(/^warning: /, '')),
  };
}
