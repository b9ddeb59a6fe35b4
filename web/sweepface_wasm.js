// Loads the WebAssembly modules and calls the C interface in them (include/sweepface/sweepface.h).
import {bytesOf, isGiven, kindOf, told} from './sweepface_values.js';

/** The message where only the usual module was given, which has no messages of its own. */
export const UNSAID = 'sweepface.wasm cannot do that with this face; give sweepface_full.wasm, which can or says why.';

const encoder = new TextEncoder(), decoder = new TextDecoder();

/** Memory ran out, which another module would not change. */
export class MemoryError extends Error {
  constructor(cause, advice = '') {
    super(`There is not enough memory for the face${advice}.`, {cause});
  }
}

/**
 * Fetches and compiles the module at a URL. Browsers cache the code of a module that they compile while it streams.
 * Node's fetch does not read files.
 */
async function fetchModule(url) {
  if (url.protocol === 'file:' && globalThis.process?.versions?.node) {
    const files = 'node:fs/promises';  // in a variable, so that no bundler looks for it
    return WebAssembly.compile(await (await import(/* @vite-ignore */ /* webpackIgnore: true */ files)).readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`the server answered ${response.status}.`);
  const type = response.headers.get('content-type') ?? '';
  if (type === 'application/wasm' && WebAssembly.compileStreaming)  // which refuses parameters in the type
    return WebAssembly.compileStreaming(response);
  const code = await response.arrayBuffer();
  if (/^text\/html/i.test(type) && !isModule(code)) throw new Error('the server sent a page of HTML instead.');
  return WebAssembly.compile(code);
}

/** Whether bytes are a module. Servers that do not know modules may give them any type. */
const isModule = (code) => decoder.decode(code.slice(0, 4)) === '\0asm';

/** Why a module was not compiled. Browsers ask for 'unsafe-eval', which allows far more than is needed. */
const reason = ({message}) => /unsafe-eval|blocked by CSP/.test(message)
  ? "the page's Content-Security-Policy forbids it; add 'wasm-unsafe-eval' to its script-src." : message;

async function compileUrl(url) {
  try {
    return await fetchModule(url);
  } catch (error) {
    throw new Error(`Could not load ${url}: ${reason(error)}`, {cause: error});
  }
}

/** The modules beside this file: one that plays packed faces, and one for all files and options. */
const MODULES = {
  usual: () => new URL('./sweepface.wasm', import.meta.url),
  full: () => new URL('./sweepface_full.wasm', import.meta.url)
};

export function urlOf(wasm) {
  const text = typeof wasm === 'string' ? wasm : wasm.href;
  try {
    if (text && typeof text === 'string') return new URL(text, globalThis.document?.baseURI ?? globalThis.location?.href);
  } catch {}  // it is relative to nothing
  throw new TypeError(`The option wasm is an absolute URL, bytes or a WebAssembly.Module, not ${told(wasm)}.`);
}

function besideThisFile(kind) {
  try {
    return MODULES[kind]();
  } catch (error) {  // bundled as something other than a module
    throw new Error('This build does not know where sweepface.wasm is; tell it by the option wasm.', {cause: error});
  }
}

async function compileBytes(code) {
  try {
    return await WebAssembly.compile(code);
  } catch (error) {
    const what = isModule(code) ? 'a module of WebAssembly that does not compile' : 'no module of WebAssembly';
    throw new Error(`The option wasm holds ${what}: ${reason(error)}`, {cause: error});
  }
}

const compiled = {};  // by kind, each compiled once
export function compile(wasm, kind) {
  if (kindOf(wasm) === 'WebAssembly.Module') return wasm;
  const code = bytesOf(wasm);  // not all engines compile a DataView
  if (code) return compileBytes(code);
  if (isGiven(wasm)) return compileUrl(urlOf(wasm));
  compiled[kind] ??= compileUrl(besideThisFile(kind)).catch((error) => {
    delete compiled[kind];
    throw error;
  });
  return compiled[kind];
}

export const isCompiled = (kind) => compiled[kind] !== undefined;

/** Browsers allow about a hundred memories at once, however small. */
export async function instantiate(module) {
  try {
    return await WebAssembly.instantiate(module);
  } catch (error) {
    if (!(error instanceof RangeError)) throw error;
    throw new MemoryError(error, '; dispose of others, or clone() those of one file');
  }
}

/** A text as C has it. */
export const bytesOfText = (text) => encoder.encode(text + '\0');

/** One instance of the module: a file and the faces made from it. Its memory is freed with it. */
export class Runtime {
  /** `memory` is that of another instance of the module, if this one is to go on where that one was. */
  constructor(instance, memory) {
    this.wasm = Object.fromEntries(Object.entries(instance.exports).map(([name, it]) => {
      return [name, typeof it === 'function' ? this.watched(it) : it];
    }));
    this.wasm._initialize();
    if (memory) this.#goOn(memory);
    this.isDead = false;
  }

  /** All that an instance knows is in its memory, between calls. */
  #goOn(memory) {
    const own = this.wasm.memory, lacking = memory.byteLength - own.buffer.byteLength;
    try {
      if (lacking > 0) own.grow(lacking / 65536);
    } catch (error) {
      throw new MemoryError(error);
    }
    new Uint8Array(own.buffer).set(new Uint8Array(memory));
  }

  /** Wraps a function of the module. When memory runs out the module traps, and cannot be used from then on. */
  watched(call) {
    return (...parameters) => {
      try {
        return call(...parameters);
      } catch (error) {
        if (!(error instanceof WebAssembly.RuntimeError)) throw error;
        this.isDead = true;
        throw new MemoryError(error);
      }
    };
  }

  // Memory moves when it grows, so views are made where they are used. Addresses from 2 GiB on are negative.
  bytes(at, length) { return new Uint8Array(this.wasm.memory.buffer, at >>> 0, length); }
  words(at, length) { return new Uint32Array(this.wasm.memory.buffer, at >>> 0, length); }
  shorts(at, length) { return new Int16Array(this.wasm.memory.buffer, at >>> 0, length); }
  floats(at, length) { return new Float32Array(this.wasm.memory.buffer, at >>> 0, length); }
  doubles(at, length) { return new Float64Array(this.wasm.memory.buffer, at >>> 0, length); }

  text(at) {
    const memory = new Uint8Array(this.wasm.memory.buffer);
    return decoder.decode(memory.subarray(at >>> 0, memory.indexOf(0, at >>> 0)));
  }

  allocate(size) {
    const at = this.wasm.malloc(Math.max(size, 8));
    if (at === 0) throw new MemoryError();
    return at;
  }

  /** Calls `use` with the address of `size` bytes, freed afterwards. */
  room(size, use) {
    const at = this.allocate(size);
    try {
      return use(at);
    } finally {
      this.wasm.free(at);
    }
  }

  /** Calls `use` with the address of a copy of the bytes. */
  lend(bytes, use) {
    return this.room(bytes.length, (at) => {
      this.bytes(at, bytes.length).set(bytes);
      return use(at);
    });
  }

  lendText(text, use) { return this.lend(bytesOfText(text), use); }

  /** Throws the module's message if a call failed; `unsaid` if it is the usual module, which has none. */
  check(status, unsaid = UNSAID) {
    if (status !== 0) throw new Error(this.text(this.wasm.sweepface_message()) || unsaid);
  }

  /** Calls a function whose last parameter points to a 32-bit result, and returns that. */
  get(name, ...parameters) {
    return this.room(4, (out) => {
      this.check(this.wasm[name](...parameters, out));
      return this.words(out, 1)[0];
    });
  }

  loadRig(bytes, name) {
    return this.lend(bytes, (at) => this.lendText(name, (text) => {
      return this.get('sweepface_rig_load_neutral', at, bytes.length, text);
    }));
  }
}
