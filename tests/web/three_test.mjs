// three.js loads the files, finds every target by its name, and plays them on the laws of motion.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { inWork, objPositions, sampleFace, sweepface, targetNames } from './tool.mjs';

async function load(file) {
  const bytes = readFileSync(file);
  return new GLTFLoader().parseAsync(
      bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
}

const morphing = (gltf) => {
  const meshes = [];
  gltf.scene.traverse((o) => { if (o.morphTargetInfluences) meshes.push(o); });
  return meshes;
};

function write(name, command, ...options) {
  const file = inWork(name);
  sweepface(command, sampleFace().sweep, '-o', file, '-q', ...options);
  return file;
}

const weight = (mesh, target) => mesh.morphTargetInfluences[mesh.morphTargetDictionary[target]];

test('every target is found by its name', async () => {
  const file = write('face.glb', 'export');
  const names = targetNames(file);
  assert.ok(names.length >= 8);
  const meshes = morphing(await load(file));
  assert.ok(meshes.length >= 1);
  for (const mesh of meshes) assert.deepEqual(Object.keys(mesh.morphTargetDictionary), names);
});

// Where three.js puts the vertices of a mesh, once each.
function places(meshes) {
  const seen = new Set();
  const point = new THREE.Vector3();
  for (const mesh of meshes) {
    mesh.updateWorldMatrix(true, false);
    for (let v = 0; v < mesh.geometry.attributes.position.count; ++v) {
      mesh.getVertexPosition(v, point).applyMatrix4(mesh.matrixWorld);
      seen.add([point.x, point.y, point.z].map((c) => Math.round(c * 1e4)).join(' '));
    }
  }
  return seen;
}

function near(seen, x, y, z) {
  const [i, j, k] = [x, y, z].map((c) => Math.round(c * 1e4));
  for (let a = -1; a <= 1; ++a)
    for (let b = -1; b <= 1; ++b)
      for (let c = -1; c <= 1; ++c)
        if (seen.has(`${i + a} ${j + b} ${k + c}`)) return true;
  return false;
}

for (const options of [[], ['--lod', '2'], ['--quantize'], ['--lod', '2', '--quantize']])
  test(`vertices stand where the OBJ export has them ${options.join(' ')}`, async () => {
    const names = targetNames(write('face.glb', 'export'));
    const meshes = morphing(await load(write('face.glb', 'export', ...options)));
    const lod = options[0] === '--lod' ? options.slice(0, 2) : [];
    for (const name of [null, ...names]) {
      for (const mesh of meshes) {
        mesh.morphTargetInfluences.fill(0);
        if (name) mesh.morphTargetInfluences[mesh.morphTargetDictionary[name]] = 1;
      }
      const obj = write('face.obj', 'export', ...lod, ...(name ? ['--weights', `${name}=1`] : []));
      const expected = objPositions(obj);
      const seen = places(meshes);
      if (options.includes('--quantize')) continue;
      let missing = 0;
      for (let k = 0; k < expected.length; k += 3) missing += !near(seen, ...expected.slice(k, k + 3));
      assert.equal(missing, 0, `${name ?? 'neutral'}: ${missing} of ${expected.length / 3} vertices`);
    }
  });

const laws = {
  linear: (t) => t,
  newton: (t) => t * t,
  brake: (t) => 2 * t - t * t,
  'accelerate-brake': (t) => (t < 0.5 ? 2 * t * t : 1 - 2 * (1 - t) * (1 - t)),
};

for (const [law, shape] of Object.entries(laws))
  for (const seconds of [1, 0.3, 4])
    test(`${law} over ${seconds} s is followed at every time`, async () => {
      const gltf = await load(write('move.glb', 'animate', '--from', 'browInnerUp=0.25',
                                    '--to', 'jawOpen=0.8,mouthSmileLeft=1', '--law', law,
                                    '--seconds', String(seconds)));
      const meshes = morphing(gltf);
      const mixer = new THREE.AnimationMixer(gltf.scene);
      const action = mixer.clipAction(gltf.animations[0]);
      action.setLoop(THREE.LoopOnce);
      action.clampWhenFinished = true;
      action.play();
      assert.ok(Math.abs(gltf.animations[0].duration - seconds) < 1e-6);
      for (let k = 0; k <= 97; ++k) {
        const t = k / 97;
        mixer.setTime(t * seconds);
        for (const mesh of meshes) {
          assert.ok(Math.abs(weight(mesh, 'jawOpen') - 0.8 * shape(t)) < 2e-7, `at ${t}`);
          assert.ok(Math.abs(weight(mesh, 'mouthSmileLeft') - shape(t)) < 2e-7, `at ${t}`);
          assert.ok(Math.abs(weight(mesh, 'browInnerUp') - 0.25 * (1 - shape(t))) < 2e-7, `at ${t}`);
        }
      }
    });

test('sampled keys meet the law where they stand', async () => {
  const gltf = await load(write('move.glb', 'animate', '--to', 'jawOpen=1', '--law', 'newton',
                                '--keys', 'sampled', '--frames', '11'));
  const mixer = new THREE.AnimationMixer(gltf.scene);
  const action = mixer.clipAction(gltf.animations[0]);
  action.setLoop(THREE.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  for (let k = 0; k <= 10; ++k) {
    mixer.setTime(k / 10);
    for (const mesh of morphing(gltf)) assert.ok(Math.abs(weight(mesh, 'jawOpen') - (k / 10) ** 2) < 1e-6);
  }
});
