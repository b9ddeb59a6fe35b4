import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import test from 'node:test';
import {ClipPlayer, readClip} from '../sweepface_clips.js';
import {Sweepface} from '../sweepface.js';
import {difference, exported, sample, tool} from './native.js';

const load = (options) => Sweepface.load(readFileSync(sample), options);
function positionsOf(face) {
  const positions = new Float32Array(3 * face.vertexCount);
  face.evaluate(positions);
  return positions;
}

test('eyes turn by their weights as the tool turns them', async () => {
  const face = await load({eyes: true}), plain = await load(), weights = {eyeLookInLeft: 0.7, eyeLookDownRight: 1, jawOpen: 0.5};
  assert.equal(face.eyeCount, 2);
  assert.deepEqual(face.names, plain.names);
  face.setWeights(weights);
  plain.setWeights(weights);
  assert.ok(difference(exported(sample, weights, 0, ['--eyes', 'on']).positions, positionsOf(face)).most <= 2 * face.tolerance);
  assert.ok(difference(positionsOf(plain), positionsOf(face)).most > 0.02);
});

test('eyes turn by the angles of a capture as the tool turns them', async () => {
  const csv = 'Timecode,JawOpen,LeftEyeYaw,LeftEyePitch,RightEyeYaw,HeadYaw\n0,0,0.3,0.2,-0.3,0.5\n1,1,-0.3,0.1,0.3,0.1\n';
  const folder = mkdtempSync(join(tmpdir(), 'sweepface-'));
  try {
    writeFileSync(join(folder, 'take.csv'), csv);
    execFileSync(tool, ['animate', sample, '--clip', join(folder, 'take.csv'), '--eyes', 'on', '--fps', '4', '-o', join(folder, 'frames'), '--quiet'], {stdio: 'pipe'});
    const face = await load({eyes: true}), player = new ClipPlayer(face, readClip(csv));
    for (const k of [0, 1, 2, 3]) {
      assert.equal(player.seek(k / 4).yaw, 0.5 - 0.1 * k);
      const exact = readFileSync(join(folder, 'frames', `frame_000${k}.obj`), 'utf8').split('\n').filter((line) => line.startsWith('v ')).flatMap((line) => line.split(' ').slice(1).map(Number));
      assert.ok(difference(exact, positionsOf(face)).most <= 2 * face.tolerance, `frame ${k}`);
    }
    face.look(null);
    face.setWeights({jawOpen: 0});
    assert.ok(difference(positionsOf(await load()), positionsOf(face)).most <= 1e-3);
  } finally {
    rmSync(folder, {recursive: true});
  }
});

test('eyes that do not turn cannot look', async () => {
  const face = await load(), eyes = await load({eyes: true});
  assert.equal(face.eyeCount, 0);
  assert.throws(() => face.look(null), /no eyes that turn/);
  assert.throws(() => eyes.look({leftEye: {yaw: NaN}}), /finite numbers/);
});
