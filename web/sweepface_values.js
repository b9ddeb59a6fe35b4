// What is given, whatever it may be.

/** What kind of object something is, of any realm: frames and Node's vm have an ArrayBuffer of their own. */
export const kindOf = (it) => Object.prototype.toString.call(it).slice(8, -1);

/** How far a weight may be from 0; more is a slip. */
export const MOST = 1e6;
export const isWeight = (value) => Number.isFinite(value) && Math.abs(value) <= MOST;

/** Whether it holds numbers as the module has them. */
export const isFloats = (it) => ['Float32Array', 'Float64Array'].includes(kindOf(it));

/** How a message calls what is no number. */
export function told(value) {
  if (typeof value === 'string') return `the text '${value}'`;
  if (typeof value === 'bigint') return `${value}n`;
  return typeof value === 'object' && value && !value.toString ? kindOf(value) : String(value) || kindOf(value);
}

/** How much time passes: where a clock is wrong, none, so that it ends no motion. */
export const passed = (seconds) => (seconds > 0 && seconds <= 1e10 ? seconds : 0);

/** The bytes that are given, if any are. */
export function bytesOf(source) {
  try {
    if (ArrayBuffer.isView(source)) return new Uint8Array(source.buffer, source.byteOffset, source.byteLength);
    if (kindOf(source) === 'ArrayBuffer') return new Uint8Array(source);
  } catch (error) {
    throw new TypeError('The bytes were sent away with their buffer; give a copy, or send one.', {cause: error});
  }
}

/** Options as they are, of which one that there is not is a slip. */
export function known(options, keys, what) {
  if (typeof (options ?? {}) !== 'object' || Symbol.iterator in (options ?? {}))
    throw new TypeError(`${what} takes an object of ${keys.join(', ')}, no ${kindOf(options)}.`);
  for (const key of Object.keys(options ?? {}))
    if (!keys.includes(key)) throw new TypeError(`${what} has no option '${key}'; it has ${keys.join(', ')}.`);
  return options ?? {};
}
