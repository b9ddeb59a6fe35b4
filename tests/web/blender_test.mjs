// A production face from Blender - several skinned primitives with textures, vertex colours, two UV
// sets, extras, an animation - goes through a .sweep file and is the same in Blender and three.js.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import validator from 'gltf-validator';
import { difference, pixels, withPage } from './browser.mjs';
import { Glb, farthest } from './glb.mjs';
import { capture, recorded } from './capture.mjs';
import { inWork, run, sampleFace, sweepface, work } from './tool.mjs';

const blender = process.env.SWEEPFACE_BLENDER;
const chromium = existsSync(process.env.SWEEPFACE_CHROMIUM ?? '');

function blend(script, ...args) {
  const file = fileURLToPath(new URL(`blender/${script}`, import.meta.url));
  run(blender, '-b', '--factory-startup', '--python-exit-code', '1', '--python', file, '--', ...args);
}

/** What Blender finds in a file; given `weights`, also the vertices and a picture named `picture`. */
function look(file, weights, picture) {
  const report = inWork('look.json');
  blend('look.py', file, report, ...(weights ? [weights, inWork(`${picture}.png`)] : []));
  if (picture && process.env.SWEEPFACE_PICTURES)
    writeFileSync(`${process.env.SWEEPFACE_PICTURES}/${picture}.png`, readFileSync(inWork(`${picture}.png`)));
  return JSON.parse(readFileSync(report, 'utf8')).meshes;
}

const source = inWork('source.glb'), sweep = inWork('face.sweep'), again = inWork('again.glb');
const tolerance = 0.002;  // a thousandth of the head
blend('make_face.py', source);
sweepface('convert', source, '-o', sweep, '--tolerance', String(tolerance), '-q');
sweepface('export', sweep, '-o', again, '-q');
const before = new Glb(source), after = new Glb(again);
const rigMesh = (mesh) => mesh.primitives.some((p) => p.targets);

test('the file made for this test has everything in it', () => {
  const { meshes, skins, images, animations, cameras } = before.json;
  assert.equal(meshes.length, 5);
  assert.equal(meshes.filter(rigMesh).length, 3);
  assert.equal(meshes.flatMap((m) => m.primitives).length, 6);
  assert.equal(images.length, 6);
  assert.ok(skins.length >= 1 && animations.length === 1 && cameras.length === 1);
  const { attributes } = before.json.meshes.find((m) => m.name === 'head').primitives[0];
  for (const name of ['TEXCOORD_0', 'TEXCOORD_1', 'COLOR_0', 'JOINTS_0', 'WEIGHTS_0']) assert.ok(name in attributes, name);
});

test('nodes, skeletons, materials, cameras and extras are the same', () => {
  const plain = (json) => ['scene', 'scenes', 'nodes', 'materials', 'textures', 'samplers', 'cameras', 'extras', 'asset.copyright']
      .map((key) => [key, json[key]]);
  assert.deepEqual(plain(after.json), plain(before.json));
  before.json.skins.forEach((skin, k) => {
    assert.deepEqual({ ...after.json.skins[k], inverseBindMatrices: 0 }, { ...skin, inverseBindMatrices: 0 });
    assert.deepEqual(after.numbers(after.json.skins[k].inverseBindMatrices), before.numbers(skin.inverseBindMatrices));
  });
});

test('images are the same to the byte', () => {
  before.json.images.forEach((image, k) => {
    assert.equal(after.json.images[k].mimeType, image.mimeType);
    assert.ok(after.image(k).equals(before.image(k)), image.name);
  });
});

test('the animation of the skeleton is the same', () => {
  const [a] = before.json.animations, [b] = after.json.animations;
  assert.equal(b.name, a.name);
  assert.deepEqual(b.channels, a.channels);
  a.samplers.forEach((sampler, k) => {
    assert.equal(b.samplers[k].interpolation, sampler.interpolation);
    for (const side of ['input', 'output'])
      assert.deepEqual(after.numbers(b.samplers[k][side]), before.numbers(sampler[side]));
  });
});

test('triangles, weights, colours and texture coordinates are the same', () => {
  const theirs = before.primitives(), ours = after.primitives();
  assert.equal(ours.length, theirs.length);
  theirs.forEach(({ mesh, primitive }, k) => {
    const ourPrimitive = ours[k].primitive;
    assert.equal(ourPrimitive.material, primitive.material);
    assert.deepEqual(after.numbers(ourPrimitive.indices), before.numbers(primitive.indices));
    assert.deepEqual(Object.keys(ourPrimitive.attributes).sort(), Object.keys(primitive.attributes).sort());
    for (const [name, accessor] of Object.entries(primitive.attributes))
      if (!rigMesh(mesh) || !['POSITION', 'NORMAL'].includes(name))
        assert.deepEqual(after.numbers(ourPrimitive.attributes[name]), before.numbers(accessor), `${mesh.name} ${name}`);
  });
});

test('shapes and targets are within the tolerance', () => {
  before.primitives().forEach(({ mesh, primitive }, k) => {
    if (!rigMesh(mesh)) return;
    const ours = after.primitives()[k];
    assert.deepEqual(ours.mesh.extras, mesh.extras);
    assert.equal(ours.primitive.targets.length, primitive.targets.length);
    const limit = tolerance / Math.min(1, ...(before.json.nodes.find((n) => n.mesh === ours.m).scale ?? [1]));
    const base = [after.numbers(ours.primitive.attributes.POSITION), before.numbers(primitive.attributes.POSITION)];
    assert.ok(farthest(...base) <= limit);
    primitive.targets.forEach((target, t) => {
      const moved = [after.numbers(ours.primitive.targets[t].POSITION), before.numbers(target.POSITION)]
          .map((delta, side) => delta.map((d, c) => d + base[side][c]));
      assert.ok(farthest(...moved) <= limit * 1.0001, `${mesh.name} ${t}`);
    });
  });
});

test('Blender finds the same targets, materials, UV sets and bones', () => {
  const plain = (meshes) => Object.entries(meshes).map(([name, { keys, materials, uvs, groups }]) =>
    ({ name, keys, materials, uvs, groups }));
  assert.deepEqual(plain(look(again)), plain(look(source)));
});

const weights = 'jawOpen=1,smile=0.5,tilt=0.4';

test('Blender shows the same face', () => {
  const theirs = look(source, weights, 'blender-source'), ours = look(again, weights, 'blender-again');
  for (const [name, { vertices }] of Object.entries(theirs))
    assert.ok(farthest(ours[name].vertices.flat(), vertices.flat()) <= 2.5 * tolerance, name);  // 1 + 1 + 0.5
  const [a, b] = ['blender-source', 'blender-again'].map((n) => pixels(readFileSync(inWork(`${n}.png`))));
  const empty = { ...a, data: a.data.map((_, k) => a.data[k % a.channels]) };
  assert.ok(difference(a, empty) > 0.2, 'there is a face in the picture');
  const share = difference(a, b, 16);
  assert.ok(share < 0.002, `${share} of the picture differs`);
});

test('Blender plays sampled keys on the law', () => {
  const file = inWork('sampled.glb');
  sweepface('animate', sweep, '--to', 'jawOpen=0.8,tilt=1', '--law', 'newton', '--keys', 'sampled',
            '--frames', '25', '-o', file, '-q');
  const meshes = look(file);
  for (const [name, target, end] of [['head', 'jawOpen', 0.8], ['teeth', 'jawOpen', 0.8], ['hat', 'tilt', 1]]) {
    const { keys, frames } = meshes[name];
    assert.equal(frames.length, 25);
    frames.forEach((values, k) => assert.ok(Math.abs(values[keys.indexOf(target)] - end * (k / 24) ** 2) < 1e-5,
                                            `${name} at ${k}`));
  }
});

test('Blender plays a capture by name, and parts of regions', () => {
  const face = sampleFace().sweep, file = inWork('take.glb'), regions = inWork('regions.json');
  writeFileSync(regions, JSON.stringify({regions: [{name: 'chin', points: [[0, -9, 9]], over: 'space', whole: 2, fade: 5, delay: 0.25}]}));
  sweepface('animate', face, '--clip', capture('take.csv', 4), '--regions', regions, '--keys', 'sampled', '--fps', '24',
            '--head', 'on', '-o', file, '-q');
  const [mesh] = Object.values(look(file));
  assert.ok(mesh.frames.length >= 95);
  let most = 0;
  mesh.frames.slice(0, 95).forEach((values, k) => {
    const t = k / 24, value = (name) => values[mesh.keys.indexOf(name)];
    const rest = recorded('JawOpen', t), chin = recorded('JawOpen', Math.max(t - 0.25, 0)), least = Math.min(rest, chin);
    for (const [name, expected] of [['jawOpen', least], ['jawOpen@rest', rest - least], ['jawOpen@chin', chin - least]])
      assert.ok(Math.abs(value(name) - expected) < 4e-3, `${name} at ${t}: ${value(name)}, not ${expected}`);
    most = Math.max(most, value('jawOpen@chin'));
  });
  assert.ok(most > 0.05);
});

test('the validator has no more to say than against the source', async () => {
  const complaints = async (file) => (await validator.validateBytes(new Uint8Array(readFileSync(file)))).issues.messages
      .filter(({ severity }) => severity < 2).map(({ code, pointer }) => `${code} ${pointer}`);
  const known = await complaints(source);
  const ways = [['export'], ['export', '--lod', '3'], ['export', '--quantize'], ['export', '--morph-normals', '--quantize', '--lod', '2'],
                ['export', '--vertices', '3000', '--morph-normals'], ['export', '--edge-length', '0.3', '--quantize'],
                ['animate', '--to', 'jawOpen=1,tilt=1', '--law', 'accelerate-brake']];
  for (const [command, ...options] of ways) {
    const file = inWork('way.glb');
    sweepface(command, sweep, '-o', file, '-q', ...options);
    assert.deepEqual((await complaints(file)).filter((c) => !known.includes(c)), [], [command, ...options].join(' '));
  }
});

test('refined, it is bound and looks as before', () => {
  const file = inWork('fine.glb');
  sweepface('export', sweep, '-o', file, '-q', '--lod', '2');
  look(source, weights, 'blender-source'), look(file, weights, 'blender-fine');
  const [a, b] = ['blender-source', 'blender-fine'].map((n) => pixels(readFileSync(inWork(`${n}.png`))));
  const share = difference(a, b, 16);
  assert.ok(share < 0.01, `${share} of the picture differs`);
});

test('three.js shows the same face', { skip: !chromium && 'Chromium is not installed' }, async () => {
  const here = fileURLToPath(new URL('blender', import.meta.url));
  const picture = (name, file, at) =>
    withPage([here, work], `still.html?file=${file}&weights=${at}`, async (page, said) => {
      await page.waitForFunction('document.body.dataset.shown');
      const png = await page.screenshot();
      if (process.env.SWEEPFACE_PICTURES) writeFileSync(`${process.env.SWEEPFACE_PICTURES}/${name}.png`, png);
      assert.deepEqual(said, []);
      return pixels(png);
    });
  const theirs = await picture('three-source', 'source.glb', weights);
  const ours = await picture('three-again', 'again.glb', weights);
  const rest = await picture('three-rest', 'again.glb', 'jawOpen=0');
  const share = difference(theirs, ours, 16), moved = difference(rest, ours, 16);
  assert.ok(moved > 0.05, 'the weights show');
  assert.ok(share < 0.002, `${share} of the picture differs`);
});
