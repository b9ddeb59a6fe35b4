// Clips, which are weights over time, and a player for them.
import {matchNames, turnsEyes} from './sweepface_names.js';
import {fewOf, isObject} from './sweepface_text.js';
import {isFloats, isGiven, isWeight, kindOf, known, MOST_WEIGHTS, told} from './sweepface_values.js';

/** Seconds between frames up to which speeds would not stay finite. */
const NO_TIME = 1e-9;
const ONE_EURO = ['cutoff', 'speedGain', 'speedCutoff'];

const MOST_FACTOR = 1000;

/** The entries of a map of names, as [name of the clip, [[target, factor]]]. */
function drivesOf(map) {
  if (!isObject(map) || Object.keys(map).length === 0)
    throw new TypeError(`A map of names is an object that has targets by names of a clip, not ${kindOf(map)}.`);
  const isText = (target) => typeof target === 'string';
  return Object.entries(map).map(([name, drives]) => {
    if (!isGiven(drives)) return [name, []];
    const list = [drives].flat();
    if (list.every(isText)) return [name, list.map((target) => [target, 1])];
    if (isObject(drives) && Object.values(drives).every((factor) => Number.isFinite(factor) && Math.abs(factor) <= MOST_FACTOR))
      return [name, Object.entries(drives)];
    throw new TypeError(`'${name}' drives the name of a target, a list of some, an object of numbers within ±1000 by name, or null.`);
  });
}

/** Whether two names differ only in their spelling; a name without a side means both sides. */
const areAlike = (a, b) => [[a, b], [b, a]].every(([name, other]) => matchNames([name], [other]).unmatched.length === 0);

/**
 * The columns of a clip whose names a map changes. Each of `columns` {name, sources} is the sum of its sources, and a
 * source is the largest of its columns times a factor. `lacks` are the names of the map that the clip does not have.
 */
function mappedColumns(names, drives) {
  const {targets: found, unmatched} = matchNames(drives.map(([name]) => name), names);
  const mapped = new Map(), byTarget = new Map();
  const add = (target, source) => byTarget.set(target, [...(byTarget.get(target) ?? []), source]);
  drives.forEach(([name, targets], k) => {
    for (const column of found[k]) {
      if (mapped.has(column)) throw new TypeError(`'${mapped.get(column)}' and '${name}' are one name of the clip; keep one.`);
      mapped.set(column, name);
    }
    if (found[k].length > 0) for (const [target, factor] of targets) add(target, {found: found[k], factor});
  });
  const columns = [];
  names.forEach((name, k) => {
    if (mapped.has(k)) return;
    const source = {found: [k], factor: 1}, target = [...byTarget.keys()].find((each) => areAlike(each, name));
    if (target === undefined) columns.push({name, sources: [source]});
    else add(target, source);
  });
  return {columns: [...columns, ...[...byTarget].map(([name, sources]) => ({name, sources}))], lacks: unmatched};
}

/** Weights over time: `names` [N], `times` [F] in seconds, `weights` [F x N]. */
export class Clip {
  constructor(names, times, weights) {
    if (!Array.isArray(names) || ![times, weights].every(isFloats))
      throw new TypeError('A clip is made of a list of names, and times and weights in a Float64Array each.');
    if (weights.length !== names.length * times.length)
      throw new RangeError(`A clip of ${names.length} names and ${times.length} times has as many weights as their ` +
                           `product, not ${weights.length}.`);
    if (!times.every((time, k) => Number.isFinite(time) && (k === 0 || time >= times[k - 1])))
      throw new RangeError('The times of a clip are finite numbers of seconds, none before the last.');
    if (!weights.every(Number.isFinite)) throw new RangeError('The weights of a clip are finite numbers.');
    this.names = names;
    this.times = times;
    this.weights = weights;
    /** Sentences about what was repaired or may be wrong in the file that it was read from. */
    this.warnings = [];
  }

  get seconds() { return this.times.length === 0 ? 0 : this.times.at(-1) - this.times[0]; }

  /** The weights [N] at `seconds` after the first frame: linear between frames, held at the ends. */
  at(seconds, out = new Float64Array(this.names.length)) {
    if (typeof seconds !== 'number' || Number.isNaN(seconds))
      throw new RangeError(`A time is a number of seconds, not ${told(seconds)}.`);
    const {times, weights} = this, n = this.names.length, time = times[0] + Math.max(seconds, 0);
    if (!isFloats(out))
      throw new TypeError(`Weights are written to a Float32Array or a Float64Array, not to ${kindOf(out)}.`);
    if (out.length < n) throw new RangeError(`There must be room for ${n} weights, not ${out.length}.`);
    if (times.length === 0) return out.fill(0);
    let low = 0, high = times.length;  // the first frame after the time
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle + 1;
      else high = middle;
    }
    const later = Math.min(low, times.length - 1), earlier = Math.max(later - 1, 0);
    const length = times[later] - times[earlier];
    const s = length > 0 ? Math.min(Math.max((time - times[earlier]) / length, 0), 1) : 1;
    for (let k = 0; k < n; ++k) {
      const from = weights[earlier * n + k], to = weights[later * n + k];
      out[k] = s === 1 ? to : from + s * (to - from);
    }
    return out;
  }

  /**
   * The clip without a tracker's noise. A one-euro filter smooths heavily where weights rest, hardly where they move.
   * It runs from both ends, so that nothing is late.
   */
  smooth(settings) {
    const {cutoff = 1, speedGain = 8, speedCutoff = 5} = known(settings, ONE_EURO, 'The one-euro filter');
    for (const number of [cutoff, speedGain, speedCutoff])
      if (!(Number.isFinite(number) && number >= 0))
        throw new RangeError(`The one-euro filter needs finite numbers of at least 0, not ${told(number)}.`);
    const [late, early] = [false, true].map((backwards) => this.#filtered(cutoff, speedGain, speedCutoff, backwards));
    const clip = new Clip(this.names, this.times, late.map((weight, k) => (weight + early[k]) / 2));
    clip.warnings = this.warnings;
    return clip;
  }

  /**
   * The clip with names replaced by targets as a map says: {jawOpen: 'mouth-open', mouthPucker: ['kiss', 'pout'],
   * cheekPuff: {puff: 0.8}, tongueOut: null}. A target gets the sum of what drives it. Names not in the map stay.
   */
  renamed(map) {
    const {columns, lacks} = mappedColumns(this.names, drivesOf(map)), n = this.names.length, width = columns.length;
    if (this.times.length * width > MOST_WEIGHTS) throw new RangeError('The clip would have too many weights; cut it.');
    const weights = new Float64Array(this.times.length * width);
    for (let f = 0; f < this.times.length; ++f)
      columns.forEach(({sources}, k) => {
        for (const {found, factor} of sources)
          weights[f * width + k] += factor * Math.max(...found.map((column) => this.weights[f * n + column]));
        if (!isWeight(weights[f * width + k]))
          throw new RangeError(`'${columns[k].name}' would get a weight beyond ±1,000,000.`);
      });
    const clip = new Clip(columns.map(({name}) => name), this.times, weights);
    clip.warnings = lacks.length > 0 ? [...this.warnings, `The clip has no ${fewOf(lacks)}.`] : this.warnings;
    return clip;
  }

  #filtered(cutoff, speedGain, speedCutoff, backwards) {
    const n = this.names.length, frames = this.times.length, weights = this.weights.slice();
    const speeds = new Float64Array(n), step = backwards ? -1 : 1;
    const share = (hertz, seconds) => 1 - 1 / (2 * Math.PI * hertz * seconds + 1);
    for (let i = 1; i < frames; ++i) {
      const f = backwards ? frames - 1 - i : i, seconds = Math.abs(this.times[f] - this.times[f - step]);
      if (!(seconds > NO_TIME)) {  // the filter restarts
        speeds.fill(0);
        continue;
      }
      for (let k = 0; k < n; ++k) {
        const before = weights[(f - step) * n + k], now = weights[f * n + k];
        speeds[k] += ((now - before) / seconds - speeds[k]) * share(speedCutoff, seconds);
        weights[f * n + k] = before + (now - before) * share(cutoff + speedGain * Math.abs(speeds[k]), seconds);
      }
    }
    return weights;
  }
}

/** The angles of Live Link Face, in radians, in the order of the app. */
const ANGLES = ['Head', 'LeftEye', 'RightEye'].flatMap((of) => ['Yaw', 'Pitch', 'Roll'].map((angle) => of + angle));

/** Whether a clip ever has anything but 0 in a column. */
function isTold({names, weights}, column) {
  for (let i = column; i < weights.length; i += names.length) if (weights[i] !== 0) return true;
  return false;
}

/** Plays a clip on a face: `seek` sets the weights at a time. */
export class ClipPlayer {
  #angles = ANGLES.map(() => -1);  // their columns, or -1
  #looks;                          // whether its weights say where the eyes look

  constructor(face, clip) {
    if (typeof face?.setWeights !== 'function' || typeof clip?.at !== 'function' || !clip.names)
      throw new TypeError('A ClipPlayer plays a clip on a face; give it the face, and what readClip returns.');
    this.face = face;
    this.clip = clip;
    /** Which names drive which targets: see matchNames. */
    this.match = matchNames(clip.names, face.names);
    this.match.unmatched = matchNames(this.match.unmatched, ANGLES).unmatched;
    this.#looks = turnsEyes(this.match, face.names);
    // Recordings have columns for the eyes' angles that are 0 throughout if nothing tracked them. Eyes use no roll.
    const counts = (angle, k) => angle < 3 || (angle % 3 < 2 && isTold(clip, k));
    matchNames(clip.names, ANGLES).targets.forEach((found, k) => {
      for (const angle of found) if (counts(angle, k)) this.#angles[angle] = k;
    });
  }

  get seconds() { return this.clip.seconds; }

  /**
   * Sets the weights that the clip drives, and turns the eyes by its angles or else by its eyeLook weights. Returns the
   * angles of the head, {yaw, pitch, roll} in radians, or null if the clip has none; for three.js
   * `head.rotation.set(pitch, yaw, roll, 'YXZ')`. If two names drive a target, the larger weight counts.
   */
  seek(seconds) {
    const values = this.clip.at(seconds), names = this.face.names, weights = Object.create(null);
    this.match.targets.forEach((targets, k) => {
      for (const target of targets) weights[names[target]] = Math.max(weights[names[target]] ?? -Infinity, values[k]);
    });
    this.face.setWeights(weights);
    const [head, leftEye, rightEye] = [0, 3, 6].map((first) => this.#anglesAt(values, first));
    const pose = leftEye || rightEye ? {leftEye: leftEye ?? {}, rightEye: rightEye ?? {}} : null;
    // Angles of another clip may still hold the eyes, so that weights would not count.
    if (this.face.eyeCount > 0 && (pose || this.#looks)) this.face.look(pose);
    return head;
  }

  /** Yaw, pitch and roll from angle `first` on, right-handed unlike in the app, or null if the clip has none. */
  #anglesAt(values, first) {
    const columns = this.#angles.slice(first, first + 3);
    if (columns.every((k) => k < 0)) return null;
    const [yaw, pitch, roll] = columns.map((k) => (k < 0 ? 0 : values[k]));
    return {yaw: 0 - yaw, pitch, roll: 0 - roll};
  }
}
