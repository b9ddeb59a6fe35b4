// Opens a .sweep file in a module: the options, and what all faces of the file share.
import {isPacked, isSweep, parted} from './sweepface_chunks.js';
import {divider} from './sweepface_regions.js';
import {bytesOf, isGiven, known, told} from './sweepface_values.js';
import {compile, instantiate, isCompiled, MemoryError, Runtime, UNSAID} from './sweepface_wasm.js';

/** The budgets that may choose a level of detail, in the order of the C interface. */
const BUDGETS = ['edgeLength', 'error', 'vertices'];
const DETAILS = ['lod', ...BUDGETS];
const SWITCHES = ['arcs', 'combine', 'eyes'];
const OPTIONS = [...DETAILS, 'name', ...SWITCHES, 'regions', 'wasm'];

/** What targets may follow, as flags of the C interface. */
const FOLLOW = {arcs: 1, combine: 2};

/** Usual options and others that replace them, unless undefined; one way to ask for a level of detail replaces all. */
export function withOptions(usual, options) {
  const given = Object.fromEntries(Object.entries(options ?? {}).filter(([, value]) => value !== undefined)), all = {...usual};
  if (DETAILS.some((key) => key in given)) for (const key of DETAILS) delete all[key];
  return {...all, ...given};
}

/** Checks options and reads from them how the file is played, and whether that needs the full module. */
function read(options) {
  const given = known(options, OPTIONS, 'Sweepface.load');
  const {lod = 0, name, arcs, combine, eyes, regions, wasm} = given;
  for (const key of SWITCHES)
    if (![undefined, null, true, false].includes(given[key]))
      throw new TypeError(`The option '${key}' is true or false, not ${told(given[key])}.`);
  const details = DETAILS.filter((key) => given[key] !== undefined);
  if (details.length > 1)
    throw new TypeError(`A level of detail is asked for in one way, not by ${details.join(' and ')}.`);
  if (!Number.isInteger(lod) || lod < 0 || lod >= 2 ** 32)
    throw new RangeError('The level of detail must be a whole number from 0 to 64.');
  const [budget] = BUDGETS.flatMap((kind, k) => (given[kind] === undefined ? [] : [[k, given[kind]]]));
  if (budget && typeof budget[1] !== 'number')
    throw new TypeError(`The budget of a level of detail must be a number, not ${told(budget[1])}.`);
  const divide = regions && !(Array.isArray(regions) && regions.length === 0) && divider(regions);
  const follow = (arcs ? FOLLOW.arcs : 0) + (combine ? FOLLOW.combine : 0);
  const needsFull = Boolean(follow || eyes || divide || budget);
  return {name: String(name || 'The face'), follow, eyes, divide, lod, budget, wasm, needsFull};
}

/** What all faces of one file at one level of detail share. */
export class Shared {
  constructor(module, instance, bytes, {name, follow, eyes, divide, lod, budget}) {
    const runtime = this.runtime = new Runtime(instance), {wasm} = runtime;
    this.module = module;
    this.name = name;
    this.rig = runtime.loadRig(bytes, name);
    if (follow || eyes) this.loadTargets();
    if (follow) runtime.check(wasm.sweepface_rig_follow(this.rig, follow));
    this.eyeCount = eyes ? runtime.get('sweepface_rig_turn_eyes', this.rig) : 0;
    this.regions = divide ? divide(runtime, this.rig) : null;  // with their matter; null: not divided
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

  /** Of what another thread makes the same: a copy of the memory, and what is known about it. */
  give() {
    const {runtime, ...known} = this;
    return {memory: runtime.wasm.memory.buffer.slice(), known};
  }

  /** What another thread gave. */
  static async taken({memory, known}) {
    const runtime = new Runtime(await instantiate(known.module), memory);
    return Object.assign(Object.create(Shared.prototype), known, {runtime});
  }

  /** Gets the faces ready to move. */
  prepare() {
    this.loadTargets();
    this.runtime.check(this.runtime.wasm.sweepface_mesh_prepare(this.mesh, 1));
  }

  /** Reads what targets do, once. This is put off until the face is to move, so that it is shown sooner. */
  loadTargets() {
    this.runtime.check(this.runtime.wasm.sweepface_rig_load_targets(this.rig),
                       `${this.name}: what its targets do cannot be read; convert the source again.`);
  }

  target(name) {
    const index = this.indexOf.get(name);
    if (index !== undefined) return index;
    const listed = this.names.slice(0, 60).concat(this.names.length > 60 ? ['...'] : []).join(', ');
    const known = this.names.length > 0 ? `its targets are ${listed}` : 'this face has no targets';
    throw new Error(`There is no target named '${name}'; ${known}.`);
  }

  region(name) {
    const index = this.regions?.findIndex((region) => region.name === name) ?? -1;
    if (index >= 0) return index;
    const names = this.regions?.map((region) => region.name).join(', ') ?? 'none';
    throw new Error(`There is no region named '${name}'; there are ${names}.`);
  }

  /** The indices of one region, or of all. */
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

async function openIn(module, bytes, options) {
  const instance = await instantiate(module), {sweepface_rig_load_neutral: isOurs} = instance.exports;
  if (!isOurs) throw new Error('The option wasm is another module than those of sweepface.');
  if (options.needsFull && !instance.exports.sweepface_rig_follow) throw new Error(UNSAID);
  return new Shared(module, instance, bytes, options);
}

/** Throws if the bytes are of a kind that is easily taken for a face. */
function refuseOthers(bytes, name) {
  const start = String.fromCharCode(...bytes.subarray(0, 64));
  if (/^\s*<(!doctype|html)/i.test(start))
    throw new Error(`${name} is a page of HTML, as servers send for what they do not have; check the address.`);
  if (start.startsWith('glTF') || (!isSweep(bytes) && /\.(gltf|obj|ply)$/i.test(name)))
    throw new Error(`${name} is a file of meshes, not a face; make one of it first: sweepface convert.`);
}

/** A copy of the bytes of a file, which the caller may change or transfer while the module loads, and the options, checked. */
export function take(given, givenOptions) {
  const all = bytesOf(given);
  if (!all)
    throw new TypeError('Sweepface.load needs the bytes of a .sweep file: an ArrayBuffer or a typed array.');
  const {rest: bytes} = parted(all), options = read(givenOptions);
  refuseOthers(bytes, options.name);
  return {bytes, options};
}

/** Opens a file in the module that it and the options need. */
export async function open(given, givenOptions) {
  const {bytes, options} = take(given, givenOptions), {wasm} = options;
  if (isGiven(wasm) || options.needsFull || !isPacked(bytes)) return openIn(await compile(wasm, 'full'), bytes, options);
  const usual = await compile(wasm, 'usual').catch((error) => {
    if (isCompiled('full')) return compile(wasm, 'full');  // at hand already, perhaps from when there was a network
    throw error;
  });
  try {
    return await openIn(usual, bytes, options);
  } catch (error) {
    if (error instanceof MemoryError) throw error;
    return openIn(await compile(wasm, 'full'), bytes, options);  // which has the last word
  }
}
