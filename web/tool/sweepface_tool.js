// The tool as functions: it runs in a worker, on files in memory.

const isNode = Boolean(globalThis.process?.versions?.node);

/** A module of Node; its name is no constant, so that no bundler looks for it. */
const nodeModule = (name) => import(/* @vite-ignore */ /* webpackIgnore: true */ `node:${name}`);

async function fetchCode(url) {
  if (isNode && url.protocol === 'file:') return (await nodeModule('fs/promises')).readFile(url);
  const response = await fetch(url);
  if (!response.ok) throw new Error(`Could not load ${url}: the server answered ${response.status}.`);
  const code = await response.arrayBuffer();
  if (!WebAssembly.validate(code.slice(0, 8)))
    throw new Error(`Could not load ${url}: the server sent something else; see docs/web-tool.md for bundlers.`);
  return code;
}

let compiled;
/** The module beside this file, fetched and compiled once. */
function moduleBeside() {
  compiled ??= fetchCode(new URL('./sweepface_tool.wasm', import.meta.url)).then((code) => WebAssembly.compile(code));
  compiled.catch(() => compiled = undefined);  // to try again
  return compiled;
}

/** The module that is given: compiled, as bytes, or where it is. */
async function moduleOf(wasm) {
  if (wasm === undefined || wasm === null) return moduleBeside();
  if (wasm instanceof WebAssembly.Module) return wasm;
  const isPlace = wasm instanceof URL || typeof wasm === 'string';
  return WebAssembly.compile(isPlace ? await fetchCode(new URL(wasm, globalThis.location?.href)) : wasm);
}

/** Starts a worker, which calls `heard` with its messages and `failed` with why it ended. */
async function startWorker(heard, failed) {
  if (isNode) {
    const {Worker: Thread} = await nodeModule('worker_threads');
    const file = new URL('./tool_thread.js', import.meta.url);
    return new Thread(file, {execArgv: []}).on('message', heard).on('error', failed)
      .on('exit', () => failed(new Error('its worker ended')));
  }
  const worker = new Worker(new URL('./tool_thread.js', import.meta.url), {type: 'module'});
  worker.addEventListener('message', ({data}) => heard(data));
  worker.addEventListener('error', (event) => failed(new Error(event.message || 'its worker did not start')));
  return worker;
}

async function bytesOf(given, name) {
  if (typeof given === 'string') return new TextEncoder().encode(given);
  if (given instanceof Blob) return new Uint8Array(await given.arrayBuffer());
  if (given instanceof ArrayBuffer) return new Uint8Array(given);
  if (ArrayBuffer.isView(given)) return new Uint8Array(given.buffer, given.byteOffset, given.byteLength);
  throw new TypeError(`${name} must be given as bytes, a Blob or a text.`);
}

/** "sweepface: 42 % fitting" in what the tool prints as it works. */
const PROGRESS = /^sweepface: (\d+) % (.*)$/;

/** Lets a worker work; resolves with its last message, and rejects with why there is none. */
function work(job, {onProgress, signal}) {
  let worker, hasEnded = false, errors = '', stop;
  const ended = new Promise((resolve, reject) => {
    const fail = ({message}) => reject(new Error(`The tool failed: ${message}.`));
    const hear = ({line, failure, ...result}) => {
      const progress = line?.match(PROGRESS);
      if (failure !== undefined) return fail({message: failure});
      if (line === undefined) return resolve({...result, errors});
      if (!progress) errors += line + '\n';
      else onProgress?.({share: Number(progress[1]) / 100, what: progress[2]});
    };
    const heard = (message) => {
      try {
        hear(message);
      } catch (error) {  // of the caller's own function
        reject(error);
      }
    };
    stop = () => reject(signal.reason);
    signal?.addEventListener('abort', stop);
    if (signal?.aborted) return stop();
    startWorker(heard, fail).then((started) => {
      worker = started;
      if (hasEnded) worker.terminate(); else worker.postMessage(job);
    }).catch(reject);
  });
  return ended.finally(() => {
    hasEnded = true;
    signal?.removeEventListener('abort', stop);
    worker?.terminate();
  });
}

/** Runs the tool; see sweepface_tool.d.ts. */
export async function runTool(args, {files = {}, wasm, ...options} = {}) {
  if (!Array.isArray(args)) throw new TypeError("The words of a command are a list, such as ['info', 'face.sweep'].");
  const given = await Promise.all(Object.entries(files).map(async ([name, file]) => [name, await bytesOf(file, name)]));
  const module = await moduleOf(wasm);
  options.signal?.throwIfAborted();
  const job = {module, args: args.map(String), files: given, tellsProgress: Boolean(options.onProgress)};
  return work(job, options);
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

/** The files of a model, of which the first is the one to convert. */
function filesOf(model) {
  if (ArrayBuffer.isView(model) || model instanceof ArrayBuffer) return {'model.glb': model};
  if (model instanceof Blob) return {[model.name ?? 'model.glb']: model};
  if (typeof model !== 'object' || model === null || Object.keys(model).length === 0)
    throw new TypeError("convert() needs a model: the bytes of a .glb, a File, or {'neutral.obj': bytes, ...}.");
  return model;
}

const OPTIONS = ['tolerance', 'pack', 'maxBytes', 'mesh', 'strip', 'bare', 'subdivide', 'normalLimit', 'normalTolerance',
                 'uvBits', 'arcs', 'shapes'];

/** Of the names of files those that are targets: what comes with a .gltf or an .obj is not. */
const isMesh = (name) => /\.(obj|ply)$/i.test(name);

/** Converts a model into a .sweep file; see sweepface_tool.d.ts. */
export async function convert(model, {onProgress, signal, wasm, ...options} = {}) {
  const unknown = Object.keys(options).find((key) => !OPTIONS.includes(key));
  if (unknown !== undefined) throw new TypeError(`convert() has no option '${unknown}'; it has ${OPTIONS.join(', ')}.`);
  const {shapes = true, ...others} = options, files = filesOf(model), output = 'converted.sweep';
  const [first, ...rest] = Object.keys(files);
  const targets = isMesh(first) ? rest.filter(isMesh) : [];
  const ran = await runTool(['convert', '--json', '-o', output, ...words({...others, noShapes: !shapes}), '--', first, ...targets],
                            {files, onProgress, signal, wasm});
  const messages = ran.errors.split('\n').filter((line) => line !== '').map((line) => line.replace(/^sweepface: /, ''));
  if (ran.code !== 0) throw new Error(messages[0] ?? `The tool ended with ${ran.code}.`);
  return {
    bytes: ran.files[output],
    report: JSON.parse(ran.output),
    warnings: messages.map((message) => message.replace(/^warning: /, '')),
  };
}
