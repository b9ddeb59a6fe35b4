// Khronos' own validator finds no fault with the files.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import validator from 'gltf-validator';
import { capture } from './capture.mjs';
import { inWork, realFaces, sampleFace, sweepface } from './tool.mjs';

async function assertValid(file) {
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(file)));
  assert.deepEqual({ errors: issues.numErrors, warnings: issues.numWarnings }, { errors: 0, warnings: 0 },
                   JSON.stringify(issues.messages.slice(0, 5), null, 1));
}

const moving = ['--to', 'jawOpen=0.8,mouthSmileLeft=1'];
const ways = {
  'as the source has it': ['export'],
  'at an expression': ['export', '--weights', 'jawOpen=0.5,eyeBlinkLeft=1'],
  'refined': ['export', '--lod', '2'],
  'with morph normals': ['export', '--morph-normals'],
  'quantized': ['export', '--quantize'],
  'with few vertices': ['export', '--vertices', '3000', '--morph-normals', '--quantize'],
  'refined, with morph normals, quantized': ['export', '--lod', '3', '--morph-normals', '--quantize'],
  'moving by Newton\'s law': ['animate', ...moving, '--law', 'newton'],
  'braking': ['animate', ...moving, '--law', 'brake'],
  'from rest to rest': ['animate', ...moving, '--law', 'accelerate-brake'],
  'at constant speed': ['animate', ...moving, '--law', 'linear'],
  'moving by sampled keys': ['animate', ...moving, '--keys', 'sampled', '--frames', '12'],
  'moving between expressions, refined, quantized':
    ['animate', '--from', 'browInnerUp=1', ...moving, '--seconds', '2.5', '--lod', '2', '--quantize'],
};

const regions = inWork('regions.json');
writeFileSync(regions, JSON.stringify({regions: [{name: 'chin', points: [[0, -9, 9]], fade: 7, mass: 3}]}));
Object.assign(ways, {
  'moving by a spring in few keys': ['animate', ...moving, '--law', 'spring'],
  'moving by regions, on arcs': ['animate', ...moving, '--law', 'spring', '--regions', regions, '--arcs', 'on'],
  'playing a capture with eyes and head':
    ['animate', '--clip', capture('take.csv', 3), '--eyes', 'on', '--head', 'on', '--quantize'],
});

for (const [name, [command, ...options]] of Object.entries(ways))
  test(`the sample face ${name} is valid`, async () => {
    const file = inWork('face.glb');
    sweepface(command, sampleFace().sweep, '-o', file, '-q', ...options);
    await assertValid(file);
  });

const long = process.env.SWEEPFACE_LONG;
for (const glb of ['head', 'full_sparse'])
  test(`the real ${glb}.glb is valid after the way through a .sweep file`,
       { skip: !long ? 'runs in the long tests' : !realFaces && 'SWEEPFACE_DATA is not set' }, async () => {
    const sweep = inWork(`${glb}.sweep`), file = inWork(`${glb}.glb`);
    sweepface('convert', path.join(realFaces, 'ictface', 'glb', `${glb}.glb`), '-o', sweep,
              '--tolerance', '0.05', '-q');
    for (const options of [[], ['--quantize', '--morph-normals'], ['--lod', '2'], ['--error', '0.02']]) {
      sweepface('export', sweep, '-o', file, '-q', ...options);
      await assertValid(file);
    }
  });
