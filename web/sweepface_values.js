// Checks of the values that callers pass.

/** The kind of an object of any realm: frames and Node's vm have an ArrayBuffer of their own. */
export const kindOf = (it) => Object.prototype.toString.call(it).slice(8, -1);

/** How far a weight may be from 0; more is a mistake. */
export const MOST = 1e6;
export const isWeight = (value) => Number.isFinite(value) && Math.abs(value) <= MOST;

/** The most weights that a clip can hold: frames times names. */
export const MOST_WEIGHTS = 2 ** 26;

export const isGiven = (it) => it !== undefined && it !== null;

/** Whether it is an array of floats or doubles, the number types of the module. */
export const isFloats = (it) => ['Float32Array', 'Float64Array'].includes(kindOf(it));

/** Whether the first `count` numbers of two arrays have memory in common. */
export const overlap = (a, b, count) => a.buffer === b.buffer &&
  a.byteOffset < b.byteOffset + count * b.BYTES_PER_ELEMENT && b.byteOffset < a.byteOffset + count * a.BYTES_PER_ELEMENT;

/** How messages call a value that is not the number it should be. */
export function told(value) {
  if (typeof value === 'string') return `the text '${value}'`;
  if (typeof value === 'bigint') return `${value}n`;
  return typeof value === 'object' && value && !value.toString ? kindOf(value) : String(value) || kindOf(value);
}

/** Throws if what passes is no time. */
export function checkTime(seconds) {
  if (!Number.isFinite(seconds))
    throw new RangeError(`Time passes by a finite number of seconds, not ${told(seconds)}.`);
}

/** How much time passes: none if the clock is wrong, so that it ends no motion. */
export const passed = (seconds) => (seconds > 0 && seconds <= 1e10 ? seconds : 0);

/** The bytes of a buffer or of a view of one; undefined if it is neither. */
export function bytesOf(source) {
  try {
    if (ArrayBuffer.isView(source)) return new Uint8Array(source.buffer, source.byteOffset, source.byteLength);
    if (kindOf(source) === 'ArrayBuffer') return new Uint8Array(source);
  } catch (error) {
    throw new TypeError('The bytes were sent away with their buffer; give a copy, or send one.', {cause: error});
  }
}

/** Returns the options, after throwing if one is not among `keys`. */
export function known(options, keys, what) {
  if (typeof (options ?? {}) !== 'object' || Symbol.iterator in (options ?? {}))
    throw new TypeError(`${what} takes an object of ${keys.join(', ')}, no ${kindOf(options)}.`);
  for (const key of Object.keys(options ?? {}))
    if (!keys.includes(key)) throw new TypeError(`${what} has no option '${key}'; it has ${keys.join(', ')}.`);
  return options ?? {};
}

/** The lowest and the highest coordinates of points, [3] each. */
export function boxOf(points) {
  let [x, y, z] = points, [X, Y, Z] = points;
  for (let k = 3; k < points.length; k += 3) {
    const a = points[k], b = points[k + 1], c = points[k + 2];
    if (a < x) x = a; else if (a > X) X = a;
    if (b < y) y = b; else if (b > Y) Y = b;
    if (c < z) z = c; else if (c > Z) Z = c;
  }
  return [[x, y, z], [X, Y, Z]];
}

/** The given face; throws if it is what Sweepface.load promises or takes. */
export function faceFrom(face) {
  if (typeof face?.evaluate === 'function') return face;
  throw new TypeError('A mesh is made of a face; await Sweepface.load for it.');
}

/** What messages call the file at a URL: neither the bytes that a data: URL is made of, nor a query, which may be secret. */
export function nameOf(url) {
  const text = String(url);
  return /^data:/i.test(text) ? text.split(',')[0] : text.split(/[?#]/)[0];
}

/** What is wrong with a geometry that was put in the place of a mesh's own. */
export const otherGeometry = ({vertexCount}) =>
  new Error(`The geometry must have the ${vertexCount} vertices of the face; change a copy of it.`);
