// Clips for faces: captures of Live Link Face (CSV), MediaPipe and Audio2Face (JSON) and timelines, as docs/clips.md
// describes them. They are read the way the library in C++ reads them, in plain JavaScript, which parses text and JSON
// by itself: nothing else is fetched.

const decoder = new TextDecoder();

/** Of any realm: frames and Node's vm have an ArrayBuffer of their own. */
const isBuffer = (source) => Object.prototype.toString.call(source) === '[object ArrayBuffer]';

function textOf(source, what) {
  if (typeof source === 'string') return source.replace(/^\uFEFF/, '');
  const {buffer = source, byteOffset, byteLength} = source ?? {};
  // A copy, as browsers do not decode memory that is shared.
  if (isBuffer(source) || ArrayBuffer.isView(source))
    return decoder.decode(new Uint8Array(buffer, byteOffset, byteLength).slice());
  throw new TypeError(`A ${what} is read from text or bytes.`);
}

/** Options as they are, of which one that there is not is a slip. */
function known(options, keys, what) {
  for (const key of Object.keys(options ?? {}))
    if (!keys.includes(key)) throw new TypeError(`${what} has no option '${key}'; it has ${keys.join(', ')}.`);
  return options ?? {};
}

/** A number that nothing stands beside, or NaN. */
function numberIn(text) {
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text) ? Number(text) : NaN;
}

const DAY = 86400, MOST_TIME = 1e10;  // seconds
/** Weights that a clip can hold: frames times names. */
const MOST_WEIGHTS = 2 ** 26;

const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);
/** Whether a text can mean this as a weight; more is a slip. */
const isWeight = (value) => isNumber(value) && Math.abs(value) <= 1e6;
const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

/** Small letters, of A to Z alone. */
const lowered = (text) => text.replace(/[A-Z]/g, (letter) => letter.toLowerCase());

/** What a cell may have round it: the spaces of ASCII alone. */
const isBlank = (c) => c === ' ' || (c >= '\t' && c <= '\r');

function trimmed(text) {
  let from = 0, to = text.length;
  while (from < to && isBlank(text[from])) ++from;
  while (from < to && isBlank(text[to - 1])) --to;
  return text.slice(from, to);
}

/** How engines say that a text ends too soon, where they count no characters. */
const CUT_SHORT = /^(JSON.parse: |JSON Parse error: )?(unexpected )?(end|EOF|unterminated)/i;

function parseJson(text, name) {
  try {
    return JSON.parse(text);
  } catch (error) {
    // Engines tell the place in words of their own, or not at all.
    const [, at, , told] = error.message.match(/ at (?:position (\d+)( \(.*\))?|line (\d+) column.*)$/) ?? [];
    const isCut = at === undefined ? CUT_SHORT.test(error.message) : at >= text.length;
    const line = isCut || at ? text.slice(0, isCut ? undefined : at).split('\n').length : told;
    const what = `${line ? `, line ${line}: this` : ''} is not JSON${isCut ? '; was the file cut short?' : '.'}`;
    throw new Error(name + what, {cause: error});
  }
}

// ---- Names ----

/** A name without what spellings differ in: small letters, and a side as a final _l or _r. */
function plain(name) {
  const text = lowered(name.replace(/[_\- ]/g, ''));
  for (const side of ['left', 'right'])
    if (text.length > side.length && text.endsWith(side)) return `${text.slice(0, -side.length)}_${side[0]}`;
  // A single letter is a side only where the name sets it apart: jawL, jaw_L, but not "curl".
  const isApart = /([_\- ][LRlr]|[a-z][LR])$/.test(name);
  return isApart && text.length > 1 ? `${text.slice(0, -1)}_${text.at(-1)}` : text;
}

/**
 * Which target each name of a clip drives: `targets` [names] of indices, `unmatched` names of the clip that drive
 * nothing, `undriven` targets that nothing drives.
 */
export function matchNames(names, targets) {
  const byName = new Map(), byPlain = new Map(), driven = new Set();
  targets.forEach((target, k) => {
    if (!byName.has(target)) byName.set(target, k);
    if (!byPlain.has(plain(target))) byPlain.set(plain(target), k);
  });
  const own = names.map((name) => byName.get(name) ?? byPlain.get(plain(name)));
  // Both sides at once, where they have no names of their own.
  const sides = (name) => ['_l', '_r'].map((side) => byPlain.get(plain(name) + side))
                              .filter((k) => k !== undefined && !own.includes(k));
  const found = names.map((name, k) => (own[k] !== undefined ? [own[k]] : sides(name)));
  for (const k of found.flat()) driven.add(k);
  return {
    targets: found,
    unmatched: names.filter((_, k) => found[k].length === 0),
    undriven: targets.filter((_, k) => !driven.has(k))
  };
}

// ---- Clips ----

/** Seconds in which speeds would not stay finite. */
const NO_TIME = 1e-9;
const ONE_EURO = ['cutoff', 'speedGain', 'speedCutoff'];

/** Weights over time: `names` [N], `times` [F] in seconds, `weights` [F x N]. */
export class Clip {
  constructor(names, times, weights) {
    this.names = names;
    this.times = times;
    this.weights = weights;
  }

  get seconds() { return this.times.length === 0 ? 0 : this.times.at(-1) - this.times[0]; }

  /** The weights [N] at so many seconds after the first frame, straight between frames and held at the ends. */
  at(seconds, out = new Float64Array(this.names.length)) {
    if (typeof seconds !== 'number' || Number.isNaN(seconds))
      throw new RangeError(`A time is a number of seconds, not ${seconds}.`);
    const {times, weights} = this, n = this.names.length, time = times[0] + Math.max(seconds, 0);
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

  /** Without the noise of a tracker, by the one-euro filter: heavily where weights rest, hardly where they move. */
  smooth(settings) {
    const {cutoff = 1, speedGain = 2, speedCutoff = 1} = known(settings, ONE_EURO, 'The one-euro filter');
    for (const number of [cutoff, speedGain, speedCutoff])
      if (!(isNumber(number) && number >= 0))
        throw new RangeError(`The one-euro filter needs finite numbers of at least 0, not ${number}.`);
    const n = this.names.length, weights = this.weights.slice(), speeds = new Float64Array(n);
    const share = (hertz, seconds) => 1 - 1 / (2 * Math.PI * hertz * seconds + 1);
    for (let f = 1; f < this.times.length; ++f) {
      const seconds = this.times[f] - this.times[f - 1];
      if (!(seconds > NO_TIME)) {  // the filter begins anew
        speeds.fill(0);
        continue;
      }
      for (let k = 0; k < n; ++k) {
        const before = weights[(f - 1) * n + k], now = weights[f * n + k];
        speeds[k] += ((now - before) / seconds - speeds[k]) * share(speedCutoff, seconds);
        weights[f * n + k] = before + (now - before) * share(cutoff + speedGain * Math.abs(speeds[k]), seconds);
      }
    }
    return new Clip(this.names, this.times, weights);
  }
}

function readLiveLink(text, name, framesPerSecond) {
  const cellsOf = (line) => line.split(',').map(trimmed);
  const lines = text.split(text.includes('\n') ? '\n' : '\r').map((line, k) => ({number: k + 1, cells: cellsOf(line)}));
  const filled = lines.filter(({cells}) => cells.length > 1 || cells[0] !== '');
  if (filled.length === 0) throw new Error(`${name} is empty; record again.`);
  const fail = (line, what) => new Error(`${name}, line ${line.number}: ${what}.`);
  const [headings, ...rows] = filled, shapes = new Map();  // and their columns
  let timeColumn = -1;
  headings.cells.forEach((heading, c) => {
    const isTime = lowered(heading) === 'timecode';
    if (heading === '') throw fail(headings, `column ${c + 1} has no heading`);
    if (shapes.has(heading) || (isTime && timeColumn >= 0))
      throw fail(headings, `there are two columns '${isTime ? 'Timecode' : heading}'`);
    if (isTime) timeColumn = c;
    else if (lowered(heading) !== 'blendshapecount') shapes.set(heading, c);
  });
  if (timeColumn < 0)
    throw fail(headings, 'there is no column \'Timecode\'; this may be no recording of Live Link Face');
  if (shapes.size === 0) throw fail(headings, 'there is no column of a shape');
  if (rows.length === 0) throw new Error(`${name} has headings but no frames; record again.`);

  const times = new Float64Array(rows.length), weights = [];
  let midnights = 0;  // in seconds
  rows.forEach((row, f) => {
    const {cells} = row, timecode = cells[timeColumn], expected = headings.cells.length;
    if (cells.length !== expected)
      throw fail(row, `there are ${cells.length} values under ${expected} headings; the file may be cut short`);
    const {seconds, isClock} = timeOf(timecode, framesPerSecond, (what) => fail(row, what));
    // At midnight the clock begins anew.
    if (isClock && f > 0 && seconds + midnights < times[f - 1] - DAY / 2) midnights += DAY;
    times[f] = seconds + (isClock ? midnights : 0);
    if (f > 0 && times[f] <= times[f - 1])
      throw fail(row, `the timecode '${timecode}' is not after the one before; sort the rows by time`);
    for (const c of shapes.values()) {
      const value = numberIn(cells[c]);
      if (!isWeight(value)) throw fail(row, `'${cells[c]}' in column ${c + 1} is not a number within ±1,000,000`);
      weights.push(value);
    }
  });
  return new Clip([...shapes.keys()], times, new Float64Array(weights));
}

/** HH:MM:SS:FF.fff, the last in frames; or plain seconds. */
function timeOf(timecode, framesPerSecond, fail) {
  const seconds = numberIn(timecode);
  if (Math.abs(seconds) <= MOST_TIME) return {seconds, isClock: false};
  const parts = timecode.split(':').map(numberIn);
  if (parts.length !== 4 || !parts.every((part) => part >= 0 && part <= 1e6))
    throw fail(`'${timecode}' is not a timecode like 12:59:59:23.500`);
  if (parts[3] >= framesPerSecond)
    throw fail(`the timecode '${timecode}' counts more than ${framesPerSecond} frames a second; ` +
               'give the recording\'s own rate');
  return {seconds: (parts[0] * 60 + parts[1]) * 60 + parts[2] + parts[3] / framesPerSecond, isClock: true};
}

function readAudio2Face(json, fail) {
  const {exportFps, facsNames: names, weightMat: rows} = json;
  if (!isNumber(exportFps) || !(exportFps > 0)) throw fail('has no \'exportFps\' greater than 0');
  if (!Array.isArray(names) || names.length === 0) throw fail('has no list \'facsNames\'');
  if (!names.every((name) => typeof name === 'string')) throw fail('has a value in \'facsNames\' that is not a name');
  const seen = new Set(), twice = names.find((name) => seen.size === seen.add(name).size);
  if (twice !== undefined) throw fail(`names '${twice}' twice in 'facsNames'`);
  if (!Array.isArray(rows) || rows.length === 0) throw fail('has no frames in \'weightMat\'');
  if (!(rows.length / exportFps <= MOST_TIME)) throw fail('has too low an \'exportFps\' for its frames');
  rows.forEach((row, f) => {
    if (!Array.isArray(row) || row.length !== names.length)
      throw fail(`has not ${names.length} numbers in weightMat[${f}], one for every name`);
    if (!row.every(isWeight)) throw fail(`has a value that is not a number within ±1,000,000 in weightMat[${f}]`);
  });
  return new Clip(names, Float64Array.from(rows, (_, f) => f / exportFps), new Float64Array(rows.flat()));
}

function readMediaPipe(frames, fail) {
  if (frames.length === 0) throw fail('has no frames');
  const times = new Float64Array(frames.length), scores = frames.map((frame, f) => {
    const time = frame?.[['timestampMs', 'timestamp_ms', 'timestamp'].find((key) => frame[key] !== undefined)];
    if (typeof time !== 'number') throw fail(`has no 'timestampMs' in frame ${f}`);
    times[f] = time / 1000;
    if (!(Math.abs(times[f]) <= MOST_TIME) || (f > 0 && times[f] <= times[f - 1]))
      throw fail(`has a time in frame ${f} that is not after the one before`);
    return scoresOf(frame, f, fail);
  });
  const shapes = new Set(scores.flatMap((frame) => [...frame.keys()].sort()));
  const names = [...shapes].filter((shape) => shape !== '_neutral');
  if (names.length === 0) throw fail('has no scores in its frames');
  // Frames that each have names of their own would make many of few.
  if (names.length > MOST_WEIGHTS / frames.length)
    throw fail(`has ${names.length} names in ${frames.length} frames, more than a clip can hold; ` +
               'name the same ones in every frame');
  const weights = new Float64Array(frames.length * names.length);
  scores.forEach((frame, f) => names.forEach((shape, k) => {
    weights[f * names.length + k] = frame.get(shape) ?? 0;
  }));
  return new Clip(names, times, weights);
}

function scoresOf(frame, f, fail) {
  // Beside the time, or within the first of the faces found. A frame without a face has none.
  const {faceBlendshapes: faces = frame.face_blendshapes} = frame;
  const {categories = Array.isArray(faces) && faces.length === 0 ? [] : faces?.[0]?.categories} = frame;
  if (!Array.isArray(categories)) throw fail(`has no 'categories' in frame ${f}`);
  return new Map(categories.map((category) => {
    const shape = category?.categoryName ?? category?.category_name;
    if (typeof shape !== 'string' || !isWeight(category.score))
      throw fail(`has a category without 'categoryName' and 'score' in frame ${f}`);
    return [shape, category.score];
  }));
}

/**
 * A capture, from its text or bytes: a CSV of Live Link Face, whose timecodes count in `framesPerSecond`, or a JSON of
 * Audio2Face or MediaPipe. `name` is what messages call it.
 */
export function readClip(source, options) {
  const {name: given, framesPerSecond = 60} = known(options, ['name', 'framesPerSecond'], 'readClip');
  const text = textOf(source, 'clip'), name = given || 'The clip';
  if (!(framesPerSecond > 0 && Number.isFinite(framesPerSecond)))
    throw new RangeError('The frames per second of a recording must be greater than 0.');
  if (!/^[ \t-\r]*[{[]/.test(text)) return readLiveLink(text, name, framesPerSecond);
  const json = parseJson(text, name), fail = (what) => new Error(`${name} ${what}.`);
  if (isObject(json) && json.weightMat !== undefined) return readAudio2Face(json, fail);
  const frames = Array.isArray(json) ? json : json.frames;
  if (Array.isArray(frames)) return readMediaPipe(frames, fail);
  throw fail('is neither of Audio2Face (\'facsNames\' and \'weightMat\'), nor of MediaPipe (a list of frames ' +
             'with \'categories\'), nor a timeline (\'seconds\' and \'events\')');
}

/** The angles of Live Link Face, in radians, in the order of the app. */
const ANGLES = ['Head', 'LeftEye', 'RightEye'].flatMap((of) => ['Yaw', 'Pitch', 'Roll'].map((angle) => of + angle));

/** Whether a clip ever has anything but 0 in a column. */
function isTold({names, weights}, column) {
  for (let i = column; i < weights.length; i += names.length) if (weights[i] !== 0) return true;
  return false;
}

/** Plays a clip on a face: `seek` sets the weights of a time. */
export class ClipPlayer {
  #angles = ANGLES.map(() => -1);  // their columns, or -1

  constructor(face, clip) {
    this.face = face;
    this.clip = clip;
    /** What drives what: see matchNames. */
    this.match = matchNames(clip.names, face.names);
    this.match.unmatched = matchNames(this.match.unmatched, ANGLES).unmatched;
    // Recordings have columns for the eyes' angles that are 0 throughout where nobody told them. Eyes use no roll.
    const counts = (angle, k) => angle < 3 || (angle % 3 < 2 && isTold(clip, k));
    matchNames(clip.names, ANGLES).targets.forEach((found, k) => {
      for (const angle of found) if (counts(angle, k)) this.#angles[angle] = k;
    });
  }

  get seconds() { return this.clip.seconds; }

  /**
   * Sets the weights that the clip drives, turns eyes if it has their angles, and returns the angles of the head,
   * {yaw, pitch, roll} in radians, or null where the clip has none: for three.js
   * `head.rotation.set(pitch, yaw, roll, 'YXZ')`. Where two names drive a target the larger weight counts.
   */
  seek(seconds) {
    const values = this.clip.at(seconds), names = this.face.names, weights = Object.create(null);
    this.match.targets.forEach((targets, k) => {
      for (const target of targets) weights[names[target]] = Math.max(weights[names[target]] ?? -Infinity, values[k]);
    });
    this.face.setWeights(weights);
    const [head, leftEye, rightEye] = [0, 3, 6].map((first) => this.#anglesAt(values, first));
    if (this.face.eyeCount > 0 && (leftEye || rightEye))
      this.face.look({leftEye: leftEye ?? {}, rightEye: rightEye ?? {}});
    return head;
  }

  /** Yaw, pitch and roll from a column on, or null where the clip has none of them. */
  #anglesAt(values, first) {
    const columns = this.#angles.slice(first, first + 3);
    if (columns.every((k) => k < 0)) return null;
    const [yaw, pitch, roll] = columns.map((k) => (k < 0 ? 0 : values[k]));
    return {yaw, pitch, roll};
  }
}

// ---- Timelines ----

const DRIVES = ['cut', 'newton', 'linear-force', 'accelerate-brake', 'spring', 'bounce'];
const DRIVE = ['seconds', 'turn', 'frequency', 'damping', 'restitution', 'delay'];
const EVENT = ['at', 'to', 'only', 'drive', 'region', ...DRIVE];
const TIMELINE = ['seconds', 'loops', 'poses', 'events', 'regions'];

/** A timeline from its JSON text or bytes: {seconds, loops, events, regions}; `regions` are for Sweepface.load. */
export function readTimeline(source, options) {
  const {name: given} = known(options, ['name'], 'readTimeline');
  const name = given || 'The timeline', json = parseJson(textOf(source, 'timeline'), name);
  const fail = (place, what) => new Error(`${name}: ${place} ${what}.`);
  if (!isObject(json)) throw fail('the file', 'is not an object');
  for (const key of Object.keys(json))
    if (!TIMELINE.includes(key)) throw fail('the file', `has an unknown key '${key}'`);
  const {seconds, loops = 1, poses = {}, events, regions} = json;
  if (seconds === undefined) throw fail('the file', 'has no \'seconds\'');
  for (const key of ['seconds', 'loops'])
    if (key in json && !isNumber(json[key])) throw fail('the file', `has a '${key}' that is not a number`);
  if (!(seconds > 0)) throw fail('\'seconds\'', 'must be greater than 0');
  if (!Number.isInteger(loops) || loops < 1 || loops > 10000)
    throw fail('\'loops\'', 'must be a whole number from 1 to 10000');
  if (!Array.isArray(events) || events.length === 0) throw fail('\'events\'', 'must be a list of at least one event');
  if (regions !== undefined && !Array.isArray(regions)) throw fail('\'regions\'', 'are not a list');
  const read = events.map((event, k) => readEvent(event, poses, `events[${k}]`, fail))
                   .sort((a, b) => a.at - b.at);
  if (read.at(-1).at > seconds) throw fail('\'events\'', 'hold one that is later than \'seconds\'');
  return {seconds, loops, events: read, regions};
}

/** What keeps a drive from setting out from 0 to 1, in the library's words. */
function faultOf({drive = 'spring', seconds = 1, turn = 0.5, frequency = 1, damping = 1, restitution = 0}) {
  const tooMuch = (...numbers) => (numbers.every(Number.isFinite) ? undefined : 'A motion needs finite numbers');
  if (drive === 'cut') return;
  if (drive === 'spring') {
    const omega = 2 * Math.PI * frequency;
    return tooMuch(omega ** 2, (damping * omega) ** 2) ??
           (frequency > 0 && damping >= 0 ? undefined
                                          : 'A spring needs a frequency greater than 0 and a damping of at least 0');
  }
  if (drive === 'bounce' && !(restitution >= 0 && restitution <= 1 - 1e-9))
    return 'A bounce keeps a part of its speed: the restitution lies in [0, 1)';
  if (!(seconds > 0)) return 'The motion must last a finite time greater than 0 seconds';
  if (drive === 'linear-force') return tooMuch(12 / seconds / seconds / seconds);  // how fast the force changes
  if (drive !== 'accelerate-brake') return tooMuch(2 / seconds / seconds);
  if (!(turn > 0 && turn < 1)) return 'The force must turn after the start and before the end: between 0 and 1';
  return tooMuch(2 / Math.min(turn, 1 - turn) / seconds / seconds);
}

function readEvent(event, poses, place, failAt) {
  const fail = (what) => failAt(place, what);
  if (!isObject(event)) throw fail('is not an object');
  for (const key of Object.keys(event))
    if (!EVENT.includes(key)) throw fail(`has an unknown key '${key}'`);
  if (!('at' in event)) throw fail('has no \'at\'');
  for (const key of ['at', ...DRIVE])
    if (key in event && !isNumber(event[key])) throw fail(`has a '${key}' that is not a number`);
  for (const key of ['drive', 'region'])
    if (key in event && typeof event[key] !== 'string') throw fail(`has a '${key}' that is not a text`);
  if ('drive' in event && !DRIVES.includes(event.drive))
    throw failAt(`${place}:`, `There is no way to move called "${event.drive}"; there are ${DRIVES.join(', ')}`);
  if (event.at < 0) throw fail('is before 0');
  const fault = faultOf(event);
  if (fault) throw fail(`cannot be: ${fault}`);
  if (event.delay < 0) throw fail('has a negative \'delay\'');
  if (('to' in event) === ('only' in event)) throw fail('needs one of \'to\' and \'only\', the weights to go to');
  const goals = readGoals(event.to ?? event.only, poses, place, failAt), drive = {kind: event.drive ?? 'spring'};
  for (const key of DRIVE)
    if (key in event) drive[key] = event[key];
  return {at: event.at, goals, others: 'only' in event, drive, region: event.region || undefined};
}

/** Weights by name, or by the name of a pose that has them. */
function readGoals(wanted, poses, place, failAt) {
  if (typeof wanted === 'string') {
    if (!(isObject(poses) && Object.keys(poses).includes(wanted)))
      throw failAt(place, `goes to a pose '${wanted}' that 'poses' does not have`);
    const pose = `pose '${wanted}'`;
    if (!isObject(poses[wanted])) throw failAt(pose, 'is not an object of weights');
    return readGoals(poses[wanted], poses, pose, failAt);
  }
  if (!isObject(wanted)) throw failAt(place, 'goes neither to weights nor to a pose');
  for (const [weight, goal] of Object.entries(wanted))
    if (!isWeight(goal)) throw failAt(place, `has a weight '${weight}' that is not a number within ±1,000,000`);
  return wanted;
}

/** Whether that is all of a face of one piece. */
const isWhole = (face, region) => region === 'rest' && !face.regions?.length;

/** Plays a timeline on a face: `advance` lets time pass, and what sets out does so at its own instant. */
export class TimelinePlayer {
  #goals;
  #now = 0;
  #next = 0;  // of all events of all loops

  constructor(face, timeline) {
    for (const {region} of timeline.events)
      if (region && face.regions?.includes(region) === false && !isWhole(face, region))
        throw new Error(`The timeline moves a region '${region}'; the face has ${face.regions.join(', ') || 'none'}.`);
    this.face = face;
    this.timeline = timeline;
    const names = [...new Set(timeline.events.flatMap(({goals}) => Object.keys(goals)))];
    /** What drives what: see matchNames. */
    this.match = matchNames(names, face.names);
    this.#goals = new Map(names.map((name, k) => [name, this.match.targets[k].map((target) => face.names[target])]));
  }

  get seconds() { return this.timeline.seconds * this.timeline.loops; }

  /** Says whether anything is still to come or moves. */
  advance(seconds) {
    if (!Number.isFinite(seconds)) throw new RangeError(`Time passes by a finite number of seconds, not ${seconds}.`);
    const {events, seconds: length, loops} = this.timeline, until = this.#now + Math.max(seconds, 0);
    let moves = false;
    while (this.#next < loops * events.length) {
      const event = events[this.#next % events.length], loop = Math.floor(this.#next / events.length);
      const start = event.at + loop * length;
      if (start > until) break;
      this.face.advance(start - this.#now);
      this.#now = start;
      ++this.#next;  // also where the face refuses it
      this.#play(event);
      moves = true;
    }
    moves = this.face.advance(until - this.#now) || moves;
    this.#now = until;
    return moves || this.#now < this.seconds;
  }

  #play({goals, others, drive, region}) {
    const all = others ? Object.fromEntries([...this.#goals.values()].flat().map((target) => [target, 0])) : {};
    const named = Object.create(null);  // of two names for one target the larger counts
    for (const [name, goal] of Object.entries(goals))
      for (const target of this.#goals.get(name)) named[target] = Math.max(named[target] ?? -Infinity, goal);
    this.face.moveTo({...all, ...named}, drive, isWhole(this.face, region) ? undefined : region);
  }
}
