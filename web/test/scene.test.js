import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {deflateSync, inflateSync} from 'node:zlib';
import {crc32, parted} from '../sweepface_chunks.js';
import {formatGlb} from '../sweepface_glb.js';
import {skip, withPage} from './browser.js';
import {newFolder, tool} from './native.js';
import {changed, converted, inOtherModes, inSilence, loadScene, model, smilingEye} from './scene_file.js';
import {assertTellsWhetherToDraw} from './updates.js';

const three = await import('three').catch(() => undefined);
const options = {skip: three ? false : 'three is not installed; try npm ci'};

const file = three && converted(model()), bytes = three && readFileSync(file);

/** What a loader of scenes makes of a file. */
const load = (given = bytes, settings = {}) => loadScene(given, settings);

/** What three.js reads of the GLB that the tool writes of a face. */
async function exportedScene(sweep, ...more) {
  const {GLTFLoader} = await import('three/addons/loaders/GLTFLoader.js');
  const glb = join(newFolder(), 'out.glb');
  execFileSync(tool, ['export', sweep, '-o', glb, '--quiet', ...more]);
  return inSilence(() => new GLTFLoader().parseAsync(new Uint8Array(readFileSync(glb)).buffer, ''));
}

/** The meshes of a scene by the numbers of their node and primitive. */
function meshesOf({scene, parser}) {
  const found = new Map();
  scene.updateMatrixWorld(true);
  scene.traverse((object) => {
    if (object.isMesh) found.set(`${object.name} ${parser.associations.get(object).primitives}`, object);
  });
  return found;
}

/** The vertices of a mesh where the renderer shows them: morphed, skinned, in the world. */
function placesOf(mesh) {
  return Array.from({length: mesh.geometry.attributes.position.count}, (_, v) => {
    return mesh.getVertexPosition(v, new three.Vector3()).applyMatrix4(mesh.matrixWorld);
  });
}

const furthest = (a, b) => Math.max(...a.map((point, k) => point.distanceTo(b[k])));

/** What triangles of a mesh cover: the vertices that they name, and their area. Quads may be cut along either diagonal. */
function coverOf({geometry: {index, attributes: {position}}}, places) {
  const corners = index?.array ?? [...Array(position.count).keys()], area = new three.Vector3();
  for (let k = 0; k < corners.length; k += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => places[corners[k + corner]]);
    area.add(b.clone().sub(a).cross(c.clone().sub(a)));
  }
  return {area, vertices: [...new Set(corners)].sort((a, b) => a - b)};
}

/** Whether two meshes show the same in an expression: vertices, triangles and what does not move. */
function assertShowsTheSame(mesh, other, name) {
  const mine = mesh.geometry.attributes, theirs = other.geometry.attributes, [places, those] = [mesh, other].map(placesOf);
  const cover = coverOf(mesh, places), covered = coverOf(other, those);
  assert.ok(furthest(places, those) < 0.004, `${name} ${furthest(places, those)}`);
  assert.deepEqual(Object.keys(mine).sort(), Object.keys(theirs).sort());
  assert.deepEqual(cover.vertices, covered.vertices, name);
  assert.ok(cover.area.distanceTo(covered.area) < 0.01 * covered.area.length(), name);
  for (const vertex of cover.vertices)
    assert.deepEqual([mine.uv?.getX(vertex), mine.uv?.getY(vertex)], [theirs.uv?.getX(vertex), theirs.uv?.getY(vertex)], name);
  assert.deepEqual(mine.skinWeight?.array, theirs.skinWeight?.array);
}

/** Compares the scene in a file with the GLB that the tool writes of it, in the neutral and in an expression. */
async function compare(sweep) {
  const {face, ...rest} = await load(readFileSync(sweep)), mine = meshesOf(rest), theirs = meshesOf(await exportedScene(sweep));
  assert.deepEqual([...mine.keys()], [...theirs.keys()]);
  for (const far of [0, 0.8]) {
    const weights = Object.fromEntries(face.names.map((name, k) => [name, far * (k % 2 ? -0.4 : 1)]));
    face.setWeights(weights);
    face.update();
    for (const [name, mesh] of mine) {
      const other = theirs.get(name);
      for (const [target, k] of Object.entries(other.morphTargetDictionary ?? {}))  // a number, if it has no name
        other.morphTargetInfluences[k] = weights[face.names[target] ?? target] ?? other.morphTargetInfluences[k];
      assertShowsTheSame(mesh, other, name);
    }
  }
  face.reset();
  face.update();
  for (const [name, mesh] of mine) {
    const {normal} = mesh.geometry.attributes, other = theirs.get(name).geometry.attributes.normal;
    for (let v = 0; normal && v < normal.count; ++v) {
      const [a, b] = [normal, other].map((list) => new three.Vector3().fromBufferAttribute(list, v));
      assert.ok(a.angleTo(b) < 0.02, `${name} ${v}`);
    }
  }
  return {face, mine};
}

test('a scene has all that the file had, and the face stands where an exported one does', options, async () => {
  const {face, mine} = await compare(file);
  assert.deepEqual(face.names, ['jawOpen', 'smile', 'look']);
  assert.deepEqual([...mine.values()].map(({material}) => material.name), ['lips', 'skin', 'skin', 'skin', 'felt']);
});

/** Makes the head four primitives of one set of vertices, with these materials. */
const quartered = (materials) => (json) => {
  const [{primitives: halves}] = json.meshes, {accessors} = json;
  json.meshes[0].primitives = halves.flatMap((half) => [0, 1].map((later) => {
    const {count, byteOffset = 0, ...all} = accessors[half.indices];
    accessors.push({...all, count: count / 2, byteOffset: byteOffset + later * count});
    return {...half, indices: accessors.length - 1};
  })).map((primitive, k) => ({...primitive, material: materials[k]}));
};

test('primitives of the same vertices have the triangles of their own', options, async () => {
  for (const materials of [[1, undefined, 0, 1], [0, 0, 0, 0], [2, 1, 0, 2]])
    for (const more of [[], ['--strip', 'groups']]) await compare(changed(quartered(materials), ...more));
});

test('a face that was given other materials is refused', options, async () => {
  const drawing = join(newFolder(), 'drawing.wire.json'), painted = join(newFolder(), 'painted.sweep');
  execFileSync(tool, ['wireframe', file, '-o', drawing, '--quiet']);
  const drawn = JSON.parse(readFileSync(drawing));
  drawn.patches.forEach((patch, k) => patch.material = k % 3 ? 'lips' : 'skin');
  writeFileSync(drawing, JSON.stringify(drawn));
  execFileSync(tool, ['build', drawing, '--source', file, '-o', painted, '--quiet']);
  await assert.rejects(load(readFileSync(painted)), {
    message: /^model\.sweep: the face has other materials than its scene; export it as a \.glb/
  });
});

test('texture coordinates are those of each primitive, also where they share vertices', options, async () => {
  await compare(changed((json) => {
    json.extensionsUsed = ['KHR_texture_transform'];
    json.materials[1].pbrMetallicRoughness = {
      baseColorTexture: {index: 0, extensions: {KHR_texture_transform: {scale: [3, 3]}}}
    };
  }));
  await compare(changed((json) => {
    json.extensionsUsed = ['EXT_counts_on_the_order'];  // so that triangles stay in the scene
    json.meshes[0].primitives[0].extensions = {EXT_counts_on_the_order: {}};
  }));
  await compare(changed(() => {}, '--strip', 'uv'));
});

test('strips, fans and what has no indices are part of the face', options, async () => {
  await compare(changed(inOtherModes));
});

test('nodes place meshes as the tool has it: by matrices, one in another, those of a scene first', options, async () => {
  const {face, mine} = await compare(changed((json) => {
    const turned = [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 2, 0, 0.5, 0, 0, 1];
    json.nodes[3] = {name: 'eyeL', mesh: 1, matrix: turned};
    json.nodes[4] = {name: 'eyeR', mesh: 1, scale: [1, 2, 3], translation: [-0.4, 0.3, 0.9]};
    json.nodes.push({name: 'up', children: [3], scale: [1, 1, 2], rotation: [0.6, 0, 0, 0.8]});
    json.nodes.push({name: 'top', children: [6], translation: [1, 2, 3]});
    json.scenes[0].nodes = [0, 1, 7, 5];  // not the other eye
    // A skin ignores this, but not that it mirrors.
    Object.assign(json.nodes[0], {scale: [-3, 1, 1], translation: [5, 5, 5]});
    [json.nodes[4], json.nodes[3]] = [json.nodes[3], json.nodes[4]];
    json.nodes[6].children = [4];
    delete json.animations;
  }));
  assert.deepEqual([face.meshes.length, mine.size], [3, 4]);
});

/** The model with an eye that smiles and looks somewhere at first, and another name for the jaw. */
const winking = (json) => {
  smilingEye(json);
  json.meshes[1].weights = [0.5, 0];
  json.meshes[0].extras.targetNames[0] = 'jaw';
};

test('a face may be some of the meshes, with or without targets', options, async () => {
  for (const [names, meshes] of [[['head'], 2], [['head', 'hat'], 3], [['eyeL'], 2]]) {
    const {face} = await compare(changed(winking, ...names.flatMap((name) => ['--mesh', name])));
    assert.equal(face.meshes.length, meshes, names.join());
  }
});

test('targets of other meshes move with those of the face that have the same names', options, async () => {
  const {face, scene} = await load(readFileSync(changed(winking, '--mesh', 'head')));
  const eyes = ['eyeL', 'eyeR'].map((name) => scene.getObjectByName(name));
  assert.deepEqual(face.names, ['jaw', 'smile']);
  const look = eyes[0].morphTargetInfluences[0];
  const seen = () => eyes.map(({morphTargetInfluences}) => [...morphTargetInfluences]);
  face.setWeights({jaw: 1, smile: 0.75});
  assert.deepEqual(seen(), [[look, 0.75], [look, 0.75]]);
  eyes[0].morphTargetInfluences[1] = 0;  // which moves the eye alone, from now on
  eyes[1].morphTargetInfluences[0] = 0.125;
  face.update();
  assert.equal(face.weights.smile, 0.75);
  face.setWeights({smile: 0.5});
  assert.deepEqual(seen(), [[look, 0], [0.125, 0.5]]);
  const {cloneScene} = await import('../sweepface_scene.js'), copy = cloneScene({scene, face, animations: []});
  copy.face.setWeights({smile: 1});
  assert.equal(copy.scene.getObjectByName('eyeL').morphTargetInfluences[1], 1);
  assert.deepEqual(seen(), [[look, 0], [0.125, 0.5]]);
});

test('other meshes are shown as the file shows them until weights change', options, async () => {
  const {face, scene} = await load(readFileSync(changed((json) => {
    winking(json);
    json.meshes[1].weights = [0.5, 0.875];
    json.meshes[0].extras.targetNames[0] = 'look';
  }, '--mesh', 'head')));
  const {morphTargetInfluences: seen} = scene.getObjectByName('eyeL');
  assert.deepEqual([face.weights, [...seen]], [{look: 0.25, smile: 0}, [0.5, 0.875]]);
  face.setWeights({look: 1});
  assert.deepEqual([...seen], [1, 0.875]);
});

test('parts without normals get none, and extras stay', options, async () => {
  const {face} = await compare(changed((json) => {
    delete json.meshes[1].primitives[0].attributes.NORMAL;
    json.meshes[0].extras.maker = 'me';
  }));
  assert.equal(face.meshes[0].userData.maker, 'me');
});

test('a face is shown at first as the file shows it', options, async () => {
  const {face} = await load();
  assert.deepEqual(face.weights, {jawOpen: 0.25, smile: 0, look: 0});
  assert.deepEqual(face.meshes.map(({morphTargetInfluences}) => morphTargetInfluences), [[0.25, 0], [0.25, 0], [0], [0]]);
  assert.deepEqual(face.meshes.map(({geometry}) => Object.keys(geometry.morphAttributes)), [[], [], [], []]);
});

test('weights move influences, and influences weights, wherever meshes have them', options, async () => {
  const {face} = await load(), [lips, skin, left, right] = face.meshes;
  face.setWeights({smile: 0.5, look: 0.75});
  for (const mesh of [lips, skin]) assert.deepEqual(mesh.morphTargetInfluences, [0.25, 0.5]);
  assert.deepEqual([left.morphTargetInfluences, right.morphTargetInfluences], [[0.75], [0.75]]);
  const before = left.geometry.attributes.position.array.slice();
  right.morphTargetInfluences[0] = 0.25;
  skin.morphTargetInfluences[1] = 1;
  assert.equal(face.update(), true);
  assert.deepEqual(face.weights, {jawOpen: 0.25, smile: 1, look: 0.25});
  assert.deepEqual([left.morphTargetInfluences, lips.morphTargetInfluences], [[0.25], [0.25, 1]]);
  assert.notDeepEqual(left.geometry.attributes.position.array, before);
  face.setWeights({jawOpen: 0});
  face.update();
  assertTellsWhetherToDraw(face);
});

test("three.js's mixer plays the file's animations, of the skeleton and of the face", options, async () => {
  const {face, scene, animations: [take]} = await load(), mixer = new three.AnimationMixer(scene);
  mixer.clipAction(take).play();
  mixer.update(0.5);
  face.update();
  assert.deepEqual(face.weights, {jawOpen: 0.5, smile: 0.25, look: 0});
  assert.equal(scene.getObjectByName('neck').position.y, -1.5);
});

test('an animation leaves the targets that it does not move to others', options, async () => {
  const still = readFileSync(changed((json, builder) => {
    const [{samplers}] = json.animations;
    samplers[0].output = builder.accessor(new Float32Array([0.2, 0, 0.6, 0]), 1);
    const output = builder.accessor(new Float32Array([0, 0, 0, -1, 0, 0]), 1);
    samplers.push({...samplers[0], interpolation: 'CUBICSPLINE', output});
    json.animations[0].channels.push({sampler: 2, target: {node: 4, path: 'weights'}});
  }));
  const {face, scene, animations: [take]} = await load(still), mixer = new three.AnimationMixer(scene);
  mixer.clipAction(take).play();
  face.moveTo({smile: 1}, {kind: 'linear-force', seconds: 0.25});
  for (let k = 0; k < 2; ++k) {
    mixer.update(0.25);
    face.update(0.25);
  }
  assert.ok(Math.abs(face.weights.jawOpen - 0.4) < 1e-6);
  assert.equal(face.weights.smile, 1);
  assert.ok(face.weights.look > 0.1);  // a cubic spline
  assert.ok(take.tracks.some(({name}) => name.endsWith('.position')));
});

test('bounds are those of the expression', options, async () => {
  const {face, scene} = await load(), eye = face.meshes[3], {geometry} = eye, {position, normal} = geometry.attributes;
  scene.updateMatrixWorld();
  const lowest = () => Array.from({length: position.count}, (_, v) => new three.Vector3().fromBufferAttribute(position, v))
      .reduce((a, b) => (b.x > a.x ? b : a)).clone();
  geometry.computeBoundingBox();
  const box = geometry.boundingBox.clone(), versions = [position.version, normal.version];
  face.setWeights({look: 20});
  face.update();
  assert.ok(position.version > versions[0] && normal.version > versions[1]);
  assert.ok(geometry.boundingBox.max.x > box.max.x + 0.3);
  assert.ok(geometry.boundingSphere.containsPoint(lowest()));
  const from = lowest().add(new three.Vector3(-0.01, 0, 1)).applyMatrix4(eye.matrixWorld);
  assert.ok(new three.Raycaster(from, new three.Vector3(0, 0, -1)).intersectObject(eye).length > 0);
});

test('a mesh whose geometry or influences were replaced says so', options, async () => {
  for (const replace of [(mesh) => mesh.geometry = mesh.geometry.clone(), (mesh) => mesh.morphTargetInfluences = [0]]) {
    const {face} = await load();
    replace(face.meshes[0]);
    assert.throws(() => face.update(), {message: /^The mesh 'head_1' must keep the geometry and influences/});
    face.dispose();
    assert.equal(face.update(), false);
  }
});

test('a loader may have plugins of its own', options, async () => {
  const {GLTFLoader} = await import('three/addons/loaders/GLTFLoader.js'), seen = [];
  const gltfLoader = new GLTFLoader().register(({json}) => ({
    name: 'mine', afterRoot: async ({scene}) => seen.push(json.meshes.length, scene.children.length)
  }));
  await load(bytes, {gltfLoader});
  assert.deepEqual(seen, [3, 5]);
});

test('the options of faces count, except those that ask for other vertices', options, async () => {
  const {face} = await load(bytes, {regions: [{name: 'chin', points: [[0, -0.5, 0.8]], whole: 0.3, fade: 0.4}]});
  assert.deepEqual(face.regions, ['rest', 'chin']);
  face.setWeights({jawOpen: 1}, 'chin');
  assert.equal(face.weightsIn('chin').jawOpen, 1);
  for (const detail of [{lod: 2}, {vertices: 100}, {edgeLength: 1}, {error: 1}])
    await assert.rejects(load(bytes, detail), {message: /^The meshes of a scene have the vertices of their source; leave out/});
  assert.ok((await load(bytes, {lod: 0})).face.meshes.length > 0);
  await assert.rejects(load(bytes, {mesh: three.Mesh}), {message: /^The option 'mesh' is a class: SweepfaceMesh, /});
  await assert.rejects(load('model.sweep'), {message: /^Sweepface\.load needs the bytes/});
  await assert.rejects(load(bytes, {gltfLoader: 5}), {message: "The option 'gltfLoader' is a GLTFLoader."});
  await assert.rejects(load(bytes, {load: 5}), {message: "The option 'load' is a function: Sweepface.load or loadInWorker."});
  for (const nothing of [{gltfLoader: null}, {name: null}, {name: 5}]) assert.ok((await load(bytes, nothing)).face);
  const {SweepfaceSceneLoader} = await import('../sweepface_scene.js');
  await assert.rejects(new SweepfaceSceneLoader().parseAsync(bytes, 'models/'), /parseAsync takes bytes and options, no path/);
});

test('the bytes may change while the scene is loading', options, async () => {
  const {SweepfaceSceneLoader} = await import('../sweepface_scene.js'), {error} = console;
  console.error = () => {};
  const own = Buffer.from(bytes), loading = new SweepfaceSceneLoader().parseAsync(own).finally(() => console.error = error);
  own.fill(0);
  assert.equal((await loading).face.names.length, 3);
});

test('what GLTFLoader cannot show it says, with the name of the file', options, async () => {
  const {Sweepface} = await import('../sweepface.js'), faces = [];
  const remember = async (...given) => {
    faces.push(await Sweepface.load(...given));
    return faces.at(-1);
  };
  const basis = readFileSync(changed((json) => {
    json.extensionsUsed = json.extensionsRequired = ['KHR_texture_basisu'];
    json.textures[0] = {extensions: {KHR_texture_basisu: {source: 0}}};
  }));
  await assert.rejects(load(basis, {load: remember}), {message: /^model\.sweep: its scene cannot be shown: .*setKTX2Loader/});
  assert.throws(() => faces[0].names, /disposed of/);
});

test('files beside the scene are looked for beside the file', options, async () => {
  const {SweepfaceSceneLoader} = await import('../sweepface_scene.js'), {fetch} = globalThis, asked = [];
  const apart = readFileSync(changed((json) => json.images[0] = {uri: 'skin.png'}));
  const manager = new three.LoadingManager().setURLModifier((url) => {
    if (url.endsWith('.png')) asked.push(url);
    return url;
  });
  globalThis.fetch = async () => new Response(apart);
  try {
    for (const [path, url] of [['http://a/models/', 'one.sweep'], ['', 'http://a/models/two.sweep?secret']]) {
      const loader = new SweepfaceSceneLoader(manager, {name: 'Anna'}).setPath(path);
      await inSilence(() => loader.loadAsync(url));
    }
    await inSilence(() => new SweepfaceSceneLoader(manager).setResourcePath('http://b/').loadAsync('http://a/three.sweep'));
  } finally {
    globalThis.fetch = fetch;
  }
  assert.deepEqual(asked, ['http://a/models/skin.png', 'http://a/models/skin.png', 'http://b/skin.png']);
});

test('a loader that is aborted hands over no scene, and frees it', options, async () => {
  const {SweepfaceSceneLoader} = await import('../sweepface_scene.js'), {Sweepface} = await import('../sweepface.js');
  const {fetch} = globalThis, faces = [], loader = new SweepfaceSceneLoader(undefined, {load: async (...given) => {
    faces.push(await Sweepface.load(...given));
    loader.abort();  // when the bytes are there
    return faces[0];
  }});
  globalThis.fetch = async () => new Response(bytes);
  try {
    await inSilence(() => assert.rejects(loader.loadAsync('http://a/model.sweep'), {name: 'AbortError'}));
  } finally {
    globalThis.fetch = fetch;
  }
  assert.throws(() => faces[0].names, /disposed of/);
});

test('what has no scene says so', options, async () => {
  const told = {message: /^model\.sweep holds no scene, .*; load it by SweepfaceLoader\.$/};
  const folder = newFolder(), obj = join(folder, 'plain.obj'), plain = join(folder, 'plain.sweep');
  execFileSync(tool, ['export', file, '-o', obj, '--quiet']);
  execFileSync(tool, ['convert', obj, '-o', plain, '--pack', '--quiet']);
  await assert.rejects(load(readFileSync(plain)), told);
  await assert.rejects(load(readFileSync(converted(model(), '--bare'))), told);
});

test('files that are not packed have scenes, too', options, async () => {
  const loose = join(newFolder(), 'loose.sweep'), glb = join(newFolder(), 'model.glb');
  execFileSync(tool, ['export', file, '-o', glb, '--quiet']);
  execFileSync(tool, ['convert', glb, '-o', loose, '--tolerance', '0.002', '--quiet'], {stdio: 'ignore'});
  assert.deepEqual((await load(readFileSync(loose))).face.weights, {jawOpen: 0.25, smile: 0, look: 0});
});

test('expressions that were taken out move nothing', options, async () => {
  const fewer = join(newFolder(), 'fewer.sweep'), drawing = join(newFolder(), 'fewer.wire.json');
  execFileSync(tool, ['wireframe', file, '-o', drawing, '--quiet']);
  const drawn = JSON.parse(readFileSync(drawing));
  writeFileSync(drawing, JSON.stringify({...drawn, expressions: drawn.expressions.filter(({name}) => name !== 'smile')}));
  execFileSync(tool, ['build', drawing, '--source', file, '-o', fewer, '--quiet']);
  const {face} = await load(readFileSync(fewer)), [lips] = face.meshes;
  assert.deepEqual(face.names, ['jawOpen', 'look']);
  lips.morphTargetInfluences[1] = 1;
  assert.equal(face.update(), false);
  face.setWeights({jawOpen: 1});
  assert.deepEqual(lips.morphTargetInfluences, [1, 1]);
});

test('names of targets may be those of a primitive', options, async () => {
  const {face} = await load(readFileSync(changed((json) => {
    json.meshes[1].primitives[0].extras = {targetNames: ['blink']};
    json.meshes[0].primitives[0].extras = {targetNames: ['not', 'these']};
    delete json.meshes[1].extras;
  })));
  assert.deepEqual(face.names, ['jawOpen', 'smile', 'blink']);
  face.setWeights({blink: 1, smile: 0.5});
  assert.deepEqual(face.meshes.map(({morphTargetInfluences}) => morphTargetInfluences), [[0.25, 0.5], [0.25, 0.5], [1], [1]]);
});

test('targets without names are called as the tool calls them', options, async () => {
  const space = await load(readFileSync(changed((json) => json.meshes[0].extras.targetNames = ['\u3000', 'smile'])));
  assert.deepEqual(space.face.weights, {'\u3000': 0.25, smile: 0, look: 0});  // a blank of this kind is a name
  const {face} = await load(readFileSync(changed((json) => {
    json.meshes[0].extras.targetNames = ['target_1', ' '];
    delete json.meshes[1].extras;
  }))), [lips, , eye] = face.meshes;
  assert.deepEqual(face.names, ['target_1', 'target_2', 'target_0']);
  face.setWeights({target_2: 0.5, target_0: 1});
  assert.deepEqual([lips.morphTargetInfluences, eye.morphTargetInfluences], [[0.25, 0.5], [1]]);
});

test('a scene without expressions is the face as it stands', options, async () => {
  const {binary, json} = model();
  delete json.animations;
  for (const mesh of json.meshes) {
    delete mesh.weights;
    delete mesh.extras;
    for (const primitive of mesh.primitives) delete primitive.targets;
  }
  delete json.nodes[4].weights;
  const {face} = await load(readFileSync(converted({binary, json})));
  assert.deepEqual([face.names, face.meshes.length, face.update()], [[], 5, false]);  // the hat is part of it, too
});

test('what else the file holds does not take the memory that faces work in', options, async () => {
  const {Sweepface} = await import('../sweepface.js');
  const large = readFileSync(converted(model(8e6)));
  const [plain, heavy] = [await Sweepface.load(bytes), await Sweepface.load(large)];
  assert.equal(heavy.memoryBytes, plain.memoryBytes);
  assert.deepEqual((await load(large)).face.names, plain.names);
});

/** A file in which the scene is another text. */
function withScene(text) {
  const at = bytes.indexOf('scen'), end = at + 12 + bytes.readUInt32LE(at + 4), length = [];
  for (let left = text.length; length.length === 0 || left > 0; left = Math.floor(left / 128))
    length.push(left % 128 + (left > 127 ? 128 : 0));
  const body = Buffer.from([...Buffer.from('scen'), ...length, ...text]), head = Buffer.alloc(12);
  head.write('scen');
  head.writeUInt32LE(body.length - 4, 4);
  head.writeUInt32LE(crc32(body), 8);
  return Buffer.concat([bytes.subarray(0, at), head, body.subarray(4), bytes.subarray(end)]);
}

test('a damaged scene says so, and its face is freed', {...options, timeout: 60_000}, async () => {
  const numbers = (...list) => Buffer.from(Uint32Array.from(list).buffer);
  const planes = (...parts) => [1, ...deflateSync(Buffer.concat(parts.map((part) => Buffer.from(part))))];
  const glbOf = (json) => [...Buffer.from('glTF'), ...numbers(2, 20 + json.length, json.length, 0x4e4f534a), ...Buffer.from(json)];
  const told = {message: 'model.sweep: its scene is damaged; convert the source again.'};
  const glb = Buffer.from(glbOf('{"scenes": [{}]}  '));
  const fine = planes(numbers(1, 0, 1, 4), [0], glb);  // as the others, without a fault
  await assert.rejects(load(withScene(fine)), {message: /^model\.sweep: the face and its scene do not fit/});
  for (const text of [[], [120, 156, 1], [...deflateSync(Buffer.from('no GLB'))], [...deflateSync(Buffer.alloc(1e7))],
                      planes(numbers(7)), planes(numbers(1, 0, 0xffffffff, 0)), planes(numbers(1, 9, 1, 1), Buffer.from([0, 1, 2])),
                      planes(numbers(1, 0, 1, 4), Buffer.from([2]), glb),
                      planes(numbers(2, 4, 1, 4), [0], numbers(0, 1, 4), [0], glb),
                      planes(numbers(1, 0, 1, glb.length + 1), [0], glb), [...Buffer.from('glTF and no more')],
                      glbOf('{"a"'), glbOf('{"meshes": [1], "scenes": [{}]}')])
    await assert.rejects(load(withScene(text)), told, String(text));
  const flipped = Buffer.from(bytes);
  flipped[flipped.indexOf('scen') + 40] ^= 1;
  await assert.rejects(load(flipped), {message: /the checksum of chunk 'scen' does not match/});
});

test('the scene can be looked at beforehand', options, async () => {
  const {sceneJson} = await import('../sweepface_scene.js');
  assert.deepEqual((await sceneJson(bytes)).materials.map(({name}) => name), ['skin', 'lips', 'felt']);
  assert.equal(await sceneJson(readFileSync(converted(model(), '--bare'))), null);
  assert.equal(await sceneJson(new Uint8Array(3)), null);
  await assert.rejects(sceneJson('model.sweep'), {message: /^sceneJson needs the bytes/});
});

test('a browser that cannot decompress says so', options, async () => {
  const {DecompressionStream} = globalThis;
  delete globalThis.DecompressionStream;
  try {
    await assert.rejects(load(), {message: /^model\.sweep: its scene cannot be read here, .*; use a newer browser\.$/});
  } finally {
    globalThis.DecompressionStream = DecompressionStream;
  }
});

test('a scene with more or fewer triangles than its face is refused', options, async () => {
  const {text} = parted(bytes), length = inflateSync(text.subarray(text[0] === 1 ? 1 : 0)).length;
  const {sceneJson} = await import('../sweepface_scene.js'), json = await sceneJson(bytes);
  for (const more of [-3, 3]) {
    const other = structuredClone(json), {indices} = other.meshes[0].primitives[1];
    other.accessors[indices].count += more;
    await assert.rejects(load(withScene([...new Uint8Array(formatGlb({json: other, binary: new Uint8Array(length)}))])),
                         {message: 'model.sweep: the face and its scene do not fit; convert the source again.'});
  }
});

test('nodes in long chains take no long time, and none go in circles', {...options, timeout: 20_000}, async () => {
  const {partsOf} = await import('../sweepface_scene_parts.js'), count = 50_000;
  const chain = Array.from({length: count}, (_, k) => (k + 1 < count ? {children: [k + 1]} : {mesh: 0, translation: [1, 2, 3]}));
  const meshes = [{primitives: [{attributes: {POSITION: 0}}]}];
  const json = {nodes: chain, scenes: [{nodes: [0]}], accessors: [{count: 3}], meshes};
  assert.deepEqual(partsOf(json).parts[0].run.world.slice(12, 15), [1, 2, 3]);
  for (const nodes of [[{children: [1]}, {children: [0]}], [{children: [2]}, {children: [2]}, {}], [{children: [0]}]])
    assert.throws(() => partsOf({...json, nodes}), RangeError);
});

test('a scene of another face is refused', options, async () => {
  const other = readFileSync(converted((() => {
    const made = model();
    made.json.meshes[0].primitives.pop();
    made.json.nodes.splice(3, 2);
    made.json.scenes[0].nodes = [0, 1, 3];
    made.json.meshes.splice(1, 1);
    made.json.nodes[3].mesh = 1;
    return made;
  })()));
  const at = other.indexOf('scen'), text = other.subarray(at + 12, at + 12 + other.readUInt32LE(at + 4));
  const plain = text.subarray(text.findIndex((byte) => byte < 128) + 1);
  await assert.rejects(load(withScene([...plain])), {message: /fit; convert the source again\.$/});
});

/** The materials and geometries of a scene that are disposed of from now on. */
function watch({scene}) {
  const gone = new Set();
  scene.traverse(({geometry, material}) => {
    for (const each of [geometry, material]) each?.addEventListener('dispose', () => gone.add(each));
  });
  return gone;
}

test('disposing of a face frees what the scene holds', options, async () => {
  const model = await load(), {face} = model, gone = watch(model);
  face.dispose();
  assert.equal(gone.size, 4 + 3);  // geometries, of which two nodes share one, and materials
  assert.equal(face.update(), false);
  assert.throws(() => face.setWeights({jawOpen: 1}), /disposed of/);
});

test('a clone moves by itself, and shares what does not move', options, async () => {
  const {cloneScene} = await import('../sweepface_scene.js');
  const model = await load(), {face, scene} = model;
  face.meshes[0].morphTargetInfluences[1] = 0.5;  // which counts, though it has not been shown
  const twin = cloneScene(model), [lips] = face.meshes, [others] = twin.face.meshes;
  const still = lips.geometry.attributes.position.array.slice();
  assert.deepEqual(twin.face.weights, {jawOpen: 0.25, smile: 0.5, look: 0});
  assert.deepEqual(others.morphTargetInfluences, [0.25, 0.5]);
  twin.face.setWeights({jawOpen: 1});
  twin.face.update();
  assert.deepEqual(lips.geometry.attributes.position.array, still);
  face.setWeights({jawOpen: 1});
  face.update();
  for (const [k, mesh] of face.meshes.entries()) {
    const other = twin.face.meshes[k];
    assert.deepEqual(placesOf(mesh), placesOf(other));
    assert.deepEqual(mesh.geometry.attributes.normal.array, other.geometry.attributes.normal.array);
  }
  assert.equal(others.material, lips.material);
  assert.equal(twin.scene.getObjectByName('hat').geometry, scene.getObjectByName('hat').geometry);
  assert.notEqual(others.skeleton.bones[0], lips.skeleton.bones[0]);
  const mixer = new three.AnimationMixer(twin.scene);
  mixer.clipAction(twin.animations[0]).play();
  mixer.update(0.5);
  twin.face.update();
  assert.deepEqual([twin.face.weights.jawOpen, face.weights.jawOpen], [0.5, 1]);
  const gone = [watch(model), watch(twin)];
  face.dispose();
  assert.deepEqual(gone.map(({size}) => size), [3, 0]);  // the head's geometries and the eye's
  assert.equal(cloneScene(twin).face.weights.jawOpen, 0.5);
  assert.throws(() => cloneScene(), {message: /^cloneScene takes/});
  assert.throws(() => cloneScene({face: three}), {message: /^cloneScene takes what a SweepfaceSceneLoader loaded/});
});

test('a clone has the weights of every region', options, async () => {
  const {cloneScene} = await import('../sweepface_scene.js');
  const model = await load(bytes, {regions: [{name: 'chin', points: [[0, -0.5, 0.8]], whole: 0.3, fade: 0.4}]});
  model.face.setWeights({jawOpen: 1}, 'chin');
  const twin = cloneScene(model).face;
  assert.deepEqual([twin.weightsIn('rest').jawOpen, twin.weightsIn('chin').jawOpen], [0.25, 1]);
});

test('textures and skeletons are freed, of several scenes, too, but not what the application added', options, async () => {
  const {cloneScene} = await import('../sweepface_scene.js');
  const twoScenes = readFileSync(changed((json) => {
    json.scenes.push({nodes: [5]});
    json.scenes[0].nodes.pop();
  }));
  const model = await load(twoScenes), {face, scene, scenes} = model, {skeleton, material} = face.meshes[0], gone = [];
  const hat = scenes[1].getObjectByName('hat'), added = new three.Mesh(new three.BufferGeometry(), new three.Material());
  const map = material.map = new three.Texture(), late = cloneScene(model);
  scene.add(added);
  skeleton.computeBoneTexture();
  for (const [name, each] of Object.entries({map, bones: skeleton.boneTexture, felt: hat.material, added: added.material}))
    each.addEventListener('dispose', () => gone.push(name));
  face.dispose();
  assert.deepEqual(gone, ['bones']);
  late.face.dispose();
  late.face.dispose();
  assert.deepEqual(gone.sort(), ['bones', 'felt']);  // the map came after the scene was loaded
});

test('what is shared goes with the last clone', options, async () => {
  const {cloneScene} = await import('../sweepface_scene.js');
  const model = await load(), twin = cloneScene(model), gone = watch(twin);
  model.face.dispose();
  assert.equal(gone.size, 0);
  twin.face.dispose();
  assert.equal(gone.size, 4 + 3);
});

const inBrowser = {skip: options.skip || skip, timeout: 120_000};
test('a scene is loaded by its address, and pictures show its textures', inBrowser, async () => {
  const script = `<!doctype html><link rel="icon" href="data:,"><canvas id="view" width="64" height="64"></canvas>
    <script type="importmap">{"imports": {
      "three": "./node_modules/three/build/three.module.js", "three/addons/": "./node_modules/three/examples/jsm/"}}</script>
    <script type="module">
      import {AmbientLight, DirectionalLight, PerspectiveCamera, Scene, WebGLRenderer} from 'three';
      import {SweepfaceSceneLoader} from './sweepface_scene.js';
      const renderer = new WebGLRenderer({canvas: document.getElementById('view'), preserveDrawingBuffer: true});
      const camera = new PerspectiveCamera(30, 1, 0.1, 100), scene = new Scene();
      scene.add(new AmbientLight(0xffffff, 1), new DirectionalLight(0xffffff, 2));  // from above
      camera.position.set(0, 0, 6);
      const {face, scene: model} = await new SweepfaceSceneLoader().loadAsync('model.sweep');
      scene.add(model);
      const shoot = () => {
        renderer.render(scene, camera);
        const gl = renderer.getContext(), pixels = new Uint8Array(4 * 64 * 64);
        gl.readPixels(0, 0, 64, 64, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return Array.from(pixels);
      };
      globalThis.pictures = [shoot(), (face.setWeights({jawOpen: 1.5}), face.update(), shoot())];
    </script>`;
  await withPage('scene.html', {files: {'scene.html': script, 'model.sweep': bytes}}, async (page, complaints) => {
    await page.waitForFunction(() => globalThis.pictures);
    const [before, after] = await page.evaluate(() => globalThis.pictures);
    const at = (picture, x, y) => picture.slice(4 * (64 * y + x), 4 * (64 * y + x) + 3);
    const [red, green, blue] = at(before, 32, 28);
    assert.ok(red > green + 20 && green > blue + 20, `${red} ${green} ${blue}`);  // the texture's one colour
    assert.ok(before.filter((value, k) => value !== after[k]).length > 200);
    assert.deepEqual(complaints, []);
  });
});
