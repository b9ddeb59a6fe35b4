// Plays .sweep faces in browsers and in Node. What is called here is the C interface
// (include/sweepface/sweepface.h), compiled to WebAssembly.

/** How a weight may go to a goal, in the order of the C interface. */
const DRIVES = ['cut', 'newton', 'linear-force', 'accelerate-brake', 'spring', 'bounce'];
/** The numbers of a drive, in the order of the C struct. */
const DRIVE_NUMBERS = ['delay', 'seconds', 'turn', 'frequency', 'damping', 'restitution'];

/** What a level of detail may be asked for by, in the order of the C interface. */
const BUDGETS = ['edgeLength', 'error', 'vertices'];
const OPTIONS = ['lod', ...BUDGETS, 'name', 'arcs', 'combine', 'eyes', 'regions', 'wasm'];

/** How far a weight may be from 0. */
const MOST = 1e6;

/** What targets may follow, in the numbers of the C interface. */
const FOLLOW = {arcs: 1, combine: 2};

/** Chunks that hold things as they are, which takes a hundred times the bytes of a packed face. */
const AS_THEY_ARE = ['EXAC', 'loos', 'drif', 'ordr', 'poly', 'texc', 'quad'];

/** Where the usual module, which spares the words, is the only one that was given. */
const UNSAID = 'sweepface.wasm cannot do that with this face; give sweepface_full.wasm, which can or says why.';

const encoder = new TextEncoder(), decoder = new TextDecoder();

/** What kind of object something is, of any realm: frames and Node's vm have an ArrayBuffer of their own. */
const kindOf = (it) => Object.prototype.toString.call(it).slice(8, -1);

/** How a message calls what is no number. */
const told = (value) => (typeof value === 'string' ? `the text '${value}'` : String(value));

/** The bytes that are given, if any are. */
function bytesOf(source) {
  if (ArrayBuffer.isView(source)) return new Uint8Array(source.buffer, source.byteOffset, source.byteLength);
  if (kindOf(source) === 'ArrayBuffer') return new Uint8Array(source);
}

/** There is no more memory, which another module does not change. */
class MemoryError extends Error {
  constructor(cause, advice = '') {
    super(`There is not enough memory for the face${advice}.`, {cause});
  }
}

/**
 * The module behind a URL. Browsers keep what they make of one that they compile while it comes; Node's fetch does not
 * read files.
 */
async function compileUrl(url) {
  if (url.protocol === 'file:' && globalThis.process?.versions?.node) {
    const files = 'node:fs/promises';  // in a variable, so that no bundler looks for it
    return WebAssembly.compile(await (await import(/* @vite-ignore */ /* webpackIgnore: true */ files)).readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`Could not load ${url}: the server answered ${response.status}.`);
  const type = response.headers.get('content-type') ?? '';
  if (/^text\/html/i.test(type)) throw new Error(`Could not load ${url}: the server sent a page of HTML instead.`);
  const mayStream = type === 'application/wasm' && WebAssembly.compileStreaming;  // which refuses parameters
  return mayStream ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/** The modules beside this file: one for packed faces as they are, and one for all files with all there is. */
const MODULES = {
  usual: () => new URL('./sweepface.wasm', import.meta.url),
  full: () => new URL('./sweepface_full.wasm', import.meta.url)
};

function urlOf(wasm) {
  try {
    return new URL(wasm, globalThis.location?.href);
  } catch (error) {
    const not = `not ${told(wasm)}`;
    throw new TypeError(`The option wasm is an absolute URL, bytes or a WebAssembly.Module, ${not}.`, {cause: error});
  }
}

const compiled = {};  // each once
function compile(wasm, kind) {
  if (kindOf(wasm) === 'WebAssembly.Module') return wasm;
  const code = bytesOf(wasm);  // not all engines compile a DataView
  if (code) return WebAssembly.compile(code);
  if (wasm) return compileUrl(urlOf(wasm));
  compiled[kind] ??= compileUrl(MODULES[kind]()).catch((error) => {
    delete compiled[kind];
    throw error;
  });
  return compiled[kind];
}

/** Browsers have room for about a hundred memories at once, however small. */
async function instantiate(module) {
  try {
    return await WebAssembly.instantiate(module);
  } catch (error) {
    if (!(error instanceof RangeError)) throw error;
    throw new MemoryError(error, '; dispose of others, or clone() those of one file');
  }
}

/** One instance of the module: a file and the faces made from it. Its memory goes with it. */
class Runtime {
  constructor(instance) {
    this.wasm = Object.fromEntries(Object.entries(instance.exports).map(([name, it]) => {
      return [name, typeof it === 'function' ? this.watched(it) : it];
    }));
    this.wasm._initialize();
    this.users = 0;
    this.isDead = false;
  }

  /** Where memory runs out the module stops amid what it does, and is of no use from then on. */
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
  ints(at, length) { return new Int32Array(this.wasm.memory.buffer, at >>> 0, length); }
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

  /** Calls `use` with the address of room for that many bytes. */
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

  lendText(text, use) { return this.lend(encoder.encode(text + '\0'), use); }

  check(status) {
    if (status !== 0) throw new Error(this.text(this.wasm.sweepface_message()) || UNSAID);
  }

  /** What a function with a trailing out-parameter of 32 bits writes there. */
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

/** Whether a file holds nothing but what the usual module reads. */
function isPacked(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const kinds = [];
  for (let at = 8; at + 8 <= bytes.length; at += 12 + view.getUint32(at + 4, true))
    kinds.push(String.fromCharCode(...bytes.subarray(at, at + 4)));
  return bytes[7] === 2 && !kinds.some((kind) => AS_THEY_ARE.includes(kind));
}

/** What all faces of one file at one level of detail share. */
class Shared {
  constructor(instance, bytes, {name, follow, eyes, divide, lod, budget}) {
    const runtime = this.runtime = new Runtime(instance), {wasm} = runtime;
    this.rig = runtime.loadRig(bytes, name);
    if (follow || eyes) this.loadTargets();
    if (follow) runtime.check(wasm.sweepface_rig_follow(this.rig, follow));
    this.eyeCount = eyes ? runtime.get('sweepface_rig_turn_eyes', this.rig) : 0;
    this.regions = divide ? divide(runtime, this.rig) : null;  // with their matter; null: of one piece
    this.regionCount = this.regions?.length ?? 1;
    this.turnCount = wasm.sweepface_rig_turn_count(this.rig);
    this.mesh = budget ? runtime.get('sweepface_mesh_create_within', this.rig, ...budget)
                       : runtime.get('sweepface_mesh_create', this.rig, lod);
    this.names = Array.from({length: wasm.sweepface_rig_target_count(this.rig)},
                            (_, k) => runtime.text(wasm.sweepface_rig_target_name(this.rig, k)));
    this.indexOf = new Map(this.names.map((text, k) => [text, k]));
    this.weightCount = this.names.length * this.regionCount;
    this.vertexCount = wasm.sweepface_mesh_vertex_count(this.mesh);
    this.lod = lod;
  }

  /** Reads what targets do, once; that waits until the face is to move, so that it shows sooner. */
  loadTargets() {
    this.runtime.check(this.runtime.wasm.sweepface_rig_load_targets(this.rig));
  }

  target(name) {
    const index = this.indexOf.get(name);
    if (index !== undefined) return index;
    const known = this.names.length > 0 ? `its targets are ${this.names.join(', ')}` : 'this face has no targets';
    throw new Error(`There is no target named '${name}'; ${known}.`);
  }

  region(name) {
    const index = this.regions?.findIndex((region) => region.name === name) ?? -1;
    if (index >= 0) return index;
    const names = this.regions?.map((region) => region.name).join(', ') ?? 'none';
    throw new Error(`There is no region named '${name}'; there are ${names}.`);
  }

  /** The numbers of a region, or of all. */
  places(region) {
    return region === undefined ? Array.from({length: this.regionCount}, (_, r) => r) : [this.region(region)];
  }

  triangles() {
    const {wasm} = this.runtime, count = wasm.sweepface_mesh_triangle_count(this.mesh);
    return this.runtime.words(wasm.sweepface_mesh_triangles(this.mesh), 3 * count).slice();
  }

  copies() {
    const {wasm} = this.runtime, points = wasm.sweepface_mesh_point_count(this.mesh);
    const at = wasm.sweepface_mesh_copies(this.mesh);
    return at === 0 ? new Uint32Array() : this.runtime.words(at, this.vertexCount - points).slice();
  }

  texcoords() {
    const at = this.runtime.wasm.sweepface_mesh_texcoords(this.mesh);
    return at === 0 ? null : this.runtime.floats(at, 2 * this.vertexCount).slice();
  }

  parts() {
    const {runtime} = this, {wasm} = runtime, length = wasm.sweepface_mesh_part_count(this.mesh);
    return Array.from({length}, (_, k) => runtime.room(12, (out) => {
      runtime.check(wasm.sweepface_mesh_part(this.mesh, k, out));
      const [material, first, count] = runtime.words(out, 3);
      return {material: runtime.text(material), start: 3 * first, count: 3 * count};
    }));
  }
}

export class Sweepface {
  #shared;
  #face;
  #motion = 0;
  #drives = new Map();  // goals, and seconds before which none rests there, by the place of the weight among all
  #memory;  // in the module, in one piece: arrays of floats and of weights, and C structs: a drive and two vectors

  /** Use Sweepface.load. */
  constructor(shared) {
    if (!(shared instanceof Shared)) throw new TypeError('Faces are made by Sweepface.load.');
    const {runtime, vertexCount, weightCount} = shared;
    this.#shared = shared;
    const positions = runtime.allocate(24 * vertexCount + 8 * weightCount + 72), normals = positions + 12 * vertexCount;
    const weights = positions + 24 * vertexCount, drive = weights + 8 * weightCount, vectors = drive + 56;
    this.#memory = {positions, normals, weights, drive, vectors};
    this.#face = runtime.get('sweepface_face_create', shared.mesh);
    ++runtime.users;
  }

  static async load(bytes, options) {
    const given = options ?? {}, {lod = 0, name, arcs, combine, eyes, regions, wasm} = given;
    const view = bytesOf(bytes)?.slice();  // its owner may change it, or send it away, while the module comes
    if (!view)
      throw new TypeError('Sweepface.load needs the bytes of a .sweep file: an ArrayBuffer or a typed array.');
    for (const key of Object.keys(given))
      if (!OPTIONS.includes(key))
        throw new TypeError(`Sweepface.load has no option '${key}'; it has ${OPTIONS.join(', ')}.`);
    const details = ['lod', ...BUDGETS].filter((key) => given[key] !== undefined);
    if (details.length > 1)
      throw new TypeError(`A level of detail is asked for in one way, not by ${details.join(' and ')}.`);
    if (!Number.isInteger(lod) || lod < 0 || lod >= 2 ** 32)
      throw new RangeError('The level of detail must be a whole number from 0 to 64.');
    const [budget] = BUDGETS.flatMap((kind, k) => (given[kind] === undefined ? [] : [[k, Number(given[kind])]]));
    const divide = regions?.length !== 0 && regions && (await import('./sweepface_regions.js')).divider(regions);
    const follow = (arcs ? FOLLOW.arcs : 0) + (combine ? FOLLOW.combine : 0);
    const making = {name: String(name || 'The face'), follow, eyes, divide, lod, budget};
    const needsFull = follow || eyes || divide || budget;
    const make = async (module) => {
      const instance = await instantiate(module);
      if (!instance.exports.sweepface_rig_load_neutral)
        throw new Error('The option wasm is another module than those of sweepface.');
      if (needsFull && !instance.exports.sweepface_rig_follow) throw new Error(UNSAID);
      return new Sweepface(new Shared(instance, view, making));
    };
    if (wasm || needsFull || !isPacked(view)) return make(await compile(wasm, 'full'));
    const usual = await compile(wasm, 'usual');
    try {
      return await make(usual);
    } catch (error) {
      if (error instanceof MemoryError) throw error;
      return make(await compile(wasm, 'full'));  // which has the last word
    }
  }

  /** Another face of the same file, at rest; the two share everything but their weights. */
  clone() {
    return new Sweepface(this.#open());
  }

  get names() { return [...this.#open().names]; }
  get lod() { return this.#open().lod; }
  get tolerance() { return this.#open().runtime.wasm.sweepface_rig_tolerance(this.#shared.rig); }
  get turnCount() { return this.#open().turnCount; }
  get pointCount() { return this.#open().runtime.wasm.sweepface_mesh_point_count(this.#shared.mesh); }
  get vertexCount() { return this.#open().vertexCount; }
  get triangles() { return this.#open().triangles(); }
  get texcoords() { return this.#open().texcoords(); }
  get parts() { return this.#open().parts(); }
  /** Bytes of WebAssembly memory that the file and all its faces hold. */
  get memoryBytes() { return this.#open().runtime.wasm.memory.buffer.byteLength; }

  /** The regions, in the order in which they have weights; none where the face is of one piece. */
  get regions() { return this.#open().regions?.map(({name}) => name) ?? []; }

  /** The weights by name; of several regions, those of the first. */
  get weights() { return this.#weightsOf(0); }
  weightsIn(region) { return this.#weightsOf(this.#open().region(region)); }

  #weightsOf(region) {
    const {runtime, names} = this.#open(), all = runtime.wasm.sweepface_face_weights(this.#face);
    const values = runtime.doubles(all + 8 * names.length * region, names.length);
    return Object.fromEntries(names.map((name, k) => [name, values[k]]));
  }

  /** Sets the weights that are named, everywhere or in a region, and leaves the others; those in motion stop. */
  setWeights(weights, region) {
    const shared = this.#open(), {runtime, names} = shared, {wasm} = runtime, count = names.length;
    const named = this.#resolve(weights), places = shared.places(region);
    if (named.length === 0) return;
    shared.loadTargets();
    const all = this.#copyWeights();
    for (const r of places)
      for (const [target, weight] of named) all[count * r + target] = weight;
    this.#takeWeights();
    for (const r of places)
      for (const [target] of named) this.#drives.delete(count * r + target);
    if (!this.#motion) return;
    const cut = shared.regions ? 0 : this.#drive('cut');
    for (const r of places)
      for (const [target, weight] of named)
        runtime.check(shared.regions ? wasm.sweepface_motion_put_in(this.#motion, r, target, weight)
                                     : wasm.sweepface_motion_move_to(this.#motion, target, weight, cut));
  }

  /** The weights of all regions as they are, in memory of the module. */
  #copyWeights() {
    const {runtime, weightCount} = this.#shared, all = runtime.doubles(this.#memory.weights, weightCount);
    all.set(runtime.doubles(runtime.wasm.sweepface_face_weights(this.#face), weightCount));
    return all;
  }

  /** Makes what is there the face's weights. */
  #takeWeights() {
    const {runtime, names, regions} = this.#shared, {wasm} = runtime, at = this.#memory.weights, count = names.length;
    if (!regions) return runtime.check(wasm.sweepface_face_set_weights(this.#face, at, count));
    regions.forEach((_, r) => {
      runtime.check(wasm.sweepface_face_set_region_weights(this.#face, r, at + 8 * count * r, count));
    });
  }

  /** All weights to 0, at once. */
  reset() {
    this.setWeights(Object.fromEntries(this.#open().names.map((name) => [name, 0])));
  }

  /** How many eyeballs turn. */
  get eyeCount() { return this.#open().eyeCount; }

  /** How the eyes stand, {leftEye: {yaw, pitch}, rightEye: {yaw, pitch}} in radians; null: by the eyeLook weights. */
  look(pose) {
    const {runtime, eyeCount} = this.#open();
    if (eyeCount === 0) throw new Error('The face has no eyes that turn; load it with the option eyes, if it has any.');
    const angles = (eye) => [eye?.yaw ?? 0, eye?.pitch ?? 0, 0];
    if (!pose) return runtime.check(runtime.wasm.sweepface_face_look(this.#face, 0));
    const numbers = new Float64Array([0, 0, 0, ...angles(pose.leftEye), ...angles(pose.rightEye)]);
    runtime.lend(new Uint8Array(numbers.buffer), (at) => {
      runtime.check(runtime.wasm.sweepface_face_look(this.#face, at));
    });
  }

  /** Writes positions and normals, three floats a vertex; either may be null. */
  evaluate(positions, normals = null) {
    const {runtime, vertexCount} = this.#open(), memory = this.#memory;
    const count = 3 * vertexCount;
    for (const out of [positions ?? null, normals ?? null].filter((out) => out !== null)) {
      if (!['Float32Array', 'Float64Array'].includes(kindOf(out)))
        throw new TypeError(`Positions and normals are written to a Float32Array or null, not to ${kindOf(out)}.`);
      if (out.length < count)
        throw new RangeError(`There must be room for ${vertexCount} vertices: ${count} numbers, not ${out.length}.`);
    }
    runtime.words(memory.vectors, 4).set([positions ? memory.positions : 0, 0, normals ? memory.normals : 0, 0]);
    runtime.check(runtime.wasm.sweepface_face_update(this.#face, vertexCount, memory.vectors, memory.vectors + 8));
    positions?.set(runtime.floats(memory.positions, count));
    normals?.set(runtime.floats(memory.normals, count));
  }

  /** What a vertex shader evaluates the face from, instead of `evaluate`: see shaderModes. */
  shaderTables(tangents = false) {
    const {runtime} = this.#open(), {wasm} = runtime, points = this.pointCount, rows = tangents ? 2 : 1;
    this.#shared.loadTargets();
    return runtime.room(20, (out) => {
      runtime.check(wasm.sweepface_mesh_shader_tables(this.#shared.mesh, tangents ? 1 : 0, out));
      const [basis, places, neutral, texels, modes] = runtime.words(out, 5);
      return {
        basis: runtime.shorts(basis, 4 * texels).slice(),
        places: runtime.words(places, 3 * points).slice(),
        neutral: runtime.floats(neutral, 3 * points * rows).slice(),
        modes
      };
    });
  }

  /** Writes what changes every frame, four integers a mode; returns their factor. */
  shaderModes(out, tangents = false) {
    const {runtime} = this.#open();
    if (kindOf(out) !== 'Int16Array') throw new TypeError(`Modes are written to an Int16Array, not to ${kindOf(out)}.`);
    if (out.length % 4 !== 0) throw new RangeError(`Modes are four numbers each, not ${out.length} together.`);
    this.#shared.loadTargets();
    return runtime.room(4 + 2 * out.length, (at) => {
      runtime.check(
        runtime.wasm.sweepface_face_modes(this.#face, tangents ? 1 : 0, at + 4, out.length / 4, at));
      out.set(runtime.shorts(at + 4, out.length));
      return runtime.floats(at, 1)[0];
    });
  }

  /** For vertices behind the points, the point that each repeats. */
  get copies() { return this.#open().copies(); }

  /** Makes ready to move, which else happens when it first does and takes a few frames. */
  prepare() {
    const {runtime} = this.#open();
    this.#shared.loadTargets();
    runtime.check(runtime.wasm.sweepface_mesh_prepare(this.#shared.mesh, 1));
  }

  /** Sends weights to goals from where they stand, everywhere or in a region; `advance` moves them. */
  moveTo(goals, drive, region) {
    const shared = this.#open(), {runtime} = shared, {wasm} = runtime;
    const all = this.#resolve(goals), places = shared.places(region), at = this.#drive(drive), motion = this.#moving();
    for (const [target, goal] of all) {
      runtime.check(region === undefined ? wasm.sweepface_motion_move_to(motion, target, goal, at)
                                         : wasm.sweepface_motion_move_in(motion, places[0], target, goal, at));
      for (const r of places)
        this.#drives.set(shared.names.length * r + target, {goal, left: this.#secondsOf(at, r)});
    }
  }

  /** Seconds before which a drive brings no weight of a region to rest. */
  #secondsOf(drive, region) {
    const {runtime, regions} = this.#shared, kind = DRIVES[runtime.ints(drive, 1)[0]];
    const {mass = 1, stiffness = 1, delay: later = 0} = regions?.[region] ?? {};
    const [delay, seconds] = runtime.doubles(drive + 8, 2);
    const lasts = ['cut', 'spring'].includes(kind) ? 0 : seconds;
    return delay + later + lasts * Math.sqrt(mass / stiffness);
  }

  /** A blow: adds to the velocity of a weight (per second), which drag (per second) takes away. */
  push(name, velocityChange, drag = 8) {
    const shared = this.#open(), {runtime} = shared, target = shared.target(name);
    if (!(Math.abs(velocityChange) <= MOST))
      throw new RangeError(`The push on '${name}' must lie within ${MOST} of 0, not be ${told(velocityChange)}.`);
    runtime.check(runtime.wasm.sweepface_motion_push(this.#moving(), target, velocityChange, drag));
    for (const r of shared.places()) this.#drives.delete(shared.names.length * r + target);
  }

  /** Lets time pass for the weights in motion; says whether anything goes on moving. */
  advance(seconds) {
    const {runtime, weightCount: count} = this.#open(), {wasm} = runtime, {weights} = this.#memory;
    if (!Number.isFinite(seconds))
      throw new RangeError(`Time passes by a finite number of seconds, not ${told(seconds)}.`);
    if (!this.#motion) return false;
    const still = 1e-6, before = this.#copyWeights().slice();
    const isDriven = this.#drives.size > 0;
    wasm.sweepface_motion_advance(this.#motion, seconds);
    runtime.check(wasm.sweepface_motion_velocities(this.#motion, weights, count));
    const velocities = runtime.doubles(weights, count).slice();
    runtime.check(wasm.sweepface_motion_positions(this.#motion, weights, count));
    const now = runtime.doubles(weights, count);
    // What sets out or turns back has no velocity, either, but is not at its goal.
    for (const [place, drive] of this.#drives) {
      drive.left -= Math.max(seconds, 0);
      const isThere = Math.abs(now[place] - drive.goal) <= still && Math.abs(velocities[place]) <= still;
      if (isThere && drive.left <= 0) this.#drives.delete(place);
    }
    now.set(now.map((weight) => Math.min(Math.max(weight, -MOST), MOST)));  // swings and blows may go further
    this.#takeWeights();
    return isDriven || velocities.some((velocity) => Math.abs(velocity) > still) ||
           runtime.doubles(weights, count).some((w, k) => Math.abs(w - before[k]) > still);
  }

  /** Frees the face; it can no longer be used. Memory is given back with the last face of a file. */
  dispose() {
    if (!this.#shared) return;
    const {runtime, mesh, rig} = this.#shared, {wasm} = runtime;
    this.#shared = undefined;
    if (runtime.isDead) return;
    wasm.sweepface_motion_free(this.#motion);
    wasm.sweepface_face_free(this.#face);
    wasm.free(this.#memory.positions);
    if (--runtime.users === 0) {
      wasm.sweepface_mesh_free(mesh);
      wasm.sweepface_rig_free(rig);
    }
  }

  #open() {
    if (!this.#shared) throw new Error('The face was disposed of.');
    if (this.#shared.runtime.isDead) throw new MemoryError();
    return this.#shared;
  }

  /** Targets and numbers; nothing is set before all are known. */
  #resolve(byName) {
    if (typeof byName !== 'object' || !byName || Symbol.iterator in byName)
      throw new TypeError('Weights are given by name, like {jawOpen: 0.7}.');
    return Object.entries(byName).map(([name, value]) => {
      const target = this.#shared.target(name);
      if (!Number.isFinite(value))
        throw new TypeError(`The weight of '${name}' must be a finite number, not ${told(value)}.`);
      if (Math.abs(value) > MOST) throw new RangeError(`The weight of '${name}' must lie within ${MOST} of 0.`);
      return [target, value];
    });
  }

  #moving() { return this.#motion ||= this.#makeMotion(); }

  #makeMotion() {
    const {runtime, names, regions} = this.#shared, {wasm} = runtime, count = names.length;
    this.#shared.loadTargets();
    const weights = wasm.sweepface_face_weights(this.#face);
    if (!regions) return runtime.get('sweepface_motion_create', weights, count);
    const matters = new Float64Array(regions.flatMap(({mass, stiffness, delay}) => [mass, stiffness, delay]));
    const motion = runtime.lend(new Uint8Array(matters.buffer), (at) => {
      return runtime.get('sweepface_motion_create_regions', weights, count, at, regions.length);
    });
    this.#copyWeights().slice().forEach((weight, k) => {
      runtime.check(wasm.sweepface_motion_put_in(motion, Math.floor(k / count), k % count, weight));
    });
    return motion;
  }

  /** The C struct of a drive: its name, or its name and numbers. */
  #drive(drive) {
    const {runtime} = this.#shared, at = this.#memory.drive;
    const given = typeof drive === 'string' ? {kind: drive} : drive ?? {};
    if (kindOf(given) !== 'Object')
      throw new TypeError(`A drive is a name, or numbers like {kind: 'spring', frequency: 3}, not ${told(given)}.`);
    const kind = DRIVES.indexOf(given.kind ?? 'spring');
    if (kind < 0) throw new Error(`There is no drive '${given.kind}'; there are ${DRIVES.join(', ')}.`);
    runtime.wasm.sweepface_drive_of(at, kind);
    const numbers = runtime.doubles(at + 8, DRIVE_NUMBERS.length);
    for (const key of Object.keys(given)) {
      if (key === 'kind' || given[key] === undefined) continue;
      const place = DRIVE_NUMBERS.indexOf(key);
      if (place < 0) throw new Error(`A drive has no '${key}'; it has kind, ${DRIVE_NUMBERS.join(', ')}.`);
      numbers[place] = given[key];
    }
    return at;
  }
}
