// How weights go to their goals: C structs of drives.
import {kindOf, told} from './sweepface_values.js';

/** In the order of the C interface. */
const KINDS = ['cut', 'newton', 'linear-force', 'accelerate-brake', 'spring', 'bounce'];
/** In the order of the C struct. */
const NUMBERS = ['delay', 'seconds', 'turn', 'frequency', 'damping', 'restitution'];

/** Bytes of the struct. */
export const DRIVE_SIZE = 56;

/** Writes a drive, its name or its name and numbers, to a place in the memory of a module. */
export function writeDrive(runtime, at, drive) {
  const given = typeof drive === 'string' ? {kind: drive} : drive ?? {};
  if (kindOf(given) !== 'Object')
    throw new TypeError(`A drive is a name, or numbers like {kind: 'spring', frequency: 3}, not ${told(given)}.`);
  const kind = KINDS.indexOf(given.kind ?? 'spring');
  if (kind < 0) throw new Error(`There is no drive '${given.kind}'; there are ${KINDS.join(', ')}.`);
  runtime.wasm.sweepface_drive_of(at, kind);
  const numbers = runtime.doubles(at + 8, NUMBERS.length);
  for (const key of Object.keys(given)) {
    if (key === 'kind' || given[key] === undefined) continue;
    const place = NUMBERS.indexOf(key);
    if (place < 0) throw new Error(`A drive has no '${key}'; it has kind, ${NUMBERS.join(', ')}.`);
    numbers[place] = given[key];
  }
}

/** Seconds before which a drive that was written brings no weight of such a matter to rest. */
export function secondsOf(runtime, at, {mass = 1, stiffness = 1, delay: later = 0} = {}) {
  const kind = KINDS[runtime.ints(at, 1)[0]], [delay, seconds] = runtime.doubles(at + 8, 2);
  const lasts = ['cut', 'spring'].includes(kind) ? 0 : seconds;
  return delay + later + lasts * Math.sqrt(mass / stiffness);
}
