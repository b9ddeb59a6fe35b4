import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {runInNewContext} from 'node:vm';
import {Clip, ClipPlayer, matchNames, readClip, readTimeline, TimelinePlayer} from '../sweepface_clips.js';
import {Sweepface} from '../sweepface.js';
import {newFolder, sample, tool} from './native.js';

/** A clip as the tool plays it: a recording of its frames, read back. */
function played(file, text, options = []) {
  const folder = newFolder(), clip = join(folder, file), out = join(folder, 'out.csv');
  writeFileSync(clip, text);
  const parameters = ['animate', sample, '--clip', clip, '-o', out, '--quiet', ...options];
  execFileSync(tool, parameters, {stdio: 'pipe'});
  return readClip(readFileSync(out), {name: 'out.csv'});
}

/** The tool's message about a clip. */
function refusal(file, text) {
  try {
    played(file, text);
  } catch (error) {
    return String(error.stderr);
  }
  return 'It took it.';
}

const wave = (f, k) => Math.round(1e4 * (0.5 + 0.5 * Math.sin(0.2 * f * (k + 1)))) / 1e4;
const shapes = ['JawOpen', 'eyeBlink_L', 'EyeBlinkRight', 'browInnerUp', 'tongueOut',
                'HeadYaw', 'HeadPitch', 'HeadRoll'];
const frames = Array.from({length: 40}, (_, f) => f);
const timecode = (f) => `00:00:0${Math.floor(f / 30)}:${String(2 * (f % 30)).padStart(2, '0')}.000`;
const row = (f) => [timecode(f), 52, ...shapes.map((_, k) => wave(f, k))];
const rows = [['Timecode', 'BlendshapeCount', ...shapes], ...frames.map(row)];
const csv = rows.map((cells) => cells.join(',')).join('\r\n');
const few = shapes.slice(0, 4);
const audio2Face = JSON.stringify({
  exportFps: 30, facsNames: few, weightMat: frames.map((f) => few.map((_, k) => wave(f, k)))
});
const mediaPipe = JSON.stringify(frames.map((f) => ({
  timestampMs: 33 * f + 5,
  faceBlendshapes: f % 7 < 2 ? [] : [{categories: few.map((categoryName, k) => ({categoryName, score: wave(f, k)}))}]
})));
const python = JSON.stringify(frames.map((f) => ({
  timestamp_ms: 33 * f + 5,
  faceBlendshapes: null, face_blendshapes: [few.map((name, k) => ({index: k, category_name: name, score: wave(f, k)}))]
})));
const at30 = (f) => `00:00:0${Math.floor((f + 7) / 10)};${String((f + 7) % 10 * 3).padStart(2, '0')}.500`;
const sheet = 'sep=,\n' + [['Timecode', 'BlendshapeCount', ...shapes], ...frames.flatMap((f) => [
  [at30(f), 52, ...shapes.map(() => 0.25)], [at30(f), 52, ...shapes.map((_, k) => wave(f, k))]])]
    .map((cells) => cells.map((cell) => `"${cell}"`).join(',') + ',').join('\n');

// Timecodes from the 55th second into a minute whose first frame numbers are dropped, and a note with a comma.
const dropped = (f) => `00:0${Math.floor((1650 + f) / 1800)}:${String(Math.floor((1650 + f) / 30) % 60).padStart(2, '0')};` +
                       String((1650 + f) % 30).padStart(2, '0');
const slow = [['Timecode', ...shapes, '"a, ""b"""'],
              ...Array.from({length: 240}, (_, f) => f).filter((f) => f < 150 || f > 151)
                  .map((f) => [dropped(f), ...shapes.map((_, k) => wave(f, k)), '"1"'])].map((cells) => cells.join(',')).join('\n');

for (const [title, file, text] of [['Live Link Face', 'take.csv', csv], ['drop frames', 'take.csv', slow],
                                   ['lines that end in returns', 'take.csv', csv.replaceAll('\r\n', '\r')], ['Audio2Face', 'take.json', audio2Face],
                                   ['a spreadsheet, with rows twice', 'take.csv', sheet],
                                   ['MediaPipe', 'take.json', mediaPipe], ['its Python', 'take.json', python]])
  for (const smooth of [false, true])
    test(`a capture of ${title}${smooth ? ', smoothed,' : ''} plays as the tool plays it`, async () => {
      const face = await Sweepface.load(readFileSync(sample)), clip = readClip(text, {name: file});
      const player = new ClipPlayer(face, smooth ? clip.smooth() : clip);
      const native = played(file, text, ['--fps', '60', ...(smooth ? ['--smooth'] : [])]);
      const names = native.names.map((name) => matchNames([name], face.names).targets[0].map((k) => face.names[k]));
      assert.ok(native.times.length >= 60);
      native.times.forEach((time, f) => {
        player.seek(time - native.times[0]);
        const {weights} = face;
        names.forEach((targets, k) => {
          const expected = native.weights[f * names.length + k];
          for (const target of targets) assert.ok(Math.abs(weights[target] - expected) < 1e-12, `${target} at ${time}`);
        });
      });
      assert.ok(face.weights.jawOpen > 0);
    });

test('frames so seldom that their times are none are refused', () => {
  const text = JSON.stringify([0, 1].map((score) => ({categories: [{categoryName: 'jawOpen', score}]})));
  assert.throws(() => readClip(text, {name: 'a.json', framesPerSecond: 1e-300}),
                {message: 'a.json has a time in frame 1 that is not within 300 years.'});
});

test('animations of glTF files are left to three.js', () => {
  const fails = (source, words) => assert.throws(
    () => readClip(source, {name: 'a'}), {message: `a ${words}, of which three.js plays the animations.`});
  fails(Uint8Array.from('glTF\x02\0\0\0\xff\x01\0\0', (letter) => letter.charCodeAt(0)), 'is a .glb');
  fails('{"asset": {"version": "2.0"}}', 'is a .gltf');
});

test('a timeline that is read as a capture is told from one', () => {
  for (const more of ['', ', "weightMat": [[0]]', ', "frames": []'])
    assert.throws(() => readClip(`{"seconds": 1, "events": []${more}}`, {name: 'talk.json'}),
                  {message: 'talk.json is a timeline; readTimeline reads it.'});
});

test('frames without time between them begin the filter anew, as for the tool', () => {
  const text = 'Timecode,JawOpen\n0,0\n5e-10,1\n0.05,0.5\n1,1\n', clip = readClip(text).smooth();
  const native = played('take.csv', text, ['--smooth', '--fps', '60']), k = native.names.indexOf('JawOpen');
  native.times.forEach((time, f) => {
    const [weight] = clip.at(time - native.times[0]), expected = native.weights[f * native.names.length + k];
    assert.ok(Math.abs(weight - expected) < 1e-12, `${weight} instead of ${expected} at ${time}`);
  });
});

test('the filter takes settings that it has, and finite ones', () => {
  const clip = readClip(csv);
  assert.deepEqual(clip.smooth(null).weights, clip.smooth().weights);
  for (const settings of [{cutoff: NaN}, {cutoff: -1}, {speedGain: Infinity}, {speedCutoff: '1'}])
    assert.throws(() => clip.smooth(settings), {name: 'RangeError', message: /finite numbers of at least 0, not /});
  assert.throws(() => clip.smooth({cutOff: 1}), {message: /no option 'cutOff'; it has cutoff, speedGain, speedCutoff\.$/});
});

test('what was mended in a file is told', () => {
  const warnings = (text, options) => readClip(text, {name: 'take', ...options}).smooth().warnings;
  assert.deepEqual(warnings(csv), []);
  assert.deepEqual(warnings(sheet), ['take: 40 of 80 rows, the first in line 4, have the timecode of the one before; of each ' +
                                     'time the last row counts.']);
  for (const half of ['1', '1,', '1,2', '1,2,', '1,2,-', '1,2,1e-', '1,2,.', '1,2,"0.5'])
    assert.deepEqual(readClip(`Timecode,a,b\n0,1,1\n${half}`, {name: 'take'}),
                     Object.assign(readClip('Timecode,a,b\n0,1,1\n', {name: 'take'}),
                                   {warnings: ['take: the last row, line 3, is cut short and left out.']}));
  assert.deepEqual(warnings(mediaPipe), ['take: 12 of 40 frames found no face; weights go on from the frames around them.']);
  assert.match(warnings(mediaPipe.replace(/"timestampMs":\d+,/g, ''), {framesPerSecond: 2e4})[0], /frames are 0\.05 ms apart/);
  assert.match(warnings(audio2Face.replace('{', '{"numFrames": 41,'))[0], /'numFrames' is 41, but 'weightMat' has 40 frames/);
});

/** A take at `rate` frames a second, by default from the middle of a second on. */
const take = (rate, length = 4 * rate, first = rate >> 1) => 'Timecode,a\n' + Array.from({length}, (_, k) => k + first)
    .map((f) => `1:02:0${Math.floor(f / rate)}:${f % rate},0`).join('\n');

test('a rate that timecodes contradict is told', () => {
  const warnings = (rate, framesPerSecond) => readClip(take(rate), {name: 'take', framesPerSecond}).warnings;
  assert.deepEqual(warnings(30, 60), ['take: 60 frames a second were asked for, but its timecodes seem to count 30.']);
  assert.equal(warnings(24, 29.97).length, 1);
  for (const [rate, given] of [[30, 30], [30, 29.97], [60, 59.94], [60, 120], [30, undefined]])
    assert.deepEqual(warnings(rate, given), []);
  const seconds = 'Timecode,a\n' + Array.from({length: 120}, (_, k) => `${Math.floor(k / 30)},0\n`).join('');
  assert.equal(readClip(seconds, {framesPerSecond: 60}).warnings.length, 1, 'they count no frames');
});

test('a separator is told after blank lines, too', () => {
  assert.equal(readClip('\nsep=,\n\nsep=,\nTimecode,a\n0,1\n').weights[0], 1);
});

test('timecodes tell their rate where whole seconds are there', () => {
  for (const rate of [24, 25, 30, 48, 50, 60])
    assert.ok(Math.abs(readClip(take(rate)).seconds - (4 - 1 / rate)) < 1e-9, `${rate}`);
  assert.ok(Math.abs(readClip(take(24, 48, 0)).seconds - 47 / 24) < 1e-9);
  assert.ok(Math.abs(readClip(take(24, 47, 1)).seconds - (1 + 22 / 60)) < 1e-9, 'no second is whole');
  const [first, second] = readClip(take(24).split('\n').filter((_, k) => k === 0 || k % 2 === 1).join('\n')).times;
  assert.ok(Math.abs(second - first - 2 / 60) < 1e-9, 'half of the rows');
  assert.ok(Math.abs(readClip('Timecode,a\n0:0:0:0,0\n0:0:1:15,0\n0:0:2:0,0\n').times[1] - 1.25) < 1e-12);
});

test('clocks between whole rates go slower, and those that drop frames skip them in all minutes but each tenth', () => {
  const hour = (mark, framesPerSecond) =>
    readClip(`Timecode,a\n0:0:0${mark}0,0\n1:0:0${mark}0,0\n`, {framesPerSecond}).seconds;
  assert.ok(Math.abs(hour(':', 29.97) - 3603.6) < 1e-6);
  for (const rate of [29.97, 30, 59.94, 60]) assert.ok(Math.abs(hour(';', rate) - 3599.9964) < 1e-6, `${rate}`);
  const midnight = readClip('Timecode,a\n23:59:59:0,0\n0:0:0:0,0\n', {framesPerSecond: 29.97});
  assert.ok(Math.abs(midnight.seconds - 1.001) < 1e-6);
  for (const rate of [0, -1, NaN, Infinity, '30'])
    assert.throws(() => hour(':', rate), {name: 'RangeError', message: /greater than 0/});
});

test('frames of MediaPipe may lack a face or a name, and the neutral is none', () => {
  const score = (categoryName, score) => ({categoryName, score});
  const frames = [[score('_neutral', 1), score('a', 0.5)], [score('b', 0.25)], []];
  const clip = readClip(JSON.stringify(frames.map((categories, f) => ({timestamp: 6000 * f, categories}))));
  assert.deepEqual(clip.names, ['a', 'b']);
  assert.deepEqual([...clip.weights], [0.5, 0, 0, 0.25, 0, 0.25]);
  assert.match(clip.warnings[0], /frames are 6000 ms apart/);
});

test('frames of MediaPipe tell how the head turns', () => {
  const [yaw, pitch, roll] = [0.5, -0.3, 0.2], [sy, sp, sr] = [yaw, pitch, roll].map(Math.sin);
  const [cy, cp, cr] = [yaw, pitch, roll].map(Math.cos);
  const rows = [[cy * cr + sy * sp * sr, sy * sp * cr - cy * sr, sy * cp, 1], [cp * sr, cp * cr, -sp, 2],
                [cy * sp * sr - sy * cr, sy * sr + cy * sp * cr, cy * cp, 3], [0, 0, 0, 1]];
  const frame = (transform) => ({timestamp: 0, categories: [{categoryName: 'a', score: 1}], ...transform});
  const read = (transform) => readClip(JSON.stringify([frame(transform)]), {name: 'take.json'});
  const data = [0, 1, 2, 3].flatMap((c) => rows.map((row) => row[c]));
  for (const clip of [read({facialTransformationMatrixes: [{rows: 4, columns: 4, data}]}),
                      read({facial_transformation_matrixes: [rows]})]) {
    assert.deepEqual(clip.names, ['HeadPitch', 'HeadRoll', 'HeadYaw', 'a']);
    [pitch, -roll, -yaw, 1].forEach((angle, k) => assert.ok(Math.abs(clip.weights[k] - angle) < 1e-12, clip.names[k]));
    assert.deepEqual(clip.warnings, []);
  }
  const told = {facial_transformation_matrixes: [rows]};
  const several = readClip(JSON.stringify([{}, told, {}].map((transform, f) => ({...frame(transform), timestamp: 33 * f}))));
  assert.deepEqual([0, 1, 2].map((f) => several.weights[4 * f + 2]), Array(3).fill(read(told).weights[2]));
  for (const none of [{}, {facialTransformationMatrixes: []}, {facialTransformationMatrixes: null}])
    assert.deepEqual(read(none), read({}));
  for (const wrong of ['', [5], {}, [[1, 2]], [{data: [1]}], [{data: rows}], [{data: data.map((x, k) => k < 4 ? 0 : x)}]]) {
    const clip = read({facialTransformationMatrixes: wrong});
    assert.deepEqual(clip.names, ['a']);
    assert.match(clip.warnings[0], /^take.json: 1 of 1 frames have a transformation of the face that is no matrix of 4 × 4/);
  }
});

test('headings may be of any case, and have quotes in them', () => {
  assert.deepEqual(readClip('SEP=,\ntimecode,BLENDSHAPECOUNT,"a ""b"""\n0,52,1\n').names, ['a "b"']);
});

test('numbers may have a sign and an exponent', () => {
  assert.deepEqual([...readClip('Timecode,a\n0,+.5\n1,-5E-1\n').weights], [0.5, -0.5]);
});

test('a number too small to be told from 0 is none, as for the tool', () => {
  const small = 'Timecode,a\n0,1e-400\n1,0e-400\n';
  assert.match(refusal('small.csv', small), /'1e-400'/);
  assert.throws(() => readClip(small), /line 2.*'1e-400'/);
  assert.deepEqual([...readClip('Timecode,a\n0,0e-400\n1,.00\n').weights], [0, 0]);
});

test('options that there are not are refused', () => {
  assert.throws(() => readClip(csv, {fps: 30}), {message: 'readClip has no option \'fps\'; it has name, framesPerSecond.'});
  assert.throws(() => readTimeline('{}', {fps: 30}), {message: 'readTimeline has no option \'fps\'; it has name.'});
  assert.equal(readClip(csv, null).times.length, frames.length);
});

test('a cell of many digits is refused at once', {timeout: 5000}, () => {
  const digits = '1'.repeat(300_000);
  assert.throws(() => readClip(`Timecode,a\n${digits}x,0\n`), /line 2/);
  assert.throws(() => readClip(`Timecode,a\n0,${digits}x\n`), /line 2/);
});

test('times are numbers', async () => {
  const clip = readClip(csv), player = new ClipPlayer(await Sweepface.load(readFileSync(sample)), clip);
  for (const seconds of [NaN, undefined, '0.5'])
    for (const go of [() => clip.at(seconds), () => player.seek(seconds)])
      assert.throws(go, {name: 'RangeError', message: /a number of seconds, not /});
  assert.deepEqual(clip.at(Infinity), clip.at(1e9));
});

test('captures are read by browsers that have no Object.hasOwn', () => {
  const {hasOwn} = Object;
  delete Object.hasOwn;  // as in Chrome 92 and Firefox 90
  try {
    assert.equal(readClip(python).times.length, frames.length);
  } finally {
    Object.hasOwn = hasOwn;
  }
});

test('a clip without frames has weights of 0', () => {
  assert.deepEqual(new Clip(['a'], new Float64Array(), new Float64Array()).at(1, Float64Array.of(5)), Float64Array.of(0));
});

test('of frames at one time the last counts', () => {
  assert.equal(new Clip(['a'], Float64Array.of(0, 1, 1), Float64Array.of(0, 1, 2)).at(1)[0], 2);
});

test('clips have a weight for every name and time, and are asked for them in floats', () => {
  const times = Float64Array.of(0, 1), weights = Float64Array.of(0, 1, 2, 3), clip = new Clip(['a', 'b'], times, weights);
  for (const numbers of [[['a'], times, weights], [['a', 'b'], times, weights.subarray(1)], [[], times, weights]])
    assert.throws(() => new Clip(...numbers), {name: 'RangeError', message: /^A clip of \d names and 2 times has as many/});
  for (const numbers of [[], ['ab', times, weights], [['a', 'b'], [0, 1], weights], [['a', 'b'], times]])
    assert.throws(() => new Clip(...numbers), {name: 'TypeError', message: /^A clip is made of a list of names/});
  for (const no of [[0, NaN], [1, 0], [0, Infinity]])
    assert.throws(() => new Clip(['a', 'b'], Float64Array.from(no), weights), {name: 'RangeError', message: /^The times of a/});
  assert.throws(() => new Clip(['a', 'b'], times, Float64Array.of(0, 1, NaN, 3)), {name: 'RangeError', message: /weights/});
  for (const names of [[['a']], [['a', 5], ['a']], [['a'], [null]]])
    assert.throws(() => matchNames(...names), {name: 'TypeError', message: /^Names of a clip are matched/});
  assert.throws(() => clip.at(0, new Float64Array(1)), {name: 'RangeError', message: 'There must be room for 2 weights, not 1.'});
  for (const out of [null, [0, 0], new Int8Array(2)])
    assert.throws(() => clip.at(0, out), {name: 'TypeError', message: /^Weights are written to a Float32Array or/});
  assert.deepEqual(clip.at(0.5, new Float32Array(3)), Float32Array.of(1, 2, 0));
});

test('players need a face, and what they play', async () => {
  const face = await Sweepface.load(readFileSync(sample)), clip = readClip(csv);
  for (const [one, other] of [[face], [null, clip], [clip, face], [face, Promise.resolve(clip)], [face, timeline]])
    assert.throws(() => new ClipPlayer(one, other), {name: 'TypeError', message: /^A ClipPlayer plays a clip on a face; /});
  for (const [one, other] of [[face], [undefined, timeline], [face, clip]])
    assert.throws(() => new TimelinePlayer(one, other), {name: 'TypeError', message: /^A TimelinePlayer plays a timeline/});
});

test('events that were made by hand are played by their times', async () => {
  const face = await Sweepface.load(readFileSync(sample)), drive = {kind: 'cut'}, others = false;
  const events = [[0.5, 1], [0.2, 0.25], [0.5, 0.75]].map(([at, jawOpen]) => ({at, goals: {jawOpen}, others, drive}));
  const player = new TimelinePlayer(face, {seconds: 1, loops: 1, events});
  for (const jawOpen of [0.25, 0.75]) {
    player.advance(0.3);
    assert.equal(face.weights.jawOpen, jawOpen);
  }
});

test('names are matched and reported', async () => {
  const face = await Sweepface.load(readFileSync(sample)), player = new ClipPlayer(face, readClip(csv));
  assert.deepEqual(player.match.unmatched, ['tongueOut'].filter((name) => !face.names.includes(name)));
  assert.ok(player.match.undriven.length > 20);
  const {targets} = matchNames(['browInnerUp', 'eye_blink-left', 'curl', 'jawL'],
                               ['browInnerUp_L', 'browInnerUp_R', 'eyeBlinkLeft', 'cur_L', 'jawLeft']);
  assert.deepEqual(targets, [[0, 1], [2], [], [4]]);
  // A side that has a name of its own is driven by that name.
  assert.deepEqual(matchNames(['up', 'upLeft'], ['up_L', 'up_R']).targets, [[1], [0]]);
  assert.deepEqual(matchNames(['eye.blink.left', 'jaw_l'], ['jawLeft', 'eyeBlinkLeft']).targets, [[1], [0]]);
  assert.deepEqual(matchNames(['jaw', 'mouth'], ['jawLeft', 'jawRight', 'mouthLeft', 'mouthRight']).targets, [[], []]);
  assert.deepEqual(matchNames(['jawOpen', 'jaw_open'], ['JawOpen', 'jawOpen']).targets, [[1], [0]]);
  assert.deepEqual(matchNames(['_'], ['left', 'Right', '_L', '_R']).targets, [[]]);  // a side alone is a name
  const prefixed = ['Head.jawOpen', 'Head.eye_blink_L', 'Head.eye_blink_R', 'Head.mouthLeft'];
  assert.deepEqual(matchNames(['jawOpen', 'EyeBlinkLeft', 'eyeBlink', 'mouth', 'Head', 'head jaw open'], prefixed).targets,
                   [[0], [1], [2], [], [], [0]]);
  assert.deepEqual(matchNames(['open', 'eyeOpen'], ['eye_open', 'eye_shut']).targets, [[0], [0]]);
  assert.deepEqual(matchNames(['open'], ['eyeOpen', 'eyeShut']).targets, [[]]);  // no separator
  assert.deepEqual(matchNames(['open', 'b'], ['a:open', 'open', 'b']).targets, [[1], [2]]);  // not all have it
  assert.deepEqual(matchNames(['b:up'], ['a:', 'a:b:up', 'a:b:']).targets, [[]]);  // not a whole name
  assert.deepEqual(matchNames(['up'], ['a:up']).targets, [[]]);  // one name has nothing in common with others
  assert.deepEqual(matchNames(['a'], ['', 'x:a', 'x:b']).targets, [[]]);
  assert.deepEqual(matchNames(['ÄUGE'], ['äuge']).unmatched, ['ÄUGE']);  // case is ignored for A to Z only
});

test('a map of names drives what it drives in the tool', () => {
  const map = {jawOpen: ['mouthFunnel', 'jawOpen'], eyeBlinkLeft: {jawOpen: 0.5, noseSneerLeft: -0.25},
               eye_blink_right: ['noseSneerLeft', 'browInnerUp'], tongueOut: null, beard: 'jawOpen'};
  const names = join(newFolder(), 'names.json');
  writeFileSync(names, JSON.stringify(map));
  const expected = played('take.csv', csv, ['--clip-names', names]), clip = readClip(csv).renamed(map);
  assert.deepEqual(new Set(clip.names), new Set(['browInnerUp', 'HeadYaw', 'HeadPitch', 'HeadRoll', 'mouthFunnel',
                                                 'jawOpen', 'noseSneerLeft']));
  assert.deepEqual(clip.warnings, ['The clip has no beard.']);
  const {targets} = matchNames(clip.names, expected.names);
  for (let f = 0; f < clip.times.length; ++f)
    clip.names.forEach((name, k) => {
      if (!/^Head/.test(name))
        assert.ok(Math.abs(clip.weights[f * clip.names.length + k] - expected.weights[f * expected.names.length + targets[k][0]]) < 1e-12, name);
    });
});

test('a name of a map without a side takes the larger of both, and drives no side of a name that stays', () => {
  const blink = readClip('Timecode,EyeBlinkLeft,EyeBlinkRight\n0,0.25,0.75\n').renamed({eyeBlink: 'mouthFunnel'});
  assert.deepEqual([blink.names, [...blink.weights]], [['mouthFunnel'], [0.75]]);
  const brow = readClip('Timecode,browInnerUp,jawOpen\n0,0.5,1\n').renamed({jawOpen: 'browInnerUpLeft'});
  assert.deepEqual([brow.names, [...brow.weights]], [['browInnerUp', 'browInnerUpLeft'], [0.5, 1]]);
});

test('a map of names keeps what was told before', () => {
  const clip = readClip('Timecode,a\n0,1\n0,2\n1,3\n'), {warnings} = clip;
  assert.equal(warnings.length, 1);
  assert.deepEqual(clip.renamed({a: 'b'}).warnings, warnings);
  assert.deepEqual(clip.renamed({a: 'b', c: 'd'}).warnings, [...warnings, 'The clip has no c.']);
});

test('what is no map of names is refused', () => {
  const clip = readClip(csv);
  for (const map of [null, undefined, ['jawOpen'], 'jawOpen', {}])
    assert.throws(() => clip.renamed(map), /^TypeError: A map of names is an object that has targets/);
  for (const drives of [1, ['a', 1], {a: 'b'}, {a: NaN}, {a: 1001}, true])
    assert.throws(() => clip.renamed({jawOpen: drives}), /^TypeError: 'jawOpen' drives the name of a target, a list/);
  assert.throws(() => clip.renamed({jawOpen: 'a', jaw_open: 'b'}), /^TypeError: 'jawOpen' and 'jaw_open' are one name of the clip/);
  const loud = new Clip(['jawOpen'], new Float64Array(1), new Float64Array([5e3]));
  assert.throws(() => loud.renamed({jawOpen: {a: 300}}), /^RangeError: 'a' would get a weight beyond/);
});

test('a map of names may make no clip that the tool could not hold', {timeout: 5000}, () => {
  const clip = new Clip(['jawOpen'], new Float64Array(70_000), new Float64Array(70_000));
  const targets = Array.from({length: 1000}, (_, k) => `target${k}`);
  assert.throws(() => clip.renamed({jawOpen: targets}), {name: 'RangeError', message: /too many weights; cut it/});
});

test('timelines of many goals are refused as by the tool, others are read at once', {timeout: 20_000}, () => {
  const many = (poses, weights, events) => JSON.stringify({
    seconds: 9, poses: Object.fromEntries(Array.from({length: poses}, (_, p) => [
      `pose${p}`, Object.fromEntries(Array.from({length: weights}, (_, k) => [`target${k}`, 0.5]))])),
    events: Array.from({length: events}, (_, k) => ({at: k / events, to: `pose${k % poses}`}))});
  const timeline = readTimeline(many(20_000, 1, 20_000));
  assert.equal(timeline.events.length, 20_000);
  assert.throws(() => readTimeline(many(1, 3000, 3000), {name: 'a.json'}),
                {message: /^a\.json: events\[2666\] is beyond the 8,000,000 goals of a timeline/});
  assert.match(refusal('a.json', many(1, 3000, 3000)), /events\[2666\] is beyond the 8,000,000 goals/);
});

test('any text is a name', () => {
  const names = ['constructor', '__proto__'], given = [];
  const face = {names, eyeCount: 0, setWeights: (weights) => given.push(weights), moveTo: (goals) => given.push(goals),
                advance: () => false};
  new ClipPlayer(face, readClip('Timecode,constructor,__proto__\n0,0.5,0.25')).seek(0);
  const events = '[{"at": 0, "to": {"constructor": 0.5, "__proto__": 0.25}}]';
  new TimelinePlayer(face, readTimeline(`{"seconds": 1, "events": ${events}}`)).advance(0);
  assert.deepEqual(given.map(Object.entries), [0, 1].map(() => [['constructor', 0.5], ['__proto__', 0.25]]));
});

test('the head has the angles of the app', async () => {
  const face = await Sweepface.load(readFileSync(sample)), clip = readClip(csv);
  const [yaw, pitch, roll] = clip.at(0.1).slice(5);
  assert.deepEqual(new ClipPlayer(face, clip).seek(0.1), {yaw: -yaw, pitch, roll: -roll});  // the app is left-handed
  assert.equal(new ClipPlayer(face, readClip(audio2Face)).seek(0), null);
  assert.deepEqual(new ClipPlayer(face, readClip('Timecode,HeadYaw,jawOpen\n0,0,1\n')).seek(0), {yaw: 0, pitch: 0, roll: 0});
  const spelt = new ClipPlayer(face, readClip('Timecode,head_yaw,Head Pitch,jawOpen\n0,0.25,0.5,1'));
  assert.deepEqual(spelt.seek(0), {yaw: -0.25, pitch: 0.5, roll: 0});
  assert.deepEqual(spelt.match.unmatched, []);
});

const timeline = {
  seconds: 1.5, loops: 2, poses: {smile: {mouthSmileLeft: 1, mouthSmileRight: 1}},
  events: [{at: 0.9, only: {}, drive: 'accelerate-brake', seconds: 0.5},
           {at: 0.1, to: 'smile', drive: 'linear-force', seconds: 0.6},
           {at: 0.3, to: {jawOpen: 0.6}, frequency: 3, damping: 0.5, delay: 0.05}]
};

test('a timeline plays as the tool plays it, whatever the frame rate', async () => {
  const text = JSON.stringify(timeline), native = played('scene.json', text, ['--fps', '60']);
  for (const steps of [1, 3]) {
    const face = await Sweepface.load(readFileSync(sample)), player = new TimelinePlayer(face, readTimeline(text));
    assert.equal(new TimelinePlayer(face.clone(), readTimeline(text)).advance(2), true);
    assert.equal(player.seconds, 3);
    for (let f = 0; f < native.times.length; ++f) {
      for (let k = 0; f > 0 && k < steps; ++k) player.advance((native.times[f] - native.times[f - 1]) / steps);
      if (f === 0) player.advance(0);
      for (const name of ['mouthSmileLeft', 'jawOpen']) {
        const k = native.names.findIndex((shape) => shape.toLowerCase() === name.toLowerCase());
        const expected = native.weights[f * native.names.length + k];
        assert.ok(Math.abs(face.weights[name] - expected) < 1e-9, `${name} at ${native.times[f]}`);
      }
    }
    assert.equal(player.advance(0.1), false);
  }
});

test('a timeline plays again from where the face stands', async () => {
  const face = await Sweepface.load(readFileSync(sample));
  const events = [{at: 0, to: {jawOpen: 1}, drive: 'cut'}, {at: 0.5, to: {jawOpen: 0.5}, drive: 'cut'}];
  const player = new TimelinePlayer(face, readTimeline(JSON.stringify({seconds: 1, events})));
  const play = (seconds) => [player.advance(seconds), face.weights.jawOpen];
  assert.deepEqual([play(0.1), play(0.9), play(0.1)], [[true, 1], [true, 0.5], [false, 0.5]]);
  player.restart();
  assert.equal(face.weights.jawOpen, 0.5);
  assert.deepEqual([play(0.1), play(0.9)], [[true, 1], [true, 0.5]]);
});

test('time that is no number plays nothing', async () => {
  const face = await Sweepface.load(readFileSync(sample));
  const player = new TimelinePlayer(face, readTimeline(JSON.stringify(timeline)));
  for (const seconds of [NaN, Infinity, undefined])
    assert.throws(() => player.advance(seconds), {message: /finite number of seconds/});
  for (const wrong of [1e11, -1]) assert.equal(player.advance(wrong), true);  // a wrong clock
  assert.equal(face.weights.jawOpen, 0);
  player.advance(0.4);
  assert.ok(face.weights.jawOpen > 0);
});

test('captures go on past midnight and below 0, as for the tool', async () => {
  const text = 'Timecode,JawOpen\n23:59:59:30,-0.5\n0:0:0:0,1\n0:0:0:30,-0.25\n';
  const clip = readClip(text), native = played('take.csv', text, ['--fps', '4']), face = await Sweepface.load(readFileSync(sample));
  const player = new ClipPlayer(face, clip), k = native.names.indexOf('JawOpen');
  assert.equal(clip.seconds, 1);
  native.times.forEach((time, f) => {
    player.seek(time - native.times[0]);
    assert.equal(face.weights.jawOpen, native.weights[f * native.names.length + k]);
  });
  assert.throws(() => readClip('Timecode,a\n10:0:0:0,0\n9:59:59:0,1\n'), {message: /is before the one above/});
});

test('a delay may lead to the end of all loops', () => {
  for (const [seconds, loops, at, delay] of [[1, 2, 0.5, 1], [0.3, 1, 0.1, 0.2]])
    assert.equal(readTimeline(JSON.stringify({seconds, loops, events: [{at, to: {}, delay}]})).events.length, 1);
});

test('the rest of a face of one piece is all of it, and of two names for a target the larger counts', async () => {
  const face = await Sweepface.load(readFileSync(sample));
  const events = [{at: 0, to: {jawOpen: 0.75, JawOpen: 0.25}, drive: 'cut', region: 'rest'}];
  new TimelinePlayer(face, readTimeline(JSON.stringify({seconds: 1, events}))).advance(0.1);
  assert.equal(face.weights.jawOpen, 0.75);
  new ClipPlayer(face, readClip('Timecode,jawOpen,JawOpen\n0,0.5,0.25')).seek(0);
  assert.equal(face.weights.jawOpen, 0.5);
});

test('shared memory is read, and that of another realm', () => {
  const bytes = new TextEncoder().encode(csv), foreign = runInNewContext('(all) => Uint8Array.from(all).buffer');
  assert.equal(readClip(foreign(bytes)).times.length, frames.length);
  const shared = new Uint8Array(new SharedArrayBuffer(bytes.length));
  shared.set(bytes);
  assert.equal(readClip(shared).times.length, frames.length);
  assert.equal(readClip(bytes.buffer).times.length, frames.length);
});

test('a timeline of regions that the face lacks is refused, and what a face refuses is passed over', async () => {
  const face = await Sweepface.load(readFileSync(sample));
  const cheeks = readTimeline(JSON.stringify({seconds: 1, events: [{at: 0, to: {jawOpen: 1}, region: 'cheeks'}]}));
  assert.throws(() => new TimelinePlayer(face, cheeks), {message: /moves a region 'cheeks'; the face has none\.$/});
  const everywhere = {seconds: 1, events: [{at: 0, to: {jawOpen: 1}, drive: 'cut', region: ''}]};
  new TimelinePlayer(face, readTimeline(JSON.stringify(everywhere))).advance(0.1);
  assert.equal(face.weights.jawOpen, 1);
  const events = [{at: 0.1, to: {jawOpen: 0}}, {at: 0.2, to: {jawOpen: 0.5}, drive: 'cut'}];
  const player = new TimelinePlayer(face, readTimeline(JSON.stringify({seconds: 1, events})));
  player.timeline.events[0].drive.frequency = 1e300;
  assert.throws(() => player.advance(0.5), {message: /finite numbers/});
  player.advance(0.5);
  assert.equal(face.weights.jawOpen, 0.5);
});

test('text may begin with a byte order mark, and other things are no clips', () => {
  assert.equal(readTimeline('\uFEFF' + JSON.stringify(timeline)).loops, 2);
  assert.equal(readClip('\uFEFF' + audio2Face).times.length, frames.length);
  assert.throws(() => readTimeline(timeline), {message: 'A timeline is read from text or bytes.'});
  assert.throws(() => readClip({}), {message: 'A clip is read from text or bytes.'});
});

test('messages call what has no name a clip or a timeline', () => {
  for (const options of [undefined, {name: undefined}, {name: ''}]) {
    assert.throws(() => readClip('', options), {message: 'The clip is empty; record again.'});
    assert.throws(() => readTimeline('[]', options), {message: 'The timeline: the file is not an object.'});
  }
});

test('a time is told by one column', () => {
  assert.throws(() => readClip('Timecode,a,TIMECODE\n0,1,5', {name: 'a.csv'}), {message: /there are two columns 'Timecode'\.$/});
});

test('however many values a row should have, as many as there are take memory', () => {
  const wide = Array.from({length: 200_000}, (_, k) => `a${k}`), frames = '0\n'.repeat(200_000);
  assert.throws(() => readClip(`Timecode,${wide}\n${frames}`), {message: /there are 1 values under 200001 headings/});
});

test('where JSON goes wrong is said as far as the engine tells', () => {
  const {parse} = JSON;
  try {
    for (const [told, said] of [
           ['Unexpected token \']\', ..." at position 1" is not valid JSON', ' is not JSON.'],
           ['Expected \',\' in JSON at position 3 (line 2 column 1)', ', line 2: this is not JSON.'],
           ['JSON.parse: expected property name at line 2 column 2 of the JSON data', ', line 2: this is not JSON.'],
           ['JSON.parse: end of data after property value at line 3 column 2 of the JSON data',
            ', line 3: this is not JSON; was the file cut short?'],
           ['JSON Parse error: Unexpected identifier "a"', ' is not JSON.'],
           ['JSON Parse error: Unexpected EOF', ', line 3: this is not JSON; was the file cut short?']]) {
      JSON.parse = () => { throw new SyntaxError(told); };
      assert.throws(() => readClip('{\n1\n', {name: 'a.json'}), {message: `a.json${said}`});
    }
  } finally {
    JSON.parse = parse;
  }
});

test('texts in UTF-16 are told as such', () => {
  for (const [read, bytes] of [[readClip, [0xff, 0xfe, 0x54, 0]], [readTimeline, [0xfe, 0xff, 0, 0x7b]]])
    assert.throws(() => read(Uint8Array.from(bytes), {name: 'a'}), {message: 'a is a text in UTF-16; save it in UTF-8.'});
});

// Frames that each have a name of their own.
const scattered = JSON.stringify(Array.from({length: 8200}, (_, f) => {
  return {timestampMs: f, categories: [{categoryName: `a${f}`, score: 0}]};
}));

// The package and the tool give the same messages.
for (const [file, text, words] of [
       ['a.csv', '', 'is empty; record again'],
       ['a.csv', 'Time,JawOpen\n0,1', 'there is no column \'Timecode\''],
       ['a.csv', 'Timecode,BlendshapeCount\n0,52', 'there is no column of a shape'],
       ['a.csv', 'Timecode,JawOpen', 'has headings but no frames'],
       ['a.csv', 'Timecode,JawOpen,JawOpen\n0,1,1', ', line 1: there are two columns \'JawOpen\''],
       ['a.csv', 'Timecode,,JawOpen\n0,1,1', ', line 1: column 2 has no heading'],
       ['a.csv', 'Timecode,JawOpen\n0,1\n1\n', ', line 3: there are 1 values under 2 headings'],
       ['a.csv', 'Timecode,JawOpen\n0,1\n1\n ', ', line 3: there are 1 values under 2 headings'],
       ['a.csv', 'Timecode,JawOpen\n1', ', line 2: there are 1 values under 2 headings'],
       ['a.csv', 'Timecode,JawOpen\n-1,1', ', line 2: the time \'-1\' is below 0'],
       ['a.csv', 'Timecode,JawOpen\n\n1,1\n0,1', ', line 4: the timecode \'0\' is before the one above; sort'],
       ['a.csv', 'Timecode;JawOpen\n1;0,5', ', line 1: the columns are separated by semicolons; save them with commas'],
       ['a.csv', 'Timecode\tJawOpen\n1\t0', ', line 1: the columns are separated by tabs; save them with commas'],
       ['a.csv', 'Timecode,JawOpen,\n1,0,2', ', line 2: there are 3 values under 2 headings'],
       ['a.json', '[{"categories": []}]', ' has no \'timestampMs\' in frame 0; add the milliseconds, or give the frames a second'],
       ['a.json', '[{"timestampMs": 1e300, "categories": []}]', ' has a time in frame 0 that is not within 300 years'],
       ['a.csv', 'Timecode,JawOpen\n0,nan', ', line 2: \'nan\' in column 2, \'JawOpen\', is not a number within ±1,000,000'],
       ['a.csv', 'Timecode,JawOpen\n0,1\u00A0', ', line 2: \'1\u00A0\' in column 2, \'JawOpen\', is not a number within ±1,000,000'],
       ['a.csv', 'Timecode\u00A0,JawOpen\n0,1', ', line 1: there is no column \'Timecode\''],
       ['a.csv', '\u00A0{}', ', line 1: there is no column \'Timecode\''],
       ['a.csv', 'Timecode,JawOpen\n0:0:1,1', '\'0:0:1\' is not a timecode'],
       ['a.csv', 'Timecode,JawOpen\n0:0:1:60,1', 'counts more than 60 frames a second'],
       ['a.json', '{\n', ', line 2: this is not JSON; was the file cut short?'],
       ['a.json', '{\n"frames": 1,}', ', line 2: this is not JSON'],
       ['a.json', '{\n"frames": 1.,\n"a": 1}', ', line 2: this is not JSON'],
       ['a.json', '{"frames": 1}', 'is neither of Audio2Face'],
       ['a.json', '{"asset": {}}', 'is a .gltf'],
       ['a.json', '[]', 'has no frames'],
       ['a.json', '[{"categories": []}]', 'has no \'timestampMs\' in frame 0'],
       ['a.json', '[{"timestampMs": 0}]', 'has no \'categories\' in frame 0'],
       ['a.json', '[{"timestampMs": 0, "categories": [{"score": 1}]}]', 'without \'categoryName\' and \'score\' in frame 0'],
       ['a.json', '[{"timestampMs": 0, "categories": []}]', 'has no scores in its frames'],
       ['a.json', '{"weightMat": [[1]], "facsNames": ["a"]}', 'has no \'exportFps\' greater than 0'],
       ['a.json', '{"weightMat": [[1]], "exportFps": 30, "facsNames": []}', 'has no list \'facsNames\''],
       ['a.json', '{"weightMat": [], "exportFps": 30, "facsNames": ["a"]}', 'has no frames in \'weightMat\''],
       ['a.json', '{"weightMat": [[1, 2]], "exportFps": 30, "facsNames": ["a"]}', 'has not 1 numbers in weightMat[0]'],
       ['a.json', '{"weightMat": [["x"]], "exportFps": 30, "facsNames": ["a"]}', 'is not a number within ±1,000,000 in weightMat[0]'],
       ['a.json', '{"weightMat": [[1, 2]], "exportFps": 30, "facsNames": ["a", "a"]}', 'names \'a\' twice in \'facsNames\''],
       ['a.json', '{"weightMat": [[1], [1]], "exportFps": 1e-12, "facsNames": ["a"]}', 'has too low an \'exportFps\' for its frames'],
       ['a.json', '{"weightMat": [[1]], "exportFps": 30, "facsNames": []}', 'has no list \'facsNames\' with names in it'],
       ['a.json', '[{"timestampMs": 0, "categories": [{"categoryName": "a", "score": 1e30}]}]', 'has a score in frame 0 that is not within'],
       ['a.json', '[{"timestampMs": 0, "categories": [{"categoryName": "a", "score": "x"}]}]', 'has a category without'],
       ['a.json', '{"weightMat": [[1]], "exportFps": 30, "facsNames": [5]}', 'has a value in \'facsNames\' that is not a name'],
       ['a.csv', 'Timecode,a\n12:59:60:1,0\n', 'has more than 59 minutes or seconds'],
       ['a.csv', 'Timecode,a\n12:60:59:1,0\n', 'has more than 59 minutes or seconds'],
       ['a.csv', 'Timecode,a\n-00:00:01:00,0\n', '\'-00:00:01:00\' is not a timecode'],
       ['a.csv', 'Timecode,a\nnan:0:0:0,0\n', '\'nan:0:0:0\' is not a timecode'],
       ['a.csv', 'Timecode,a\n0:0:1:0,0\n2,0\n', 'line 3: the time \'2\' is of another kind than the ones above'],
       ['a.csv', 'Timecode,a\n1e7:0:0:0,0\n', '\'1e7:0:0:0\' is not a timecode'],
       ['a.json', '[{"timestampMs": 5, "categories": []}, {"timestampMs": 5, "categories": []}]',
        'has a time in frame 1 that is not after the one before'],
       ['a.json', '[{"timestampMs": 1e300, "categories": []}]', 'has a time in frame 0'],
       ['a.json', '[{"timestampMs": 0, "categories": null, "faceBlendshapes": []}]', 'has no \'categories\' in frame 0'],
       ['a.json', '[{"timestampMs": 0, "faceBlendshapes": ""}]', 'has no \'categories\' in frame 0'],
       ['a.json', '[{"timestampMs": 0, "faceBlendshapes": {"0": {"categories": []}}}]', 'has no \'categories\' in frame 0'],
       ['a.json', '[{"timestampMs": 0, "categories": [{"categoryName": null, "category_name": "a", "score": 1}]}]',
        'has a category without'],
       ['a.json', '[{"timestampMs": null, "timestamp": 5, "categories": []}]', 'has no \'timestampMs\' in frame 0'],
       ['a.json', scattered, 'has 8200 names in 8200 frames, more than a clip can hold; name the same ones in every frame.'],
       ['t.json', '{"events": []}', 'the file has no \'seconds\''],
       ['t.json', '{"seconds": 1, "events": []}', '\'events\' must be a list of at least one event'],
       ['t.json', '{"seconds": 0, "events": []}', '\'seconds\' must be greater than 0'],
       ...[0, 1.5, 10001].map((loops) => {
         const text = `{"seconds": 1, "loops": ${loops}, "events": []}`;
         return ['t.json', text, '\'loops\' must be a whole number from 1 to 10000'];
       }),
       ['t.json', '{"seconds": "1", "events": []}', 'the file has a \'seconds\' that is not a number'],
       ['t.json', '{"seconds": 1, "loops": "2", "events": []}', 'the file has a \'loops\' that is not a number'],
       ['t.json', '{"seconds": 1, "speed": 1, "events": []}', 'the file has an unknown key \'speed\''],
       ['t.json', '{"seconds": 1, "events": [{"to": {}}]}', 'events[0] has no \'at\''],
       ['t.json', '{"seconds": 1, "events": [null]}', 'events[0] is not an object'],
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": 5}]}', 'events[0] goes neither to weights nor to a pose'],
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": {}, "ease": 1}]}', 'events[0] has an unknown key \'ease\''],
       ...[['"at": "0"', '\'at\' that is not a number'], ['"at": 0, "damping": "1"', '\'damping\' that is not a number'],
           ['"at": 0, "drive": null', '\'drive\' that is not a text'], ['"at": 0, "region": 5', '\'region\' that is not a text']]
         .map(([odd, words]) => ['t.json', `{"seconds": 1, "events": [{"to": {}, ${odd}}]}`, `events[0] has a ${words}`]),
       ['t.json', '{"seconds": 1, "events": [{"at": 2, "to": {}}]}', 'events[0] is later than \'seconds\''],
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": {}, "delay": 1.5}]}', 'so that it never plays'],
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": {}, "seconds": 1.5}]}',
        'events[0] has a \'seconds\', which the drive \'spring\' has no use for'],
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": {}, "drive": "newton", "turn": 0.5}]}', '\'turn\''],
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": {}, "drive": "cut", "damping": 1}]}', '\'damping\''],
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": {}, "restitution": 0.5}]}', '\'restitution\''],
       ['t.json', '{"seconds": 1, "events": [{"at": 0}]}', 'events[0] needs one of \'to\' and \'only\''],
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": {}, "only": {}}]}', 'events[0] needs one of \'to\' and \'only\''],
       ['t.json', '{"seconds": 1, "events": [{"at": -0.5, "to": {}}]}', 'events[0] is before 0'],
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": {}, "delay": -0.5}]}', 'events[0] has a negative \'delay\''],
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": "grin"}]}', 'goes to a pose \'grin\''],
       ['t.json', '{"seconds": 1, "poses": null, "events": [{"at": 0, "to": "grin"}]}', '\'poses\' are not an object'],
       ['t.json', '{"seconds": 1, "poses": {}, "events": [{"at": 0, "to": "__proto__"}]}', 'goes to a pose \'__proto__\''],
       ['t.json', '{"seconds": 1, "poses": {"p": 5}, "events": [{"at": 0, "to": "p"}]}', 'pose \'p\' is not an object of weights'],
       ['t.json', '{"seconds": 1, "poses": {"p": {"a": "x"}}, "events": [{"at": 0, "to": "p"}]}', 'pose \'p\' has a weight \'a\' that is not a number'],
       ['t.json', '{"seconds": 1, "poses": {"unused": {"a": "x"}}, "events": [{"at": 0, "to": {}}]}',
        'pose \'unused\' has a weight \'a\' that is not a number'],
       ...['null', '{}', '"x"'].map((regions) => {
         return ['t.json', `{"seconds": 1, "events": [{"at": 0, "to": {}}], "regions": ${regions}}`, '\'regions\' are not a list'];
       }),
       ...[['"drive": "newton", "seconds": 0', 'must last a finite time greater than 0 seconds'],
           ['"drive": "bounce", "restitution": 2', 'the restitution lies in [0, 1 - 1e-9]'],
           ['"drive": "accelerate-brake", "turn": 1', 'between 0 and 1'],
           ['"drive": "jump"', 'events[0]: There is no way to move called "jump"; there are cut, newton,'],
           ...['"drive": "newton", "seconds": 1e-160', '"drive": "bounce", "seconds": 1e-160',
               '"drive": "linear-force", "seconds": 1e-103', '"frequency": 1e154', '"damping": 1e160',
               '"drive": "accelerate-brake", "seconds": 1e-10, "turn": 1e-290']
             .map((drive) => [drive, 'events[0] cannot be: A motion needs finite numbers; its goal, time or frequency is beyond ' +
                             'what they hold.']),
           ['"damping": -1', 'a damping of at least 0'], ['"frequency": 0', 'a frequency greater than 0']]
         .map(([drive, words]) => ['t.json', `{"seconds": 1, "events": [{"at": 0, "to": {}, ${drive}}]}`, words]),
       ['t.json', '{"seconds": 1, "events": [{"at": 0, "to": {"jawOpen": "x"}}]}', 'has a weight \'jawOpen\' that is not a number within ±1,000,000']])
  test(`${file} of ${JSON.stringify(text).slice(0, 60)} is refused in the tool's words`, () => {
    const read = file === 't.json' ? readTimeline : readClip, native = refusal(file, text);
    assert.ok(native.includes(words), native);
    assert.throws(() => read(text, {name: file}), ({message}) => {
      return message.startsWith(file) && message.includes(words) && /[.?]$/.test(message);
    });
  });
