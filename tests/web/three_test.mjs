// three.js loads the files, finds every target by its name, and plays them on the laws of motion.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { capture, recorded } from './capture.mjs';
import { inWork, objPositions, realFaces, sampleFace, sweepface, targetNames } from './tool.mjs';

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

// Where three.js puts the vertices of the meshes, rounded to cells of size `cell`.
function places(meshes, cell) {
  const seen = new Set();
  const point = new THREE.Vector3();
  for (const mesh of meshes) {
    mesh.updateWorldMatrix(true, false);
    for (let v = 0; v < mesh.geometry.attributes.position.count; ++v) {
      mesh.getVertexPosition(v, point).applyMatrix4(mesh.matrixWorld);
      seen.add([point.x, point.y, point.z].map((c) => Math.round(c / cell)).join(' '));
    }
  }
  return seen;
}

function isNear(seen, cell, point) {
  const [x, y, z] = point.map((c) => Math.round(c / cell));
  for (const a of [0, -1, 1])
    for (const b of [0, -1, 1])
      for (const c of [0, -1, 1])
        if (seen.has(`${x + a} ${y + b} ${z + c}`)) return true;
  return false;
}

// The face is 28.2 cm high: floats are accurate to 1e-5 cm, 16 bits to half of 28.2 / 65535, and as
// much again for a target.
for (const [name, cell, options] of [['', 1e-5, []], [', refined', 1e-5, ['--lod', '2']],
                                     [', quantized', 4.4e-4, ['--quantize']],
                                     [', refined and quantized', 4.4e-4, ['--lod', '2', '--quantize']]])
  test(`vertices stand where the OBJ export has them${name}`, async () => {
    const file = write('face.glb', 'export', ...options);
    const meshes = morphing(await load(file));
    const lod = options[0] === '--lod' ? options.slice(0, 2) : [];
    const step = process.env.SWEEPFACE_LONG ? 1 : options.length > 0 ? 6 : 2;  // a few targets show what a format does
    for (const target of [null, ...targetNames(file).filter((_, k) => k % step === 0)]) {
      for (const mesh of meshes) {
        mesh.morphTargetInfluences.fill(0);
        if (target) mesh.morphTargetInfluences[mesh.morphTargetDictionary[target]] = 1;
      }
      const expected = objPositions(write('face.obj', 'export', ...lod, ...(target ? ['--weights', `${target}=1`] : [])));
      const seen = places(meshes, cell);
      let missing = 0;
      for (let k = 0; k < expected.length; k += 3) missing += !isNear(seen, cell, expected.slice(k, k + 3));
      assert.equal(missing, 0, `${target ?? 'neutral'}: ${missing} of ${expected.length / 3} vertices`);
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

/** Plays the first animation of a file; passes `use` the glTF and a function that goes to a time. */
async function playing(file, use) {
  const gltf = await load(file), mixer = new THREE.AnimationMixer(gltf.scene);
  const action = mixer.clipAction(gltf.animations[0]);
  action.setLoop(THREE.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  return use(gltf, (seconds) => mixer.setTime(seconds));
}

test('a capture of a minute is played by name, eyes and head too', async () => {
  const file = write('take.glb', 'animate', '--clip', capture('take.csv'), '--eyes', 'on', '--head', 'on');
  await playing(file, (gltf, goTo) => {
    assert.ok(Math.abs(gltf.animations[0].duration - 3599 / 60) < 1e-4);
    const head = gltf.scene.getObjectByName('head');
    for (let k = 0; k <= 100; ++k) {
      const t = k / 100 * 59.9;
      goTo(t);
      for (const mesh of morphing(gltf)) {
        for (const [target, column] of [['jawOpen', 'JawOpen'], ['mouthSmileLeft', 'MouthSmileLeft'],
                                        ['eyeBlinkRight', 'EyeBlinkRight'], ['browInnerUp', 'BrowInnerUp']])
          assert.ok(Math.abs(weight(mesh, target) - recorded(column, t)) < 0.004, `${target} at ${t}`);
        // sin θ · a of the rotation that looks where the angles do, which are left-handed
        const yaw = -recorded('LeftEyeYaw', t), pitch = recorded('LeftEyePitch', t);
        const aside = weight(mesh, 'eyeLeft.left') - weight(mesh, 'eyeLeft.right');
        assert.ok(Math.abs(aside - Math.sin(yaw) * Math.cos(pitch)) < 0.006, `the left eye at ${t}`);
      }
      const expected = new THREE.Quaternion().setFromEuler(new THREE.Euler(
          recorded('HeadPitch', t), -recorded('HeadYaw', t), -recorded('HeadRoll', t), 'YXZ'));
      assert.ok(head.quaternion.angleTo(expected) < 0.003, `the head at ${t}`);
    }
  });
});

test('regions are parts of targets that lag behind', async () => {
  const regions = inWork('regions.json');
  writeFileSync(regions, JSON.stringify({regions: [{name: 'chin', points: [[0, -9, 9]], over: 'space', whole: 2, fade: 5, mass: 4}]}));
  const file = write('regions.glb', 'animate', '--to', 'jawOpen=1', '--law', 'newton', '--regions', regions);
  await playing(file, (gltf, goTo) => {
    assert.ok(Math.abs(gltf.animations[0].duration - 2) < 1e-6);  // twice as long for four times the mass
    for (let k = 0; k <= 40; ++k) {
      const t = k / 20, rest = Math.min(t, 1) ** 2, chin = (t / 2) ** 2;
      goTo(t);
      for (const mesh of morphing(gltf)) {
        // The whole goes as far as the slower one, and the rest is ahead.
        assert.ok(Math.abs(weight(mesh, 'jawOpen') - chin) < 0.003, `at ${t}`);
        assert.ok(Math.abs(weight(mesh, 'jawOpen@rest') - (rest - chin)) < 0.005, `at ${t}`);
        assert.ok(Math.abs(weight(mesh, 'jawOpen@chin')) < 0.003, `at ${t}`);
      }
    }
  });
});

const skip = !process.env.SWEEPFACE_LONG ? 'runs in the long tests' : !realFaces && 'SWEEPFACE_DATA is not set';
test('a real head has all its targets and moves by them', { skip }, async () => {
  const sweep = inWork('head.sweep'), file = inWork('head.glb');
  sweepface('convert', path.join(realFaces, 'ictface', 'glb', 'head.glb'), '-o', sweep, '--tolerance', '0.05', '-q');
  sweepface('animate', sweep, '--to', 'jawOpen=1', '--law', 'newton', '-o', file, '-q');
  const gltf = await load(file), [mesh] = morphing(gltf);
  assert.equal(Object.keys(mesh.morphTargetDictionary).length, 57);
  assert.equal(mesh.geometry.attributes.position.count, 11248);
  const mixer = new THREE.AnimationMixer(gltf.scene);
  mixer.clipAction(gltf.animations[0]).play();
  mixer.setTime(0.7);
  assert.ok(Math.abs(weight(mesh, 'jawOpen') - 0.49) < 2e-7);
  const seen = places([mesh], 1e-5), obj = inWork('head.obj');
  sweepface('export', sweep, '-o', obj, '--weights', 'jawOpen=0.49', '-q');
  const expected = objPositions(obj);
  for (let k = 0; k < expected.length; k += 3) assert.ok(isNear(seen, 1e-5, expected.slice(k, k + 3)), `vertex ${k / 3}`);
});
