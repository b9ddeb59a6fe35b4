import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {ClipPlayer, readClip, readTimeline, TimelinePlayer} from '../sweepface_clips.js';
import {Sweepface} from '../sweepface.js';
import {difference, exported, newFolder, positionsOf, readObj, sample, tool} from './native.js';

const load = (options) => Sweepface.load(readFileSync(sample), options);

test('eyes turn by their weights as the tool turns them', async () => {
  const face = await load({eyes: true}), plain = await load();
  const weights = {eyeLookInLeft: 0.7, eyeLookDownRight: 1, jawOpen: 0.5};
  assert.equal(face.eyeCount, 2);
  assert.deepEqual(face.names, plain.names);
  face.setWeights(weights);
  plain.setWeights(weights);
  const exact = exported(sample, weights, 0, ['--eyes', 'on']).positions;
  assert.ok(difference(exact, positionsOf(face)).most <= 2 * face.tolerance);
  assert.ok(difference(positionsOf(plain), positionsOf(face)).most > 0.02);
});

test('eyes turn by the angles of a capture as the tool turns them', async () => {
  const csv = 'Timecode,JawOpen,LeftEyeYaw,LeftEyePitch,RightEyeYaw,HeadYaw\n' +
              '0,0,0.3,0.2,-0.3,0.5\n1,1,-0.3,0.1,0.3,0.1\n';
  const folder = newFolder(), clip = join(folder, 'take.csv');
  writeFileSync(clip, csv);
  execFileSync(tool, ['animate', sample, '--clip', clip, '--eyes', 'on', '--fps', '4', '-o', folder, '--quiet'],
               {stdio: 'pipe'});
  const face = await load({eyes: true}), player = new ClipPlayer(face, readClip(csv));
  for (const k of [0, 1, 2, 3]) {
    assert.equal(player.seek(k / 4).yaw, -(0.5 - 0.1 * k));  // the app is left-handed
    const exact = readObj(join(folder, `frame_000${k}.obj`)).positions;
    assert.ok(difference(exact, positionsOf(face)).most <= 2 * face.tolerance, `frame ${k}`);
  }
  face.look(null);
  face.setWeights({jawOpen: 0});
  assert.ok(difference(positionsOf(await load()), positionsOf(face)).most <= 1e-3);
});

test('eyes turn by their weights where a recording has no angles of theirs but 0', async () => {
  const folder = newFolder(), recorded = join(folder, 'down.csv'), weights = {eyeLookDownLeft: 1, eyeLookDownRight: 1};
  const animate = (...options) => execFileSync(tool, ['animate', sample, '--quiet', ...options], {stdio: 'pipe'});
  animate('--from', 'eyeLookDownLeft=1,eyeLookDownRight=1', '--to', 'eyeLookDownLeft=1,eyeLookDownRight=1',
          '-o', recorded);
  animate('--clip', recorded, '--eyes', 'on', '--frames', '2', '-o', folder);
  const exact = exported(sample, weights, 0, ['--eyes', 'on']).positions;
  assert.ok(difference(exact, readObj(join(folder, 'frame_0000.obj')).positions).most <= 1e-6);
  const face = await load({eyes: true});
  new ClipPlayer(face, readClip(readFileSync(recorded))).seek(0);
  assert.ok(difference(exact, positionsOf(face)).most <= 2 * face.tolerance);
});

test('a roll, which no eye uses, leaves eyes to their weights', async () => {
  const face = await load({eyes: true}), looking = await load({eyes: true});
  looking.setWeights({eyeLookDownLeft: 1});
  new ClipPlayer(face, readClip('Timecode,EyeLookDownLeft,LeftEyeYaw,LeftEyeRoll\n0,1,0,0\n1,1,0,0.5\n')).seek(1);
  assert.equal(difference(positionsOf(looking), positionsOf(face)).most, 0);
});

test('a clip moves the eyes by its weights after another whose angles did', async () => {
  const face = await load({eyes: true}), other = await load({eyes: true});
  const angles = readClip('Timecode,LeftEyeYaw\n0,0.4\n'), weights = readClip('Timecode,EyeLookDownLeft\n0,1\n');
  new ClipPlayer(face, angles).seek(0);
  const turned = positionsOf(face);
  new ClipPlayer(face, readClip('Timecode,JawOpen\n0,0\n')).seek(0);
  assert.equal(difference(turned, positionsOf(face)).most, 0, 'no word of the eyes');
  for (const it of [face, other]) new ClipPlayer(it, weights).seek(0);
  assert.equal(difference(positionsOf(other), positionsOf(face)).most, 0);
});

test('an eye without angles looks ahead where the other has some', () => {
  const looks = [], face = {names: [], eyeCount: 2, setWeights() {}, look: (pose) => looks.push(pose)};
  new ClipPlayer(face, readClip('Timecode,LeftEyeYaw\n0,-0.5\n')).seek(0);
  assert.deepEqual(looks, [{leftEye: {yaw: 0.5, pitch: 0, roll: 0}, rightEye: {}}]);
});

test('names of weights for the eyes may be spelt in any way', () => {
  const looks = [], face = {names: ['eye_look_down'], eyeCount: 2, setWeights() {}, look: (pose) => looks.push(pose)};
  new ClipPlayer(face, readClip('Timecode,eyeLookDown\n0,1\n')).seek(0);
  assert.deepEqual(looks, [null]);
});

test('a timeline moves the eyes by its weights after a clip whose angles did', async () => {
  const face = await load({eyes: true}), other = await load({eyes: true});
  const playing = (goal) =>
    readTimeline(JSON.stringify({seconds: 1, events: [{at: 0, to: {[goal]: 1}, drive: 'cut'}]}));
  new ClipPlayer(face, readClip('Timecode,LeftEyeYaw\n0,0.4\n')).seek(0);
  const turned = positionsOf(face);
  new TimelinePlayer(face, playing('eyeBlinkLeft')).advance(0);
  face.setWeights({eyeBlinkLeft: 0});
  assert.equal(difference(turned, positionsOf(face)).most, 0, 'no word of the eyes');
  for (const it of [face, other]) new TimelinePlayer(it, playing('eyeLookDownLeft')).advance(0);
  assert.equal(difference(positionsOf(other), positionsOf(face)).most, 0);
});

test('eyes that do not turn cannot look', async () => {
  const face = await load(), eyes = await load({eyes: true});
  assert.equal(face.eyeCount, 0);
  assert.throws(() => face.look(null), /no eyes that turn/);
  new ClipPlayer(face, readClip('Timecode,LeftEyeYaw,EyeLookDownLeft\n0,0.4,1\n')).seek(0);
  const down = {seconds: 1, events: [{at: 0, to: {eyeLookDownLeft: 0.5}, drive: 'cut'}]};
  new TimelinePlayer(face, readTimeline(JSON.stringify(down))).advance(0);
  assert.equal(face.weights.eyeLookDownLeft, 0.5);
  for (const angle of [NaN, '0.1', null])
    for (const eye of [{yaw: angle}, {pitch: angle}, {roll: angle}])
      assert.throws(() => eyes.look({leftEye: eye}), {name: 'TypeError', message: /leftEye takes finite numbers, not /});
  assert.throws(() => eyes.look({left: {yaw: 1}}), /look has no option 'left'; it has leftEye, rightEye/);
  assert.throws(() => eyes.look({leftEye: {up: 1}}), /look's leftEye has no option 'up'/);
  for (const no of [5, true, [], 'left', {leftEye: 5}, {leftEye: []}])
    assert.throws(() => eyes.look(no), {name: 'TypeError', message: /takes an object of/});
  assert.equal(eyes.pose, null);
  eyes.look({leftEye: null, rightEye: undefined});
  eyes.pose.leftEye.yaw = 1;  // a copy, which is the caller's
  assert.deepEqual(eyes.pose, {leftEye: {}, rightEye: {}});
  eyes.look(null);
  assert.equal(eyes.pose, null);
});
