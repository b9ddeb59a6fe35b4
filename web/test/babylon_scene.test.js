import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {newFolder, sample, tool} from './native.js';
import {changed, converted, inOtherModes, model, smilingEye} from './scene_file.js';
import {assertTellsWhetherToDraw} from './updates.js';

const core = '@babylonjs/core', loaders = '@babylonjs/loaders';
const installed = await import(`${loaders}/glTF/2.0/index.js`).catch(() => undefined);
const options = {skip: installed ? false : `${loaders} is not installed; try npm ci`};
const {NullEngine} = installed ? await import(`${core}/Engines/nullEngine.js`) : {};
const {Scene} = installed ? await import(`${core}/scene.js`) : {};
const {FreeCamera} = installed ? await import(`${core}/Cameras/freeCamera.js`) : {};
const {Vector3} = installed ? await import(`${core}/Maths/math.vector.js`) : {};
const {LoadAssetContainerAsync} = installed ? await import(`${core}/Loading/sceneLoader.js`) : {};
const {importScene} = installed ? await import('../sweepface_babylon_scene.js') : {};

const STILL = {pluginOptions: {gltf: {animationStartMode: 0}}};  // Babylon.js starts the first animation else
const file = installed && converted(model()), bytes = installed && readFileSync(file);

/** A scene whose frames take 16 ms. */
function newScene(rightHanded = false) {
  const scene = new Scene(new NullEngine());
  scene.useRightHandedSystem = rightHanded;
  scene.useConstantAnimationDeltaTime = true;
  new FreeCamera('camera', new Vector3(0, 0, 5), scene);
  return scene;
}

async function load(given = bytes, more = STILL, world = newScene()) {
  return {world, ...await importScene(given, world, more)};
}

/** What Babylon.js reads of the GLB that the tool writes of a face. */
async function exportedScene(sweep, scene) {
  const glb = join(newFolder(), 'out.glb');
  execFileSync(tool, ['export', sweep, '-o', glb, '--quiet', '--morph-normals']);
  const written = new Uint8Array(readFileSync(glb));
  const container = await LoadAssetContainerAsync(written, scene, {pluginExtension: '.glb', ...STILL});
  container.addAllToScene();
  return container;
}

const targetsOf = ({morphTargetManager: manager}) =>
  Array.from({length: manager?.numTargets ?? 0}, (_, k) => manager.getTarget(k));

/** Where the vertices of a mesh are shown, or where its normals point. */
function shownAt(mesh, kind) {
  const world = mesh.computeWorldMatrix(true), isNormal = kind === 'normal';
  const data = isNormal ? mesh.getNormalsData(true, true) : mesh.getPositionData(true, true);
  const turn = isNormal ? Vector3.TransformNormal : Vector3.TransformCoordinates;
  return Array.from({length: data.length / 3}, (_, v) => turn(Vector3.FromArray(data, 3 * v), world));
}

const furthest = (a, b) => Math.max(...a.map((point, k) => Vector3.Distance(point, b[k])));

/** The vertices that triangles of a mesh name, and their area. Quads may be cut along either diagonal. */
function coverOf(mesh, places) {
  const corners = mesh.isUnIndexed ? [...places.keys()] : mesh.getIndices(), area = Vector3.Zero();
  for (let k = 0; k < corners.length; k += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => places[corners[k + corner]]);
    area.addInPlace(Vector3.Cross(b.subtract(a), c.subtract(a)));
  }
  return {area, vertices: [...new Set(corners)].sort((a, b) => a - b)};
}

function assertShowsTheSame(mesh, other) {
  const [mine, theirs] = [mesh, other].map((each) => shownAt(each, 'position')), {name} = other;
  assert.equal(mesh.name, name);
  assert.ok(furthest(mine, theirs) < 0.004, `${name} ${furthest(mine, theirs)}`);
  const cover = coverOf(mesh, mine), covered = coverOf(other, theirs);
  assert.deepEqual(cover.vertices, covered.vertices, name);
  assert.ok(Vector3.Distance(cover.area, covered.area) < 0.01 * covered.area.length(), name);
  const kinds = (each) => each.getVerticesDataKinds().filter((kind) => !/[0-9]$/.test(kind)).sort();  // not those of targets
  assert.deepEqual(kinds(mesh), kinds(other), name);
  for (const kind of ['uv', 'matricesWeights']) {
    const [own, given] = [mesh, other].map((each) => each.getVerticesData(kind));
    assert.deepEqual(own && [...own], given && [...given]);
  }
  assert.equal(mesh.isUnIndexed, other.isUnIndexed);
  const box = mesh.getBoundingInfo().boundingBox;
  if (mesh.isVerticesDataPresent('normal'))
    assert.ok(furthest(...[mesh, other].map((each) => shownAt(each, 'normal'))) < 0.1, name);
  const data = mesh.getPositionData(true), beyond = mesh.skeleton ? 0.4 : 1e-6;  // of skinned meshes they stay
  for (let k = 0; k < data.length; ++k) {
    const axis = 'xyz'[k % 3];
    assert.ok(data[k] >= box.minimum[axis] - beyond && data[k] <= box.maximum[axis] + beyond, name);
  }
}

/** Compares the scene in a file with the GLB that the tool writes of it, in the neutral and in an expression. */
async function compare(sweep, rightHanded) {
  const {world, face, meshes, ...rest} = await load(readFileSync(sweep), STILL, newScene(rightHanded));
  const exported = await exportedScene(sweep, newScene(rightHanded));
  assert.deepEqual(meshes.map(({name}) => name), exported.meshes.map(({name}) => name));
  for (const far of [0, 0.8]) {
    const weights = Object.fromEntries(face.names.map((name, k) => [name, far * (k % 2 ? -0.4 : 1)]));
    face.setWeights(weights);
    world.render();
    exported.meshes.forEach((other, k) => {
      for (const target of targetsOf(other)) target.influence = weights[target.name] ?? target.influence;
      if (other.getTotalVertices() > 0) assertShowsTheSame(meshes[k], other);
    });
  }
  return {face, meshes, world, ...rest};
}

test('a scene has all that the file had, and the face stands where an exported one does', options, async () => {
  for (const rightHanded of [false, true]) {
    const {face, meshes, skeletons} = await compare(file, rightHanded);
    assert.deepEqual(face.names, ['jawOpen', 'smile', 'look']);
    assert.deepEqual(meshes.map(({material}) => material?.name), [undefined, 'lips', 'skin', 'skin', 'skin', 'felt']);
    assert.deepEqual(face.meshes.map(({name}) => name), ['head_primitive0', 'head_primitive1', 'eyeL', 'eyeR']);
    assert.equal(skeletons.length, 1);
  }
});

test('meshes may be turned, mirrored and stretched at once', options, async () => {
  await compare(changed((json) => {
    Object.assign(json.nodes[3], {scale: [-1, 2, 3], rotation: [0.1, 0.7, 0.5, 0.5]});
    json.nodes[4] = {name: 'eyeR', mesh: 1, scale: [-1, 2, 3], rotation: [0.1, 0.7, 0.5, 0.5]};
  }));
});

test('primitives may be strips, fans, or without indices', options, async () => {
  await compare(changed(inOtherModes));
});

test('triangles may stay in the scene, as strips and fans, too, and there may be no normals', options, async () => {
  for (const [mode, indices] of [[5, [0, 9, 1, 10, 2, 11, 2, 11, 12, 20, 21]], [6, [10, 0, 1, 2, 2, 11, 20, 19, 18, 9]]]) {
    const {face} = await load(readFileSync(changed((json, builder) => {
      json.extensionsUsed = ['EXT_counts_on_the_order'];
      const [, {primitives: [eye]}] = json.meshes, own = builder.accessor(new Uint16Array(indices), 1);
      Object.assign(eye, {mode, indices: own, extensions: {EXT_counts_on_the_order: {}}});
      delete eye.attributes.NORMAL;
    })));
    assert.deepEqual(face.meshes.map((mesh) => mesh.isVerticesDataPresent('normal')), [true, true, false, false]);
    assert.deepEqual(face.meshes.map((mesh) => mesh.getTotalIndices()), [432, 432, indices.length, indices.length]);
  }
});

test('a face may be some of the meshes; targets of others of the same names follow it', options, async () => {
  const {face, meshes, world} = await compare(changed((json) => {
    smilingEye(json);
    json.meshes[0].extras.targetNames[0] = 'jaw';
  }, '--mesh', 'head'));
  assert.deepEqual(face.meshes.map(({name}) => name), ['head_primitive0', 'head_primitive1']);
  const eyes = meshes.filter(({name}) => name.startsWith('eye')).map((mesh) => mesh.morphTargetManager.getTarget(1));
  face.setWeights({smile: 0.75});
  assert.deepEqual(eyes.map(({influence}) => influence), [0.75, 0.75]);
  eyes[0].influence = 0.25;
  world.render();
  assert.equal(face.weights.smile, 0.75);
  face.setWeights({smile: 0.5});
  assert.deepEqual(eyes.map(({influence}) => influence), [0.25, 0.5]);
});

test('coarser levels of detail are left out', options, async () => {
  const {face, meshes} = await load(readFileSync(changed((json) => {
    json.extensionsUsed = ['MSFT_lod'];
    json.meshes.push({...json.meshes[0], name: 'coarse'});
    json.nodes.push({name: 'coarse', mesh: 3});
    json.nodes[0].extensions = {MSFT_lod: {ids: [6]}};
  })));
  assert.equal(face.meshes.length, 4);
  assert.ok(meshes.every(({name}) => !name.startsWith('coarse')));
});

test('bounds are those of all instances of a mesh', options, async () => {
  const {face, world} = await load(readFileSync(changed((json, builder) => {
    json.extensionsUsed = ['EXT_mesh_gpu_instancing'];
    const TRANSLATION = builder.accessor(new Float32Array([0, 0, 0, 20, 0, 0]), 3);
    json.nodes[3].extensions = {EXT_mesh_gpu_instancing: {attributes: {TRANSLATION}}};
    delete json.animations;
  })));
  const eye = face.meshes.find(({name}) => name === 'eyeL'), widthOf = () => eye.getBoundingInfo().boundingBox.extendSize.x;
  assert.ok(widthOf() > 9);
  face.setWeights({look: 1});
  world.render();
  assert.ok(widthOf() > 9);
});

test('weights move influences, and influences weights, and shaders know of neither', options, async () => {
  const {face, world} = await load(), managers = face.meshes.map(({morphTargetManager}) => morphTargetManager);
  const [lips, skin, left, right] = managers;
  assert.deepEqual(face.weights, {jawOpen: 0.25, smile: 0, look: 0});
  face.setWeights({smile: 0.5, look: 0.75});
  for (const mesh of face.meshes.slice(0, 2)) assert.deepEqual(targetsOf(mesh).map(({influence}) => influence), [0.25, 0.5]);
  right.getTargetByName('look').influence = 0.25;
  skin.getTargetByName('smile').influence = 1;
  world.render();
  assert.deepEqual(face.weights, {jawOpen: 0.25, smile: 1, look: 0.25});
  assert.deepEqual([left.getTarget(0).influence, lips.getTarget(1).influence], [0.25, 1]);
  for (const {numInfluencers, numMaxInfluencers} of managers) assert.deepEqual([numInfluencers, numMaxInfluencers], [0, 0]);
  face.setWeights({jawOpen: 0});
  face.update();
  assertTellsWhetherToDraw(face);
});

test('it moves as the scene lets time pass', options, async () => {
  const {face, world} = await load();
  face.setWeights({jawOpen: 0});
  face.moveTo({jawOpen: 1}, {kind: 'newton', seconds: 0.16});
  for (let k = 0; k < 5; ++k) world.render();
  assert.ok(Math.abs(face.weights.jawOpen - 0.25) < 1e-9);
  face.advancesWithScene = false;
  world.render();
  assert.ok(Math.abs(face.weights.jawOpen - 0.25) < 1e-9);
  assert.equal(face.advance(0.04), true);
  assert.ok(Math.abs(face.weights.jawOpen - 0.5625) < 1e-9);
});

test("the file's animations move the skeleton and the face, except for targets that stay at 0", options, async () => {
  const {face, world, transformNodes, animationGroups: [take]} = await load(readFileSync(changed((json, builder) => {
    json.animations[0].samplers[0].output = builder.accessor(new Float32Array([0.25, 0, 0.75, 0]), 1);
  })));
  assert.ok(!take.isStarted);
  take.start();
  take.goToFrame((take.from + take.to) / 2);
  face.setWeights({smile: 0.5});
  face.update();
  assert.ok(Math.abs(face.weights.jawOpen - 0.5) < 1e-3);
  assert.equal(face.weights.smile, 0.5);
  assert.ok(Math.abs(transformNodes.find(({name}) => name === 'neck').position.y + 1.5) < 1e-3);
  world.render();
  assert.equal((await load(bytes, {})).animationGroups[0].isStarted, true, 'as Babylon.js has it');
});

/** The model with a smile that is 0 in its animation, and an eye of its own smile, which is 0 there, too. */
const still = (json, builder) => {
  const [{samplers, channels}] = json.animations;
  smilingEye(json);
  samplers[0].output = builder.accessor(new Float32Array([0.25, 0, 0.75, 0]), 1);
  samplers.push({...samplers[0], output: builder.accessor(new Float32Array(4), 1)});
  channels.push({sampler: 2, target: {node: 3, path: 'weights'}});
};

test('an animation that Babylon.js started leaves targets to others that it keeps at 0', options, async () => {
  const {face, world, meshes, animationGroups: [take]} = await load(readFileSync(changed(still, '--mesh', 'head')), {});
  const smiles = meshes.filter(({name}) => name.startsWith('eye')).map((mesh) => mesh.morphTargetManager.getTarget(1));
  assert.equal(take.isStarted, true);
  assert.equal(take.targetedAnimations.length, 4, 'the neck, the jaw of two primitives, and a look');
  face.setWeights({smile: 0.5});
  for (let k = 0; k < 3; ++k) world.render();
  assert.equal(face.weights.smile, 0.5);
  assert.deepEqual(smiles.map(({influence}) => influence), [0.5, 0.5]);
  assert.ok(face.weights.jawOpen > 0.25);
});

test('what splines move between two 0s is moved', options, async () => {
  const {face, animationGroups: [take]} = await load(readFileSync(changed((json, builder) => {
    const [{samplers: [weights]}] = json.animations, output = [0, 0, 0, 0, 0, 2, 0, -2, 0, 0, 0, 0];
    Object.assign(weights, {interpolation: 'CUBICSPLINE', output: builder.accessor(new Float32Array(output), 1)});
  })));
  take.start();
  take.goToFrame((take.from + take.to) / 2);
  face.update();
  assert.ok(Math.abs(face.weights.smile - 0.5) < 1e-3);
});

test('disposing of the face takes the scene with it, and disposing of the meshes the face', options, async () => {
  const {face, world} = await load(), rest = [world.meshes, world.materials, world.skeletons, world.animationGroups];
  const {onAfterAnimationsObservable: passes, onBeforeRenderTargetsRenderObservable: shows} = world;
  assert.deepEqual([passes.hasObservers(), shows.hasObservers()], [true, true]);
  face.meshes[0].dispose();
  face.setWeights({smile: 1});  // the others go on
  world.render();
  face.dispose();
  assert.deepEqual(rest.map(({length}) => length), [0, 0, 0, 0]);
  await new Promise((done) => setTimeout(done));  // Babylon.js removes observers later
  assert.deepEqual([passes.hasObservers(), shows.hasObservers()], [false, false]);
  world.render();
  assert.throws(() => face.names, /disposed of/);
  const other = await load();
  other.meshes[0].dispose();
  assert.throws(() => other.face.names, /disposed of/);
  other.world.render();
  const third = await load();
  third.world.dispose();
  assert.throws(() => third.face.names, /disposed of/);
});

test('a second model may have a clone of the face', options, async () => {
  const {face, world} = await load(), cloned = async () => face.face.clone();
  const other = await importScene(bytes, world, {...STILL, load: cloned});
  face.setWeights({smile: 1});
  world.render();
  assert.deepEqual([face.weights.smile, other.face.weights.smile], [1, 0]);
  face.dispose();
  other.face.setWeights({smile: 0.5});
  world.render();
  assert.equal(world.meshes.length, other.meshes.length);
});

test('what cannot be shown says so', options, async (context) => {
  const plain = readFileSync(sample), cut = bytes.slice(0, bytes.length - 1), scene = newScene();
  const fails = (given, message, more) => assert.rejects(importScene(given, scene, more), {message});
  await fails(plain, 'The face holds no scene, as it was made from a mesh without one or with --bare; ' +
                     'load it by SweepfaceMesh.load.');
  await fails(cut, /^The face, byte \d+: the file ends before its last chunk/);
  await fails(5, /^Sweepface\.load needs the bytes/);
  await fails(bytes, /^The meshes of a scene have the vertices of their source; leave out/, {lod: 2});
  await assert.rejects(importScene(bytes, 5), {message: /^A mesh takes the scene that it belongs to/});
  await fails(readFileSync(changed((json) => json.extensionsRequired = json.extensionsUsed = ['KHR_texture_basisu'])),
              /^avatar: its scene cannot be shown: .*KHR_texture_basisu/,
              {name: 'avatar', pluginOptions: {gltf: {extensionOptions: {KHR_texture_basisu: {enabled: false}}}}});
  const elsewhere = (json) => {
    json.extensionsUsed = ['EXT_counts_on_the_order'];
    json.meshes[1].primitives[0].extensions = {EXT_counts_on_the_order: {}};
    json.scenes = [{nodes: [0, 1, 5]}, {nodes: [3, 4]}];
  };
  const hidden = readFileSync(changed(elsewhere, '--mesh', 'head', '--mesh', 'eye'));
  await fails(hidden, /^The face: the scene of its file shows not all of the meshes of the face; load the face alone by/);
  await fails(readFileSync(changed(elsewhere, '--mesh', 'eye')), /^The face: the scene of its file shows none of the/);
  context.mock.method(globalThis, 'fetch', async () => new Response(null, {status: 404}));
  await fails('http://a/avatar.sweep?secret', 'http://a/avatar.sweep cannot be loaded: the server answers 404.');
  assert.deepEqual([scene.meshes.length, scene.materials.length, scene.isReady()], [0, 0, true]);
});

test('what fails halfway leaves nothing behind', options, async () => {
  const {Sweepface} = await import('../sweepface.js'), world = newScene(), faces = [];
  const keep = async (...given) => (faces.push(await Sweepface.load(...given)), faces.at(-1));
  const painted = async (...given) => {
    const face = await keep(...given), parts = face.parts.map((part) => ({...part, material: 'paint'}));
    return Object.defineProperty(face, 'parts', {value: parts});
  };
  const other = async () => keep(readFileSync(sample));
  const late = async (...given) => (world.dispose(), keep(...given));
  for (const [how, message] of [[painted, /^The face: the face has other materials than its scene; /],
                                [other, /^The face: the face and its scene do not fit; /],
                                [late, 'The scene was disposed of while the face was loading.']]) {
    await assert.rejects(importScene(bytes, world, {load: how}), {message});
    assert.throws(() => faces.at(-1).names, /disposed of/);
    const {meshes, geometries, skeletons, materials, morphTargetManagers} = world;
    const lists = [meshes, geometries, skeletons, materials, morphTargetManagers];
    assert.ok(lists.every(({length}) => length === 0));
  }
});

test('images beside the scene are looked for beside the file', options, async (context) => {
  const apart = readFileSync(changed((json) => json.images[0] = {uri: 'skin.png'})), asked = [];
  context.mock.method(globalThis, 'fetch', async () => new Response(apart));
  const preprocessUrlAsync = async (url) => (asked.push(url), 'data:image/png;base64,AA==');
  const pluginOptions = {gltf: {animationStartMode: 0, preprocessUrlAsync}};
  await importScene('http://a/models/x.sweep?of=1/2', newScene(), {pluginOptions}).catch(() => {});
  assert.deepEqual(asked, ['http://a/models/skin.png']);
});

test('it loads from a URL, in a worker, too, and is waited for', options, async (context) => {
  const {Sweepface} = await import('../sweepface.js'), scene = newScene(), loaded = [];
  context.mock.method(globalThis, 'fetch', async () => new Response(bytes));
  const remember = async (...given) => (loaded.push(given[1].name), Sweepface.load(...given));
  const loading = importScene(new URL('http://a/models/avatar.sweep'), scene, {load: remember, ...STILL});
  assert.equal(scene.isReady(), false);
  assert.equal((await loading).face.meshes.length, 4);
  assert.equal((await importScene(bytes)).container.scene, scene, 'the last one that was made');
  assert.deepEqual(loaded, ['http://a/models/avatar.sweep']);
});
