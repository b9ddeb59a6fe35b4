import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {deflateSync} from 'node:zlib';
import {skip, withPage} from './browser.js';
import {newFolder, tool} from './native.js';
import {converted, model} from './scene_file.js';
import {assertTellsWhetherToDraw} from './updates.js';

const three = await import('three').catch(() => undefined);
const options = {skip: three ? false : 'three is not installed; try npm ci'};
globalThis.self ??= globalThis;  // as GLTFLoader expects it

const file = three && converted(model()), bytes = three && readFileSync(file);

/** What a loader of scenes makes of a file. */
async function load(given = bytes, settings = {}) {
  const {SweepfaceSceneLoader} = await import('../sweepface_scene.js');
  return inSilence(() => new SweepfaceSceneLoader().parseAsync(given, {name: 'model.sweep', ...settings}));
}

/** Node has no images: three.js complains about each. */
async function inSilence(act) {
  const {error} = console;
  console.error = () => {};
  try {
    return await act();
  } finally {
    console.error = error;
  }
}

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

/** The quads' halves may be cut along the other diagonal: the vertices around which triangles lie, and which way. */
function areaOf({geometry: {index, attributes: {position}}}) {
  const sum = new three.Vector3(), at = (k) => new three.Vector3().fromBufferAttribute(position, index.getX(k));
  for (let k = 0; k < index.count; k += 3) sum.add(at(k + 1).sub(at(k)).cross(at(k + 2).sub(at(k))));
  return sum;
}

test('a scene has all that the file had, and the face stands where an exported one does', options, async () => {
  const {face, scene, ...rest} = await load(), truth = await exportedScene(file);
  const mine = meshesOf({scene, ...rest}), theirs = meshesOf(truth);
  assert.deepEqual([...mine.keys()], [...theirs.keys()]);
  assert.deepEqual(face.names, ['jawOpen', 'smile', 'look']);
  assert.deepEqual([...mine.values()].map(({material}) => material.name), ['lips', 'skin', 'skin', 'skin', 'felt']);
  for (const weights of [{jawOpen: 0, smile: 0, look: 0}, {jawOpen: 0.8, smile: -0.3, look: 1}]) {
    face.setWeights(weights);
    face.update();
    for (const [name, mesh] of mine) {
      const other = theirs.get(name);
      for (const [target, k] of Object.entries(other.morphTargetDictionary ?? {})) other.morphTargetInfluences[k] = weights[target];
      assert.ok(furthest(placesOf(mesh), placesOf(other)) < 0.004, `${name} ${furthest(placesOf(mesh), placesOf(other))}`);
      assert.deepEqual(Object.keys(mesh.geometry.attributes).sort(), Object.keys(other.geometry.attributes).sort());
      assert.equal(mesh.geometry.index.count, other.geometry.index.count);
      const {uv, skinWeight} = other.geometry.attributes;
      assert.deepEqual(mesh.geometry.attributes.uv.array, uv.array);
      assert.deepEqual(mesh.geometry.attributes.skinWeight?.array, skinWeight?.array);
    }
  }
  face.reset();
  face.update();
  for (const [name, mesh] of mine) {
    const {normal} = mesh.geometry.attributes, other = theirs.get(name).geometry.attributes.normal;
    for (let v = 0; v < normal.count; ++v) {
      const [a, b] = [normal, other].map((list) => new three.Vector3().fromBufferAttribute(list, v));
      assert.ok(a.angleTo(b) < 0.02, `${name} ${v}`);
    }
    assert.ok(areaOf(mesh).angleTo(areaOf(theirs.get(name))) < 0.02, name);  // the mirrored eye's, too
  }
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

test('bounds are those of the expression', options, async () => {
  const {face} = await load(), [lips] = face.meshes, {geometry} = lips;
  const sphere = () => geometry.boundingSphere.clone(), wide = new three.Box3();
  geometry.computeBoundingBox();
  const before = sphere(), box = geometry.boundingBox.clone();
  face.setWeights({jawOpen: 3});
  face.update();
  assert.ok(sphere().radius > before.radius);
  assert.ok(geometry.boundingBox.min.y < box.min.y);
  wide.setFromBufferAttribute(geometry.attributes.position);
  assert.deepEqual(geometry.boundingBox, wide);
});

test('a mesh whose geometry was replaced says so', options, async () => {
  const {face} = await load(), [lips] = face.meshes;
  lips.geometry = lips.geometry.clone();
  face.setWeights({smile: 1});
  assert.throws(() => face.update(), {message: /^The mesh 'head_1' must keep the geometry/});
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
    await assert.rejects(load(bytes, detail), {message: /^The meshes of a scene have the vertices of their source; leave out lod/});
  assert.ok((await load(bytes, {lod: 0})).face.meshes.length > 0);
  await assert.rejects(load(bytes, {mesh: three.Mesh}), /has no option 'mesh'/);
  await assert.rejects(load('model.sweep'), {message: /^Sweepface\.load needs the bytes/});
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

test('targets without names are called as the tool calls them', options, async () => {
  const {binary, json} = model();
  json.meshes[0].extras.targetNames = ['target_1', ' '];
  delete json.meshes[1].extras;
  const {face} = await load(readFileSync(converted({binary, json}))), [lips, , eye] = face.meshes;
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
  for (let left = text.length; length.length === 0 || left > 0; left = Math.floor(left / 128)) length.push(left % 128 + (left > 127 ? 128 : 0));
  const body = Buffer.from([...Buffer.from('scen'), ...length, ...text]), head = Buffer.alloc(12);
  let crc = -1;
  for (const byte of body) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  head.write('scen');
  head.writeUInt32LE(body.length - 4, 4);
  head.writeInt32LE(~crc, 8);
  return Buffer.concat([bytes.subarray(0, at), head, body.subarray(4), bytes.subarray(end)]);
}

test('a damaged scene says so, and its face is freed', {...options, timeout: 60_000}, async () => {
  const numbers = (...list) => Buffer.from(Uint32Array.from(list).buffer), planes = (...parts) => [1, ...deflateSync(Buffer.concat(parts))];
  const glbOf = (json) => [...Buffer.from('glTF'), ...numbers(2, 20 + json.length, json.length, 0x4e4f534a), ...Buffer.from(json)];
  const told = {message: 'model.sweep: its scene is damaged; convert the source again.'};
  for (const text of [[], [120, 156, 1], [...deflateSync(Buffer.from('no GLB'))], [...deflateSync(Buffer.alloc(1e7))], planes(numbers(7)),
                      planes(numbers(1, 0, 0xffffffff, 0)), planes(numbers(1, 9, 1, 1), Buffer.from([0, 1, 2])), [...Buffer.from('glTF and no more')],
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
  for (const [k, mesh] of face.meshes.entries())
    assert.deepEqual(placesOf(mesh), placesOf(twin.face.meshes[k]));
  assert.ok(others.material === lips.material && twin.scene.getObjectByName('hat').geometry === scene.getObjectByName('hat').geometry);
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
  assert.throws(() => cloneScene({face: three}), {message: /^cloneScene takes what a SweepfaceSceneLoader loaded/});
});

test('what is shared goes with the last clone', options, async () => {
  const {cloneScene} = await import('../sweepface_scene.js');
  const model = await load(), twin = cloneScene(model), gone = watch(twin);
  model.face.dispose();
  assert.equal(gone.size, 0);
  twin.face.dispose();
  assert.equal(gone.size, 4 + 3);
});

test('a scene is loaded by its address, and pictures show its textures', {skip: options.skip || skip, timeout: 120_000}, async () => {
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
