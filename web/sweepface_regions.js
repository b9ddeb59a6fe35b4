// Regions of a face (docs/regions.md), painted by the C interface (include/sweepface/sweepface_regions.h).
import {kindOf} from './sweepface_values.js';
import {bytesOfText} from './sweepface_wasm.js';

const MATTER = {mass: 1, stiffness: 1, delay: 0};
const PLACES = ['parts', 'points', 'line', 'curves', 'nodes'];
const MEMBERS = ['name', ...Object.keys(MATTER), ...PLACES, 'whole', 'fade', 'over', 'bands'];

/** Copies of arrays and texts in the memory of a module, freed together. */
class Copies {
  #runtime;
  #at = [];

  constructor(runtime) { this.#runtime = runtime; }

  bytes(bytes) {
    const at = this.#runtime.allocate(bytes.byteLength);
    this.#at.push(at);
    this.#runtime.bytes(at, bytes.byteLength).set(new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength));
    return at;
  }
  text(text) { return this.bytes(bytesOfText(text)); }
  texts(list) { return this.bytes(new Uint32Array(list.map((text) => this.text(text)))); }
  numbers(list) { return this.bytes(new Float64Array(list)); }

  free() {
    for (const at of this.#at) this.#runtime.wasm.free(at);
  }
}

const isPlace = (place) => place?.length === 3 && Array.from(place).every(Number.isFinite);

/** Throws if regions are not as docs/regions.md says, before anything is painted. */
function check(regions) {
  if (!Array.isArray(regions)) throw new TypeError('Regions are a list of objects with a name each.');
  for (const region of regions) {
    if (typeof region?.name !== 'string') throw new TypeError('A region needs a name.');
    if (/[\0-\x1f]|\p{Surrogate}/u.test(region.name))
      throw new TypeError('A region needs a name that is text all through.');
    const wrong = (what) => new TypeError(`Region '${region.name}' ${what}.`);
    for (const key of Object.keys(region))
      if (!MEMBERS.includes(key)) throw wrong(`has an unknown '${key}'; it has ${MEMBERS.join(', ')}`);
    const told = (keys) => keys.filter((key) => region[key] !== undefined);
    for (const key of told(['parts', 'curves']))
      if (!Array.isArray(region[key]) || !region[key].every((name) => typeof name === 'string'))
        throw wrong(`has '${key}' that are no list of names`);
    const {nodes = {}, bands = 1, mass = 1, stiffness = 1, delay = 0} = region;
    if (kindOf(nodes) !== 'Object' || !Object.values(nodes).every(Number.isFinite))
      throw wrong('has \'nodes\' that are no shares by name');
    for (const key of told(['points', 'line']))
      if (!Array.isArray(region[key]) || !region[key].every(isPlace))
        throw wrong(`has '${key}' that are not like [[x, y, z]]`);
    if (told(PLACES).every((key) => Object.keys(region[key]).length === 0))
      throw wrong(`says nowhere where it is; give it ${PLACES.join(', ')}`);
    if (!['surface', 'space', undefined].includes(region.over))
      throw wrong(`is over '${region.over}', which is neither surface nor space`);
    for (const key of told([...Object.keys(MATTER), 'whole', 'fade']))
      if (!Number.isFinite(region[key])) throw wrong(`has a '${key}' that is not a number`);
    if (Math.min(mass, stiffness) < 1e-4 || Math.max(mass, stiffness) > 1e4)
      throw wrong('has a mass or a stiffness that is not from 0.0001 to 10000');
    if (delay < 0 || delay > 60) throw wrong('has a delay that is not from 0 to 60 seconds');
    if (!Number.isInteger(bands) || bands < 1 || bands > 32)
      throw wrong(`has ${bands} bands, which is no whole number from 1 to 32`);
  }
}

function copyOf({parts = [], points = [], line = [], curves = [], nodes = {}, ...others}) {
  const placesOf = (list) => list.map((place) => [...place]);
  return {...others, parts: [...parts], points: placesOf(points), line: placesOf(line), curves: [...curves],
          nodes: {...nodes}};
}

/** Copies options of a load that the caller may go on changing. Invalid regions stay, to be refused when used. */
export function ownOptions(options) {
  const own = {...options};
  if (!own.regions) return own;
  try {
    check(own.regions);
    own.regions = own.regions.map(copyOf);
  } catch {}
  return own;
}

/** The C struct of a brush. */
function brush(copies, region) {
  const {parts, points, line, curves, nodes, whole = 0, fade = 0, over} = region;
  const struct = new DataView(new ArrayBuffer(72)), shares = Object.values(nodes);
  const words = [copies.texts(parts), parts.length, copies.numbers(points.flat()), points.length,
                 copies.numbers(line.flat()), line.length, copies.texts(curves), curves.length,
                 copies.texts(Object.keys(nodes)), copies.numbers(shares), shares.length];
  words.forEach((word, k) => struct.setUint32(4 * k, word, true));
  struct.setFloat64(48, whole, true);
  struct.setFloat64(56, fade, true);
  struct.setInt32(64, over === 'space' ? 1 : 0, true);
  return copies.bytes(struct);
}

/** The name, matter and shares of a painted region, or of each of its bands. */
function paint(runtime, rig, region) {
  const {bands = 1} = region, copies = new Copies(runtime), {wasm} = runtime;
  try {
    const nodes = wasm.sweepface_rig_node_count(rig), count = bands * nodes;
    const room = copies.numbers(new Float64Array(count));
    try {
      runtime.check(wasm.sweepface_rig_paint(rig, brush(copies, region), bands, room, count));
    } catch (error) {
      throw new Error(`Region '${region.name}': ${error.message}`, {cause: error});
    }
    const shares = runtime.doubles(room, count).slice();
    return Array.from({length: bands}, (_, k) => {
      const matter = Object.fromEntries(Object.entries(MATTER).map(([key, usual]) => [key, region[key] ?? usual]));
      const own = shares.subarray(k * nodes, (k + 1) * nodes);
      if (bands === 1) return {...matter, name: region.name, shares: own};
      return {...matter, delay: matter.delay * (k / (bands - 1)), name: `${region.name}${k + 1}`, shares: own};
    });
  } finally {
    copies.free();
  }
}

/** A function that divides a rig into regions and returns them, the rest first. */
export function divider(given) {
  check(given);
  const regions = given.map(copyOf);  // the caller may change them while the module loads
  return (runtime, rig) => {
    const {wasm} = runtime, copies = new Copies(runtime);
    const painted = regions.flatMap((region) => paint(runtime, rig, region));
    try {
      const names = copies.texts(painted.map(({name}) => name));
      const shares = copies.numbers(painted.flatMap((region) => [...region.shares]));
      runtime.check(wasm.sweepface_rig_divide(rig, names, shares, painted.length));
    } finally {
      copies.free();
    }
    return Array.from({length: wasm.sweepface_rig_region_count(rig)}, (_, r) => {
      const at = wasm.sweepface_rig_region_name(rig, r), name = at ? runtime.text(at) : 'rest';
      return {...MATTER, ...painted.find((region) => region.name === name), name};
    });
  };
}
