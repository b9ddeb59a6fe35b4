// Faces that gltfpack packed can be converted, and exported faces can be packed.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { inWork, realFaces, run, sampleFace, sweepface, targetNames } from './tool.mjs';

const gltfpack = fileURLToPath(new URL('node_modules/gltfpack/cli.js', import.meta.url));
const pack = (from, to, options) => run(process.execPath, gltfpack, '-i', from, '-o', to, ...options);

const few = [['-cc', '-vpn']];
const ways = [...few, ['-cc'], ['-c', '-noq'], ['-c'], ['-cc', '-noq'], ['-noq'], ['-cc', '-kn', '-ke', '-vp', '16']];

function facesOf(obj) {
  const faces = { 3: 0, 4: 0 };
  for (const line of readFileSync(obj, 'utf8').split('\n'))
    if (line.startsWith('f ')) ++faces[line.trim().split(' ').length - 1];
  return { triangles: faces[3], quads: faces[4] };
}

// Converts a packed face and describes the result.
function through(packed, tolerance, name) {
  const sweep = inWork(`${name}.sweep`), obj = inWork(`${name}.obj`);
  sweepface('convert', packed, '-o', sweep, '--tolerance', String(tolerance), '-q');
  const { shapes } = JSON.parse(sweepface('measure', sweep, packed, '--json'));
  sweepface('export', sweep, '-o', obj, '-q');
  return { ...facesOf(obj), worst: Math.max(...shapes.map((shape) => shape.distanceMax)),
           names: JSON.parse(sweepface('info', sweep, '--json')).targets };
}

for (const options of process.env.SWEEPFACE_LONG ? ways : few)
  test(`a face packed with ${options.join(' ')} comes back`, async () => {
    const { sweep, neutral, tolerance } = sampleFace();
    const file = inWork('face.glb'), packed = inWork('packed.glb');
    sweepface('export', sweep, '-o', file, '-q');
    pack(file, packed, options);
    const result = through(packed, tolerance, 'again');
    assert.ok(result.worst <= tolerance);
    assert.deepEqual(result.names, targetNames(file));
    // No triangle is lost; in gltfpack's order some of them pair into different quads, or into none.
    assert.equal(2 * result.quads + result.triangles, 2 * facesOf(neutral).quads);
    assert.ok(result.quads >= 0.99 * facesOf(neutral).quads);
    const bytes = readFileSync(packed);
    const gltf = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(
        bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
    gltf.scene.traverse((o) => {
      if (o.isMesh) assert.deepEqual(Object.keys(o.morphTargetDictionary), result.names);
    });
  });

test('a face packed with -cz is refused with advice', () => {
  const file = inWork('face.glb'), packed = inWork('packed.glb');
  sweepface('export', sampleFace().sweep, '-o', file, '-q');
  pack(file, packed, ['-cz']);
  assert.throws(() => sweepface('convert', packed, '-o', inWork('none.sweep')), /version 1 of meshopt/);
});

const real = { head: { quads: 11140, triangles: 8, ways }, full_sparse: { quads: 25400, triangles: 548, ways: [['-cc'], ['-noq']] } };
const skip = !process.env.SWEEPFACE_LONG ? 'runs in the long tests' : !realFaces && 'SWEEPFACE_DATA is not set';
for (const [glb, expected] of Object.entries(real))
  for (const options of expected.ways)
    test(`the real ${glb}.glb packed with ${options.join(' ')} holds the tolerance`, { skip }, (t) => {
      const packed = inWork('packed.glb'), tolerance = 0.05;
      const source = path.join(realFaces, 'ictface', 'glb', `${glb}.glb`);
      pack(source, packed, options);
      const result = through(packed, tolerance, glb);
      t.diagnostic(`${result.quads} quads, ${result.triangles} triangles, at most ${result.worst} away`);
      assert.ok(result.worst <= tolerance);
      assert.ok(result.quads >= expected.quads && result.triangles <= expected.triangles);
      assert.deepEqual(result.names, targetNames(source));
    });
