// Reads captures: CSV of Live Link Face, JSON of Audio2Face and MediaPipe.
import {Clip} from './sweepface_clip.js';
import {isObject, lowered, parseJson, textOf} from './sweepface_text.js';
import {isWeight, known, MOST_WEIGHTS} from './sweepface_values.js';

const MOST_TIME = 1e10;  // seconds
const USUAL_RATE = 60;  // frames a second in timecodes

/** The number that a text is, or NaN if there is anything else in it, or a number too small to be told from 0. */
function numberIn(text) {
  const [, digits] = /^[+-]?(\d+(?:\.\d*)?|\.\d+)(?:e[+-]?\d+)?$/i.exec(text) ?? [], number = Number(text);
  return digits === undefined || (number === 0 && /[1-9]/.test(digits)) ? NaN : number;
}

/** Whether a character may surround a cell: ASCII white space only. */
const isBlank = (c) => c === ' ' || (c >= '\t' && c <= '\r');

function trimmed(text) {
  let from = 0, to = text.length;
  while (from < to && isBlank(text[from])) ++from;
  while (from < to && isBlank(text[to - 1])) --to;
  return text.slice(from, to);
}

/** Where the quote at `from` closes, or -1; a doubled quote is part of the text. */
function closingQuote(line, from) {
  let at = line.indexOf('"', from + 1);
  while (at >= 0 && line[at + 1] === '"') at = line.indexOf('"', at + 2);
  return at;
}

/** Splits a line at commas; strips the blanks and quotes around each cell. */
function cellsOf(line) {
  const cells = [];
  for (let from = 0;;) {
    while (line[from] === ' ' || line[from] === '\t') ++from;
    const close = line[from] === '"' ? closingQuote(line, from) : -1;
    const comma = line.indexOf(',', close < 0 ? from : close);
    const cell = trimmed(line.slice(from, comma < 0 ? line.length : comma));
    cells.push(close >= 0 && from + cell.length === close + 1 ? trimmed(cell.slice(1, -1)) : cell);
    if (comma < 0) return cells;
    from = comma + 1;
  }
}

/**
 * A clock that counts frames (SMPTE ST 12-1). At 23.976, 29.97, 47.952 and 59.94 frames a second, a clock second has as
 * many frames as at 24, 30, 48 and 60, and is a thousandth longer. A drop-frame clock skips the numbers of the first
 * two frames (at 30) or four (at 60) of every minute except each tenth.
 */
function clockOf(framesPerSecond, dropsFrames) {
  const longer = 1.001, whole = Math.round(framesPerSecond * longer);
  const isBetween = whole > 0 && !Number.isInteger(framesPerSecond) &&
      Math.abs(framesPerSecond * longer - whole) < 0.0045;
  const counted = isBetween ? whole : framesPerSecond;
  const dropped = dropsFrames && (counted === 30 || counted === 60) ? counted / 15 : 0;
  const length = isBetween || dropped > 0 ? longer : 1;
  const timeOf = (seconds, frames) => {
    const minutes = Math.floor(seconds / 60);
    return (seconds + (frames - dropped * (minutes - Math.floor(minutes / 10))) / counted) * length;
  };
  return {counted, timeOf};
}

/** Whether a recorder stopped while writing the last row: values are missing, or the last one is cut off. */
function isHalf(cells, expected) {
  if (cells.length !== expected) return cells.length < expected;
  return Number.isNaN(numberIn(cells.at(-1))) && /^[-+.eE"0-9]*$/.test(cells.at(-1));
}

function readLiveLink(text, name, framesPerSecond) {
  const lines = text.split(text.includes('\n') ? '\n' : '\r').map((line, k) => ({number: k + 1, text: trimmed(line)}));
  const filled = lines.filter(({text: line}) => line !== '');
  while (filled.length > 0 && lowered(filled[0].text) === 'sep=,') filled.shift();
  if (filled.length === 0) throw new Error(`${name} is empty; record again.`);
  const fail = (line, what) => new Error(`${name}, line ${line.number}: ${what}.`);
  const [first, ...rest] = filled, headings = cellsOf(first.text).map((cell) => cell.replaceAll('""', '"'));
  // Spreadsheets end every line with a comma.
  const endsEmpty = headings.length > 1 && headings.at(-1) === '';
  if (endsEmpty) headings.pop();
  const {timeColumn, shapes} = columnsOf(headings, first.text, (what) => fail(first, what));
  if (rest.length === 0) throw new Error(`${name} has headings but no frames; record again.`);

  const expected = headings.length;
  const last = rest.length > 1 && rest.at(-1) === lines.at(-1) ? cellsOf(rest.at(-1).text) : null;
  const half = last && isHalf(last, expected) ? rest.pop() : null;
  let isClock;
  const weights = [], rows = rest.map((line) => {
    const cells = cellsOf(line.text);
    if (endsEmpty && cells.length === expected + 1 && cells.at(-1) === '') cells.pop();
    if (cells.length !== expected)
      throw fail(line, `there are ${cells.length} values under ${expected} headings; the file may be cut short`);
    const time = timeOf(cells[timeColumn], (what) => fail(line, what));
    isClock ??= time.isClock;
    if (time.isClock !== isClock)
      throw fail(line, `the time '${cells[timeColumn]}' is of another kind than the ones above`);
    for (const [shape, c] of shapes) {
      const value = numberIn(cells[c]);
      if (!isWeight(value))
        throw fail(line, `'${cells[c]}' in column ${c + 1}, '${shape}', is not a number within ±1,000,000; take the ` +
                         'column out if it is no shape');
      weights.push(value);
    }
    return {...time, timecode: cells[timeColumn], line};
  });
  const rate = rateOf(rows), clip = clipOf([...shapes.keys()], rows, weights, framesPerSecond ?? rate, name, fail);
  if (rows[0].isClock && rate < USUAL_RATE && rate < clockOf(framesPerSecond ?? rate, false).counted)
    clip.warnings.unshift(`${name}: ${framesPerSecond} frames a second were asked for, but its timecodes seem to count ${rate}.`);
  if (half) clip.warnings.unshift(`${name}: the last row, line ${half.number}, is cut short and left out.`);
  return clip;
}

/** Makes a clip of rows; of those at the same time, the last one counts. */
function clipOf(names, rows, weights, rate, name, fail) {
  const n = names.length, times = [], repeated = [];
  let midnights = 0;  // seconds of the days that have passed
  rows.forEach(({seconds, frames, isClock, dropsFrames, timecode, line}, row) => {
    const {counted, timeOf: clock} = clockOf(rate, dropsFrames);
    if (frames >= counted)
      throw fail(line, `the timecode '${timecode}' counts more than ${counted} frames a second; ` +
                       'give the recording\'s own rate');
    const before = times.at(-1), shown = isClock ? clock(seconds, frames) : seconds, day = clock(86400, 0);
    // The clock starts again at midnight.
    if (isClock && shown + midnights < before - day / 2) midnights += day;
    const time = shown + (isClock ? midnights : 0);
    if (time < before) throw fail(line, `the timecode '${timecode}' is before the one above; sort the rows by time`);
    if (time === before) repeated.push(line.number);
    else times.push(time);
    const place = times.length - 1;
    if (place < row) for (let k = 0; k < n; ++k) weights[place * n + k] = weights[row * n + k];
  });
  const clip = new Clip(names, new Float64Array(times), new Float64Array(weights.slice(0, times.length * n)));
  if (repeated.length > 0)
    clip.warnings.push(`${name}: ${repeated.length} of ${rows.length} rows, the first in line ${repeated[0]}, have the ` +
                       'timecode of the one before; of each time the last row counts.');
  return clip;
}

/**
 * The rate in which the timecodes of a take count: the first lower one that no frame number reaches, if some whole
 * second has at least 0.8 times as many rows, or else the app's usual rate.
 */
function rateOf(rows) {
  let most = 0, inASecond = 0, count = 0, isWhole = rows[0].frames < 1;
  rows.forEach(({seconds, frames}, row) => {
    most = Math.max(most, Math.floor(frames));
    ++count;
    if (row + 1 === rows.length || rows[row + 1].seconds === seconds) return;
    if (isWhole) inASecond = Math.max(inASecond, count);
    isWhole = true;
    count = 0;
  });
  return [24, 25, 30, 48, 50].find((rate) => most < rate && inASecond >= 0.8 * rate) ?? USUAL_RATE;
}

/** The index of the column of times, and those of shapes by name. */
function columnsOf(headings, line, fail) {
  const shapes = new Map();
  let timeColumn = -1;
  headings.forEach((heading, c) => {
    const isTime = lowered(heading) === 'timecode';
    if (heading === '') throw fail(`column ${c + 1} has no heading`);
    if (shapes.has(heading) || (isTime && timeColumn >= 0))
      throw fail(`there are two columns '${isTime ? 'Timecode' : heading}'`);
    if (isTime) timeColumn = c;
    else if (lowered(heading) !== 'blendshapecount') shapes.set(heading, c);
  });
  if (timeColumn < 0) {
    for (const [separator, called] of [[';', 'semicolons'], ['\t', 'tabs']])
      if (line.includes(separator)) throw fail(`the columns are separated by ${called}; save them with commas`);
    throw fail('there is no column \'Timecode\'; this may be no recording of Live Link Face');
  }
  if (shapes.size === 0) throw fail('there is no column of a shape');
  return {timeColumn, shapes};
}

/** Parses HH:MM:SS:FF.fff, where FF.fff counts frames and follows a ';' if some are dropped; or plain seconds. */
function timeOf(timecode, fail) {
  const seconds = numberIn(timecode);
  if (seconds < 0 && seconds >= -MOST_TIME) throw fail(`the time '${timecode}' is below 0`);
  if (Math.abs(seconds) <= MOST_TIME) return {seconds, frames: 0, isClock: false};
  const plain = timecode.replace(/^([^:;]*:[^:;]*:[^:;]*);/, '$1:'), parts = plain.split(':').map(numberIn);
  if (parts.length !== 4 || !parts.every((part) => part >= 0 && !Object.is(part, -0) && part <= 1e6))
    throw fail(`'${timecode}' is not a timecode like 12:59:59:23.500`);
  if (parts[1] >= 60 || parts[2] >= 60)
    throw fail(`the timecode '${timecode}' has more than 59 minutes or seconds`);
  const [hours, minutes, rest, frames] = parts;
  return {seconds: (hours * 60 + minutes) * 60 + rest, frames, isClock: true, dropsFrames: plain !== timecode};
}

function readAudio2Face(json, name, fail) {
  const {exportFps, facsNames: names, weightMat: rows, numFrames} = json;
  if (!Number.isFinite(exportFps) || !(exportFps > 0)) throw fail('has no \'exportFps\' greater than 0');
  if (!Array.isArray(names) || names.length === 0) throw fail('has no list \'facsNames\' with names in it');
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
  const clip = new Clip(names, Float64Array.from(rows, (_, f) => f / exportFps), new Float64Array(rows.flat()));
  if (numFrames !== undefined && numFrames !== rows.length)
    clip.warnings.push(`${name}: 'numFrames' is ${JSON.stringify(numFrames)}, but 'weightMat' has ${rows.length} frames; ` +
                       'was the file cut short?');
  return clip;
}

function readMediaPipe(frames, framesPerSecond, name, fail) {
  if (frames.length === 0) throw fail('has no frames');
  let broken = 0;
  const times = [], scores = frames.map((frame, f) => {
    times.push(timeIn(frame, f, framesPerSecond, fail));
    if (f > 0 && times[f] <= times[f - 1]) throw fail(`has a time in frame ${f} that is not after the one before`);
    const found = scoresOf(frame, f, fail), angles = found.size > 0 ? headOf(frame) : [];
    if (angles) for (const [name, angle] of angles) found.set(name, angle);
    else ++broken;
    return found;
  });
  keepHeads(scores);
  const shapes = new Set(scores.flatMap((frame) => [...frame.keys()].sort()));
  const names = [...shapes].filter((shape) => shape !== '_neutral');
  if (names.length === 0) throw fail('has no scores in its frames');
  // If every frame had names of its own, a small file would make a huge clip.
  if (names.length > MOST_WEIGHTS / frames.length)
    throw fail(`has ${names.length} names in ${frames.length} frames, more than a clip can hold; ` +
               'name the same ones in every frame');
  // Frames without a face are left out, but the first and last repeat the nearest frame with one, so that the others
  // keep their times.
  const last = frames.length - 1, found = scores.map(({size}) => size > 0);
  const firstFace = found.indexOf(true), lastFace = found.lastIndexOf(true);
  const kept = found.map((_, f) => f).filter((f) => found[f] || f === 0 || f === last);
  const weights = new Float64Array(kept.length * names.length);
  kept.forEach((f, row) => {
    const frame = scores[Math.min(Math.max(f, firstFace), lastFace)];
    names.forEach((shape, k) => { weights[row * names.length + k] = frame.get(shape) ?? 0; });
  });
  const clip = new Clip(names, Float64Array.from(kept, (f) => times[f]), weights);
  if (broken > 0)
    clip.warnings.push(`${name}: ${broken} of ${frames.length} frames have a transformation of the face that is no matrix ` +
                       'of 4 × 4 numbers; the head stands there as in the frame before.');
  const step = 1000 * (times[last] - times[0]) / last, lost = found.filter((has) => !has).length;
  if (step < 1 || step > 5000)  // no camera does that
    clip.warnings.push(`${name}: frames are ${step > 1 ? Math.round(step) : Number(step.toPrecision(3))} ms apart; are the ` +
                       'times milliseconds, as they should be?');
  if (lost > 0)
    clip.warnings.push(`${name}: ${lost} of ${frames.length} frames found no face; weights go on from the frames around ` +
                       'them.');
  return clip;
}

/** The time of a frame in seconds. */
function timeIn(frame, f, framesPerSecond, fail) {
  const time = frame?.[['timestampMs', 'timestamp_ms', 'timestamp'].find((key) => frame[key] !== undefined)];
  if (typeof time !== 'number' && !(time === undefined && framesPerSecond))
    throw fail(`has no 'timestampMs' in frame ${f}; add the milliseconds, or give the frames a second`);
  const seconds = time === undefined ? f / framesPerSecond : time / 1000;
  if (!(Math.abs(seconds) <= MOST_TIME)) throw fail(`has a time in frame ${f} that is not within 300 years`);
  return seconds;
}

// The categories of a frame stand beside its time, or in the first of the faces found: an object in JavaScript, the
// list itself in Python. A frame without a face has none.
function categoriesOf(frame) {
  if (frame?.categories !== undefined) return frame.categories;
  const [face = []] = [frame?.faceBlendshapes, frame?.face_blendshapes].find(Array.isArray) ?? [null];
  return Array.isArray(face) ? face : face?.categories;
}

function scoresOf(frame, f, fail) {
  const categories = categoriesOf(frame);
  if (!Array.isArray(categories)) throw fail(`has no 'categories' in frame ${f}`);
  return new Map(categories.map((category) => {
    const {categoryName: shape = category?.category_name} = category ?? {};
    if (typeof shape !== 'string' || !Number.isFinite(category.score))
      throw fail(`has a category without 'categoryName' and 'score' in frame ${f}`);
    if (!isWeight(category.score)) throw fail(`has a score in frame ${f} that is not within ±1,000,000`);
    return [shape, category.score];
  }));
}

/** The first three numbers of the columns of a matrix: an object as in JavaScript, or a list of rows as in Python. */
function columnsOf4x4(matrix) {
  const {data = Array.isArray(matrix) && matrix.every((row) => row?.length === 4) ? matrix.flat() : null} = matrix ?? {};
  if (!Array.isArray(data) || data.length !== 16 || !data.every(Number.isFinite)) return null;
  const [down, across] = data === matrix.data ? [1, 4] : [4, 1];
  return [0, 1, 2].map((c) => [0, 1, 2].map((r) => data[c * across + r * down]));
}

/** Where a frame does not tell how the head turns, it stands as in the one before, or else as in the first that does. */
function keepHeads(scores) {
  const tells = (frame) => frame.has('HeadYaw');
  let last = scores.find(tells);
  for (const frame of last ? scores : []) {
    if (tells(frame)) last = frame;
    else if (frame.size > 0) for (const angle of ['HeadYaw', 'HeadPitch', 'HeadRoll']) frame.set(angle, last.get(angle));
  }
}

/** How the head of a frame turns, by left-handed angles; none without a matrix, null if it is broken. */
function headOf(frame) {
  const matrices = frame.facialTransformationMatrixes ?? frame.facial_transformation_matrixes ?? [];
  if (Array.isArray(matrices) && matrices.length === 0) return [];
  const columns = Array.isArray(matrices) ? columnsOf4x4(matrices[0]) : null;
  const [x, y, z] = columns?.map((column) => Math.hypot(...column)) ?? [];
  if (!(x > 0 && y > 0 && z > 0)) return null;
  const [turnedX, turnedY, turnedZ] = columns;
  return [['HeadYaw', 0 - Math.atan2(turnedZ[0], turnedZ[2])],
          ['HeadPitch', Math.asin(Math.min(Math.max(-turnedZ[1] / z, -1), 1))],
          ['HeadRoll', 0 - Math.atan2(turnedX[1] / x, turnedY[1] / y)]];
}

/**
 * Reads a capture from its text or bytes: CSV of Live Link Face, whose timecodes count in `framesPerSecond` (by default
 * the rate that they imply, or else 60), or JSON of Audio2Face or MediaPipe. `name` is what messages call it.
 */
export function readClip(source, options) {
  const {name: given, framesPerSecond} = known(options, ['name', 'framesPerSecond'], 'readClip');
  const name = given || 'The clip', text = textOf(source, 'clip', name);
  if (framesPerSecond !== undefined && !(framesPerSecond > 0 && Number.isFinite(framesPerSecond)))
    throw new RangeError('The frames per second of a recording must be greater than 0.');
  if (text.startsWith('glTF')) throw new Error(`${name} is a .glb, of which three.js plays the animations.`);
  if (!/^[ \t-\r]*[{[]/.test(text)) return readLiveLink(text, name, framesPerSecond);
  const json = parseJson(text, name), fail = (what) => new Error(`${name} ${what}.`);
  if (isObject(json) && json.events !== undefined) throw fail('is a timeline; readTimeline reads it');
  if (isObject(json) && json.weightMat !== undefined) return readAudio2Face(json, name, fail);
  const frames = Array.isArray(json) ? json : json.frames;
  if (Array.isArray(frames)) return readMediaPipe(frames, framesPerSecond, name, fail);
  if (isObject(json) && json.asset !== undefined) throw fail('is a .gltf, of which three.js plays the animations');
  throw fail('is neither of Audio2Face (\'facsNames\' and \'weightMat\'), nor of MediaPipe (a list of frames ' +
             'with \'categories\'), nor a timeline (\'seconds\' and \'events\'); export it as one of them');
}
