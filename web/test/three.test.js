import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {difference, played, sample} from './native.js';

const three = await import('three').catch(() => undefined);
const options = {skip: three ? false : 'three is not installed; try npm ci'};

async function load() {
  const {SweepfaceLoader} = await import('../sweepface_three.js');
  return new SweepfaceLoader().parseAsync(readFileSync(sample));
}

test('a mesh follows its weights when it is updated', options, async () => {
  const mesh = await load(), {position, normal} = mesh.geometry.attributes;
  const neutral = position.array.slice(), {version} = position;
  mesh.setWeights({jawOpen: 0.7});
  assert.deepEqual(position.array, neutral);
  mesh.update();
  assert.ok(position.version > version);
  assert.ok(normal.version > 0);
  const native = played(sample, mesh.face.weights, 0);
  assert.ok(difference(native.positions, position.array).most <= native.error);
});

test('an update costs nothing where nothing moves', options, async () => {
  const mesh = await load(), {position} = mesh.geometry.attributes;
  const {version} = position;
  mesh.update(1 / 60);
  assert.equal(position.version, version);
  mesh.moveTo({jawOpen: 1}, {kind: 'linear-force', seconds: 0.1});
  for (let k = 0; k < 20; ++k) mesh.update(1 / 60);
  const after = position.version;
  assert.ok(after > version);
  assert.equal(mesh.face.weights.jawOpen, 1);
  mesh.update(1 / 60);
  assert.equal(position.version, after);
});

test('materials are plain, one a part, named as in the source', options, async () => {
  const mesh = await load();
  assert.deepEqual(mesh.material.map(({name}) => name), mesh.face.parts.map(({material}) => material));
  assert.ok(mesh.material.every((material) => material instanceof three.MeshStandardMaterial));
  assert.deepEqual(mesh.geometry.groups,
                   mesh.face.parts.map(({start, count}, materialIndex) => ({start, count, materialIndex})));
});

test('the geometry has texture coordinates and knows its size', options, async () => {
  const mesh = await load();
  assert.equal(mesh.geometry.attributes.uv.count, mesh.face.vertexCount);
  assert.ok(mesh.geometry.boundingSphere.radius > 10);
  const rays = new three.Raycaster(new three.Vector3(0, 0, 100), new three.Vector3(0, 0, -1));
  assert.ok(rays.intersectObject(mesh).length > 0);
});

test('normals are of unit length and point outwards', options, async () => {
  const mesh = await load(), {position, normal} = mesh.geometry.attributes;
  const centre = mesh.geometry.boundingSphere.center, p = new three.Vector3(), n = new three.Vector3();
  let outward = 0;
  for (let v = 0; v < position.count; ++v) {
    n.fromBufferAttribute(normal, v);
    assert.ok(Math.abs(n.length() - 1) < 1e-5);
    outward += n.dot(p.fromBufferAttribute(position, v).sub(centre)) > 0;
  }
  assert.ok(outward > 0.9 * position.count);
});

test('a disposed mesh gives its face back', options, async () => {
  const mesh = await load();
  mesh.dispose();
  assert.throws(() => mesh.face.names, {message: 'The face was disposed of.'});
});

test('clips and timelines play on a mesh as well', options, async () => {
  const {ClipPlayer, readClip, readTimeline, TimelinePlayer} = await import('../sweepface_clips.js');
  const mesh = await load(), {position} = mesh.geometry.attributes;
  const player = new ClipPlayer(mesh, readClip('Timecode,JawOpen\n0,0\n1,1'));
  player.seek(0.5);
  mesh.update();
  assert.equal(mesh.face.weights.jawOpen, 0.5);
  const {version} = position;
  const events = [{at: 0.1, to: {jawOpen: 0}, drive: 'cut'}];
  const scene = new TimelinePlayer(mesh, readTimeline(JSON.stringify({seconds: 1, events})));
  assert.equal(scene.advance(0.2), true);
  mesh.update();
  assert.equal(mesh.face.weights.jawOpen, 0);
  assert.ok(position.version > version);
});
