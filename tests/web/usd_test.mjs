// OpenUSD's own library and TinyUSDZ read the files, and find in them what OBJ files of the same face have.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { capture } from './capture.mjs';
import { Glb } from './glb.mjs';
import { inWork, objPositions, realFaces, sampleFace, sweepface } from './tool.mjs';
import { readUsd } from './usd.mjs';

/** The mesh's points under weights by name, [3 V]: what a blend shape of UsdSkel adds to them. */
function points(prims, weights) {
  const mesh = prims['/face/mesh'].values, sum = mesh['point3f[] points'].flat();
  const shapes = mesh['uniform token[] skel:blendShapes'];
  const paths = mesh['rel skel:blendShapeTargets'];
  for (const [name, weight] of Object.entries(weights)) {
    const { values } = prims[paths[shapes.indexOf(name)]];
    values['uniform int[] pointIndices'].forEach((v, k) => {
      for (let c = 0; c < 3; ++c) sum[3 * v + c] += weight * values['uniform vector3f[] offsets'][k][c];
    });
  }
  return sum;
}

/** The weights by name at a time code. */
function weightsAt(prims, time) {
  const animation = prims['/face/skeleton/animation'].values;
  const [, sample] = animation['float[] blendShapeWeights.timeSamples'].find(([at]) => at === time);
  return Object.fromEntries(animation['uniform token[] blendShapes'].map((name, k) => [name, sample[k]]));
}

/** Points turned by the joint as it stands at a time code, about where it is bound. */
function turned(prims, time, list) {
  const { values } = prims['/face/skeleton/animation'];
  const [, [[w, x, y, z]]] = values['quatf[] rotations.timeSamples'].find(([at]) => at === time);
  const [bound] = prims['/face/skeleton'].values['uniform matrix4d[] bindTransforms'];
  const [place] = values['float3[] translations'];
  const rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]];
  return list.map((_, k) => {
    const v = k - k % 3;
    return rows[k % 3].reduce((sum, m, c) => sum + m * (list[v + c] - bound[3][c]), place[k % 3]);
  });
}

function assertNear(a, b, tolerance) {
  assert.equal(a.length, b.length);
  const most = a.reduce((most, value, k) => Math.max(most, Math.abs(value - b[k])), 0);
  assert.ok(most <= tolerance, `off by ${most}`);
}

function assertRead({ own, theirs, complaints }) {
  assert.deepEqual(theirs, own);
  assert.equal(complaints, '');
}

const picture = fileURLToPath(new URL('../../docs/pictures/sample-jawOpen.png', import.meta.url));
const pose = 'jawOpen=0.6,mouthSmileLeft=1';

test('the face with its targets', async () => {
  const { sweep } = sampleFace();
  sweepface('export', sweep, '-o', inWork('face.usda'), '-q', '--weights', pose);
  sweepface('export', sweep, '-o', inWork('fine.usda'), '-q', '--lod', '2', '--morph-normals');
  sweepface('export', sweep, '-o', inWork('pose.obj'), '-q', '--weights', pose);
  sweepface('export', sweep, '-o', inWork('fine.obj'), '-q', '--weights', pose, '--lod', '2');
  const [face, fine] = await readUsd('face.usda', 'fine.usda');
  for (const [read, obj] of [[face, 'pose.obj'], [fine, 'fine.obj']]) {
    assertRead(read);
    assertNear(read.points, read.theirs['/face/mesh'].values['point3f[] points'].flat().map(Math.fround), 0);
    assertNear(points(read.theirs, { jawOpen: 0.6, mouthSmileLeft: 1 }), objPositions(inWork(obj)), 2e-5);
    const corners = readFileSync(inWork(obj), 'utf8').match(/^f .*$/mg).map((face) => face.split(' ').length - 1);
    assert.deepEqual(read.theirs['/face/mesh'].values['int[] faceVertexCounts'], corners);
    assert.equal(read.triangles.length, 3 * corners.reduce((sum, n) => sum + n - 2, 0));
    assert.equal(read.normals.length, read.points.length);
  }
  const shown = face.theirs['/face/skeleton/animation'].values;
  assert.equal(shown['float[] blendShapeWeights'][shown['uniform token[] blendShapes'].indexOf('jawOpen')], 0.6);
});

test('a motion by a law', async () => {
  const { sweep } = sampleFace(), moving = ['--to', pose, '--law', 'accelerate-brake', '--seconds', '0.5', '--fps', '24'];
  sweepface('animate', sweep, ...moving, '-o', inWork('law.usda'), '-q');
  sweepface('animate', sweep, ...moving, '-o', inWork('law'), '-q');
  const [law] = await readUsd('law.usda');
  assertRead(law);
  assert.match(law.theirs[''].metadata, /^endTimeCode = 12$.*^startTimeCode = 0$.*^timeCodesPerSecond = 24$/ms);
  for (const frame of [0, 5, 12])
    assertNear(points(law.theirs, weightsAt(law.theirs, frame)), objPositions(frameOf('law', frame)), 2e-5);
});

test('a capture with eyes, arcs, regions and the head', async () => {
  const regions = inWork('regions.json');
  writeFileSync(regions, JSON.stringify({ regions: [{ name: 'chin', points: [[0, -9, 9]], fade: 7, mass: 3 }] }));
  const options = ['--clip', capture('take.csv', 1), '--eyes', 'on', '--arcs', 'on', '--head', 'on', '--regions', regions,
                   '--fps', '10'];
  sweepface('animate', sampleFace().sweep, ...options, '-o', inWork('take.usda'), '-q');
  sweepface('animate', sampleFace().sweep, ...options, '-o', inWork('take'), '-q');
  const [take] = await readUsd('take.usda');
  assertRead(take);
  for (const frame of [0, 4, 9]) {
    const still = points(take.theirs, weightsAt(take.theirs, frame));
    assertNear(turned(take.theirs, frame, still), objPositions(frameOf('take', frame)), 5e-5);
  }
});

const frameOf = (folder, frame) => inWork(path.join(folder, `frame_${String(frame).padStart(4, '0')}.obj`));

test('names that are no identifiers, several materials, faces without one', async () => {
  const folder = inWork('odd');
  const { neutral } = sampleFace();
  const face = readFileSync(neutral, 'utf8').replace(/^usemtl .*$/mg, '').split('\n');
  const first = face.findIndex((line) => line.startsWith('f '));
  face.splice(first + 200, 0, 'usemtl skin "of" the\\face');
  face.splice(first + 400, 0, 'usemtl Haut-öl');
  face.splice(first + 600, 0, 'usemtl Haut_öl');
  writeFileSync(inWork('odd.obj'), face.join('\n'));
  const smile = '2nd "smile"\\ö', wider = (line) => line.replace(/^v (\S+)/, (_, x) => `v ${1.1 * x}`);
  writeFileSync(inWork(`${smile}.obj`), face.map(wider).join('\n'));
  sweepface('convert', inWork('odd.obj'), inWork(`${smile}.obj`), '-o', `${folder}.sweep`, '--tolerance', '0.1', '-q');
  sweepface('export', `${folder}.sweep`, '-o', `${folder}.usda`, '-q', '--meters-per-unit', '0.1', '--z-up');
  const [odd] = await readUsd('odd.usda');
  assertRead(odd);
  assert.match(odd.theirs[''].metadata, /^metersPerUnit = 0.1$.*^upAxis = "Z"$/ms);
  const mesh = odd.theirs['/face/mesh'].values;
  assert.deepEqual(mesh['uniform token[] skel:blendShapes'], [smile]);
  assert.deepEqual(mesh['rel skel:blendShapeTargets'], ['/face/mesh/_2nd__smile____']);
  assert.equal(mesh['uniform token subsetFamily:materialBind:familyType'], 'nonOverlapping');
  assert.deepEqual(Object.keys(odd.theirs).filter((prim) => /^\/face\/materials\/\w+$/.test(prim)),
                   ['skin__of__the_face', 'Haut___l', 'Haut___l_2'].map((name) => `/face/materials/${name}`));
});

test('an archive with the images of materials', async () => {
  sweepface('export', sampleFace().sweep, '-o', inWork('plain.glb'), '-q');
  const { json, binary } = new Glb(inWork('plain.glb'));
  const data = (bytes) => `data:;base64,${Buffer.from(bytes).toString('base64')}`;
  json.buffers[0].uri = data(binary);
  json.images = [{ uri: data(readFileSync(picture)), name: 'skin colour' }];
  json.textures = [{ source: 0, sampler: 0 }];
  json.samplers = [{ wrapS: 33071, wrapT: 33648 }];
  Object.assign(json.materials[0], { name: 'skin', alphaMode: 'MASK', alphaCutoff: 0.25, emissiveFactor: [0, 0.5, 1] });
  json.materials[0].pbrMetallicRoughness = { baseColorFactor: [1, 0.5, 0.25, 0.75], baseColorTexture: { index: 0 } };
  json.materials[0].normalTexture = { index: 0 };
  writeFileSync(inWork('textured.gltf'), JSON.stringify(json));
  sweepface('convert', inWork('textured.gltf'), '-o', inWork('textured.sweep'), '--tolerance', '0.1', '-q');
  sweepface('export', inWork('textured.sweep'), '-o', inWork('textured.usdz'), '-q');
  sweepface('export', inWork('textured.sweep'), '-o', inWork('textured.usda'), '-q');
  const [archive, text] = await readUsd('textured.usdz', 'textured.usda');
  assertRead(archive);
  assertRead(text);
  const skin = '/face/materials/skin', { values } = archive.theirs[`${skin}/shader`];
  assert.equal(values['color3f inputs:diffuseColor.connect'], `${skin}/colour.outputs:rgb`);
  assert.equal(values['float inputs:opacity.connect'], `${skin}/colour.outputs:a`);
  assert.equal(values['float inputs:opacityThreshold'], 0.25);
  const map = archive.theirs[`${skin}/colour`].values;
  assert.equal(map['asset inputs:file'], 'textures/skin_colour.png');
  assert.deepEqual(map['float4 inputs:scale'], [1, 0.5, 0.25, 0.75]);
  assert.deepEqual([map['token inputs:wrapS'], map['token inputs:wrapT']], ['clamp', 'mirror']);
  assert.ok(archive.theirs[`${skin}/normal`]);
  assert.deepEqual(Object.entries(archive.images),
                   [['//read.usdz[textures/skin_colour.png]', readFileSync(picture).length]]);
  const plain = text.theirs[`${skin}/shader`].values;
  assert.deepEqual(plain['color3f inputs:diffuseColor'], [1, 0.5, 0.25]);
  assert.deepEqual(plain['color3f inputs:emissiveColor'], [0, 0.5, 1]);
  assert.ok(!text.theirs[`${skin}/colour`]);
});

test('the real head', { skip: !process.env.SWEEPFACE_LONG ? 'runs in the long tests'
                                                         : !realFaces && 'SWEEPFACE_DATA is not set' }, async () => {
  const glb = path.join(realFaces, 'ictface', 'glb', 'head.glb');
  sweepface('convert', glb, '-o', inWork('head.sweep'), '--tolerance', '0.05', '-q');
  sweepface('export', inWork('head.sweep'), '-o', inWork('head.usda'), '-q');
  const [head] = await readUsd('head.usda');
  assertRead(head);
  assert.match(head.theirs[''].metadata, /^metersPerUnit = 1$/m);
});
