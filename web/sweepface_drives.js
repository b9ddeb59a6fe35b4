// Drives, which take weights to their goals: their checks and C structs.
import {kindOf, told} from './sweepface_values.js';

/** In the order of the C interface. */
export const KINDS = ['cut', 'newton', 'linear-force', 'accelerate-brake', 'spring', 'bounce'];
/** In the order of the C struct. */
export const NUMBERS = ['delay', 'seconds', 'turn', 'frequency', 'damping', 'restitution'];

/** Which drives use each number; all have a delay. */
const GO_BY = {
  seconds: ['newton', 'linear-force', 'accelerate-brake', 'bounce'],
  turn: ['accelerate-brake'],
  frequency: ['spring'],
  damping: ['spring'],
  restitution: ['bounce'],
  delay: KINDS
};
export const goesBy = (kind, number) => GO_BY[number].includes(kind);

/** Bytes of the struct. */
export const DRIVE_SIZE = 56;

/** Farther away than any goal, and faster than any weight. */
const FAR = 1e12;

/** Why a drive cannot set out, wherever its weights are, in the library's words; undefined if it can. */
export function faultOf(drive) {
  const {kind = 'spring', seconds = 1, turn = 0.5, frequency = 1, damping = 1, restitution = 0} = drive;
  const tooMuch = (...numbers) => (numbers.every(Number.isFinite) ? undefined
    : 'A motion needs finite numbers; its goal, time or frequency is beyond what they hold');
  if (kind === 'cut') return;
  if (kind === 'spring') {
    const omega = 2 * Math.PI * frequency, sigma = damping * omega, force = omega ** 2 + sigma ** 2;
    return tooMuch(force, force * FAR, 2 * sigma * FAR) ??
           (frequency > 0 && damping >= 0 ? undefined
                                          : 'A spring needs a frequency greater than 0 and a damping of at least 0');
  }
  if (kind === 'bounce' && !(restitution >= 0 && restitution <= 1 - 1e-9))
    return 'A bounce keeps part of its speed: the restitution lies in [0, 1 - 1e-9]';
  if (!(seconds > 0)) return 'The motion must last a finite time greater than 0 seconds';
  const peak = 2 * FAR / seconds + FAR;
  if (kind === 'linear-force') return tooMuch(6 * peak / seconds / seconds);  // how fast the force changes
  if (kind !== 'accelerate-brake') return tooMuch(2 * peak / seconds);
  if (!(turn > 0 && turn < 1)) return 'The force must turn after the start and before the end: between 0 and 1';
  return tooMuch(peak / Math.min(turn, 1 - turn) / seconds, FAR * seconds);
}

/** The numbers of a drive, scaled to how weights of a region follow it. */
function inMatter([, seconds, turn, frequency, damping, restitution], matter) {
  const {mass, stiffness} = matter ?? {mass: 1, stiffness: 1}, stretch = Math.sqrt(mass / stiffness);
  return {seconds: seconds * stretch, turn, frequency: frequency / stretch,
          damping: damping / Math.sqrt(mass * stiffness), restitution};
}

/**
 * Writes a drive, given by its name or with numbers, to an address in a module's memory. Throws if weights of any of
 * the `matters` cannot follow it.
 */
export function writeDrive(runtime, at, drive, matters) {
  const given = typeof drive === 'string' ? {kind: drive} : drive ?? {};
  if (kindOf(given) !== 'Object')
    throw new TypeError(`A drive is a name, or numbers like {kind: 'spring', frequency: 3}, not ${told(given)}.`);
  const name = given.kind ?? 'spring', kind = KINDS.indexOf(name);
  if (kind < 0) throw new Error(`There is no drive '${name}'; there are ${KINDS.join(', ')}.`);
  runtime.wasm.sweepface_drive_of(at, kind);
  const numbers = runtime.doubles(at + 8, NUMBERS.length);
  for (const key of Object.keys(given)) {
    if (key === 'kind' || given[key] === undefined) continue;
    const place = NUMBERS.indexOf(key);
    if (place < 0) throw new Error(`A drive has no '${key}'; it has kind, ${NUMBERS.join(', ')}.`);
    if (!Number.isFinite(given[key]))
      throw new TypeError(`The ${key} of a drive must be a finite number, not ${told(given[key])}.`);
    if (!goesBy(name, key))
      throw new Error(`The drive '${name}' has no use for '${key}'; leave it out, or name another drive.`);
    numbers[place] = given[key];
  }
  if (numbers[0] < 0) throw new RangeError('The delay of a motion must be at least 0 seconds.');
  for (const matter of matters) {
    const fault = faultOf({...inMatter(numbers, matter), kind: name});
    if (fault) throw new RangeError(`${fault}.`);
  }
}
