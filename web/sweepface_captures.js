// Captures: CSVs of Live Link Face, JSONs of Audio2Face and MediaPipe.
import {Clip} from './sweepface_clip.js';
import {isNumber, isObject, isWeight, lowered, parseJson, textOf} from './sweepface_text.js';
import {known} from './sweepface_values.js';

const DAY = 86400, MOST_TIME = 1e10;  // seconds
/** Weights that a clip can hold: frames times names. */
const MOST_WEIGHTS = 2 ** 26;

/** A number that nothing stands beside, or NaN. */
function numberIn(text) {
  return /^[+-]?(\d+(\.\d*)?|\.\d+)(e[+-]?\d+)?$/i.test(text) ? Number(text) : NaN;
}

/** What a cell may have round it: the spaces of ASCII alone. */
const isBlank = (c) => c === ' ' || (c >= '\t' && c <= '\r');

function trimmed(text) {
  let from = 0, to = text.length;
  while (from < to && isBlank(text[from])) ++from;
  while (from < to && isBlank(text[to - 1])) --to;
  return text.slice(from, to);
}

function readLiveLink(text, name, framesPerSecond) {
  const cellsOf = (line) => line.split(',').map(trimmed);
  const lines = text.split(text.includes('\n') ? '\n' : '\r').map((line, k) => ({number: k + 1, cells: cellsOf(line)}));
  const filled = lines.filter(({cells}) => cells.length > 1 || cells[0] !== '');
  if (filled.length === 0) throw new Error(`${name} is empty; record again.`);
  const fail = (line, what) => new Error(`${name}, line ${line.number}: ${what}.`);
  const [headings, ...rows] = filled;
  const {timeColumn, shapes} = columnsOf(headings.cells, (what) => fail(headings, what));
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

/** The column of times, and those of shapes by name. */
function columnsOf(headings, fail) {
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
  if (timeColumn < 0) throw fail('there is no column \'Timecode\'; this may be no recording of Live Link Face');
  if (shapes.size === 0) throw fail('there is no column of a shape');
  return {timeColumn, shapes};
}

/** HH:MM:SS:FF.fff, the last in frames; or plain seconds. */
function timeOf(timecode, framesPerSecond, fail) {
  const seconds = numberIn(timecode);
  if (seconds < 0 && seconds >= -MOST_TIME) throw fail(`the time '${timecode}' is below 0`);
  if (Math.abs(seconds) <= MOST_TIME) return {seconds, isClock: false};
  const parts = timecode.split(':').map(numberIn);
  if (parts.length !== 4 || !parts.every((part) => part >= 0 && part <= 1e6))
    throw fail(`'${timecode}' is not a timecode like 12:59:59:23.500`);
  if (parts[1] >= 60 || parts[2] >= 60)
    throw fail(`the timecode '${timecode}' has more than 59 minutes or seconds`);
  if (parts[3] >= framesPerSecond)
    throw fail(`the timecode '${timecode}' counts more than ${framesPerSecond} frames a second; ` +
               'give the recording\'s own rate');
  return {seconds: (parts[0] * 60 + parts[1]) * 60 + parts[2] + parts[3] / framesPerSecond, isClock: true};
}

function readAudio2Face(json, fail) {
  const {exportFps, facsNames: names, weightMat: rows} = json;
  if (!isNumber(exportFps) || !(exportFps > 0)) throw fail('has no \'exportFps\' greater than 0');
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
    if (typeof shape !== 'string' || !isNumber(category.score))
      throw fail(`has a category without 'categoryName' and 'score' in frame ${f}`);
    if (!isWeight(category.score)) throw fail(`has a score in frame ${f} that is not within ±1,000,000`);
    return [shape, category.score];
  }));
}

/**
 * A capture, from its text or bytes: a CSV of Live Link Face, whose timecodes count in `framesPerSecond`, or a JSON of
 * Audio2Face or MediaPipe. `name` is what messages call it.
 */
export function readClip(source, options) {
  const {name: given, framesPerSecond = 60} = known(options, ['name', 'framesPerSecond'], 'readClip');
  const name = given || 'The clip', text = textOf(source, 'clip', name);
  if (!(framesPerSecond > 0 && Number.isFinite(framesPerSecond)))
    throw new RangeError('The frames per second of a recording must be greater than 0.');
  if (!/^[ \t-\r]*[{[]/.test(text)) return readLiveLink(text, name, framesPerSecond);
  const json = parseJson(text, name), fail = (what) => new Error(`${name} ${what}.`);
  if (isObject(json) && json.events !== undefined) throw fail('is a timeline; readTimeline reads it');
  if (isObject(json) && json.weightMat !== undefined) return readAudio2Face(json, fail);
  const frames = Array.isArray(json) ? json : json.frames;
  if (Array.isArray(frames)) return readMediaPipe(frames, fail);
  throw fail('is neither of Audio2Face (\'facsNames\' and \'weightMat\'), nor of MediaPipe (a list of frames ' +
             'with \'categories\'), nor a timeline (\'seconds\' and \'events\')');
}
