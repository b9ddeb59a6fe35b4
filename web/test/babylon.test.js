import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {skip as noBrowser, withPage} from './browser.js';
import {difference, played, sample} from './native.js';
import {assertTellsWhetherToDraw} from './updates.js';

const core = '@babylonjs/core';
const {NullEngine} = await import(`${core}/Engines/nullEngine.js`).catch(() => ({}));
const options = {skip: NullEngine ? false : `${core} is not installed; try npm ci`};

const kinds = {position: 'position', normal: 'normal', uv: 'uv'};  // as Babylon.js names attributes

/** A scene whose frames take 16 ms, with the sample face. */
async function load({rightHanded = true, ...more} = {}) {
  const {Scene} = await import(`${core}/scene.js`), {FreeCamera} = await import(`${core}/Cameras/freeCamera.js`);
  const {Vector3} = await import(`${core}/Maths/math.vector.js`);
  const {SweepfaceMesh} = await import('../sweepface_babylon.js');
  const scene = new Scene(new NullEngine());
  scene.useRightHandedSystem = rightHanded;
  scene.useConstantAnimationDeltaTime = true;
  new FreeCamera('camera', new Vector3(0, 0, 60), scene);
  return {scene, SweepfaceMesh, mesh: await SweepfaceMesh.load(readFileSync(sample), scene, more)};
}

const positionsOf = (mesh) => mesh.getVerticesData(kinds.position).slice();

function assertShows(mesh) {
  const native = played(sample, mesh.weights, 0);
  assert.ok(difference(native.positions, mesh.getVerticesData(kinds.position)).most <= native.error);
  assert.ok(difference(native.normals, mesh.getVerticesData(kinds.normal)).most <= 2e-3);
}

test('a mesh follows its weights when the scene is rendered', options, async () => {
  const {scene, mesh} = await load();
  assertShows(mesh);
  const neutral = positionsOf(mesh), {maximum} = mesh.getBoundingInfo();
  mesh.setWeights({jawOpen: 0.7, browInnerUp: 1});
  assert.deepEqual(positionsOf(mesh), neutral);
  scene.render();
  assertShows(mesh);
  assert.notDeepEqual(mesh.getBoundingInfo().minimum, maximum);
  mesh.reset();
  scene.render();
  assert.deepEqual(positionsOf(mesh), neutral);
});

test('forces move it as the scene lets time pass', options, async (context) => {
  const {scene, mesh} = await load();
  let now = performance.now();
  context.mock.method(performance, 'now', () => now);
  const isAt = (seconds) => Math.abs(mesh.weights.jawOpen - (seconds / 0.16) ** 2) < 1e-9;
  mesh.moveTo({jawOpen: 1}, {kind: 'newton', seconds: 0.16});
  for (let k = 0; k < 5; ++k) scene.render();
  assert.ok(isAt(0.08));
  assertShows(mesh);
  scene.animationsEnabled = false;
  scene.render();
  assert.ok(isAt(0.08));
  scene.animationsEnabled = true;
  scene.animationTimeScale = 3;
  scene.render();
  assert.ok(isAt(0.096), 'as in Babylon.js, frames of constant time are not scaled');
  scene.useConstantAnimationDeltaTime = false;
  for (const passed of [0, 5, 3]) {  // frames, however many there are, take the time that they take
    now += passed;
    scene.render();
  }
  assert.ok(isAt(0.12));
  now += 4;
  scene.render(true, true);
  assert.ok(isAt(0.12), 'the frame ignores animations');
  mesh.advancesWithScene = false;
  scene.render();
  assert.ok(isAt(0.12));
  mesh.push('browInnerUp', 1, 4);
  assert.equal(mesh.advance(0.1), true);
  assert.ok(mesh.weights.browInnerUp > 0.05);
});

test('in lockstep it moves by the steps of the scene', options, async () => {
  const {scene, mesh} = await load(), engine = scene.getEngine();
  Object.assign(engine, {isDeterministicLockStep: () => true, getTimeStep: () => 10, getLockstepMaxSteps: () => 4});
  engine.getDeltaTime = () => 25;
  mesh.moveTo({jawOpen: 1}, {kind: 'newton', seconds: 0.1});
  scene.render();
  assert.ok(Math.abs(mesh.weights.jawOpen - 0.2 ** 2) < 1e-9);
});

test('an update tells whether there is something to draw', options, async () => {
  assertTellsWhetherToDraw((await load()).mesh);
});

test('its box and those of its parts contain the face as it stands', options, async () => {
  const {scene, mesh} = await load({rightHanded: false});
  mesh.setWeights({jawOpen: 20});
  mesh.position.x = 100;
  scene.render();
  const [mine, ...parts] = [mesh, ...mesh.subMeshes].map((each) => each.getBoundingInfo());
  const {minimum, maximum, boundingBox} = mine;
  mesh.refreshBoundingInfo();
  assert.deepEqual([minimum, maximum], [mesh.getBoundingInfo().minimum, mesh.getBoundingInfo().maximum]);
  assert.ok(Math.abs(boundingBox.centerWorld.x - 100) < 1);
  for (const part of parts) assert.ok(part.boundingBox.minimumWorld.x > 80);
  mine.reConstruct(minimum.scale(100), maximum.scale(100));
  mine.isLocked = true;
  mesh.reset();
  scene.render();
  assert.ok(mesh.getBoundingInfo().maximum.x > 100);
});

test('materials that it made go with the last mesh that shows them', options, async () => {
  const {scene, mesh, SweepfaceMesh} = await load(), {StandardMaterial} = await import(`${core}/Materials/standardMaterial.js`);
  const count = () => scene.materials.length + scene.multiMaterials.length, all = count();
  const twin = mesh.clone();
  mesh.dispose();
  assert.equal(count(), all);
  twin.dispose();
  assert.equal(count(), 0);
  const mine = new StandardMaterial('mine', scene), face = (await load()).mesh.face.clone();
  new SweepfaceMesh('face', scene, face, mine).dispose();
  assert.deepEqual(scene.materials, [mine]);
});

test('a material that it made stays while another has it as a part', options, async () => {
  const {scene, mesh} = await load(), {MultiMaterial} = await import(`${core}/Materials/multiMaterial.js`);
  const [skin] = mesh.material.subMaterials, other = new MultiMaterial('other', scene);
  other.subMaterials = [skin];
  mesh.dispose();
  assert.deepEqual(scene.materials, [skin]);
});

test('a scene is not ready before the face is there', options, async () => {
  const {scene, SweepfaceMesh} = await load();
  const loading = SweepfaceMesh.load(readFileSync(sample), scene);
  assert.equal(scene.isLoading, true);
  await loading;
  assert.equal(scene.isLoading, false);
  await assert.rejects(SweepfaceMesh.load(new Uint8Array(3), scene));
  assert.equal(scene.isLoading, false);
});

test('something else may load the face', options, async () => {
  const {scene, SweepfaceMesh} = await load(), {Sweepface} = await import('../sweepface.js'), given = [];
  const mesh = await SweepfaceMesh.load(readFileSync(sample), scene, {lod: 2, load: (...all) => {
    given.push(all[1]);
    return Sweepface.load(...all);
  }});
  assert.deepEqual([given, mesh.face.lod], [[{lod: 2}], 2]);
});

test('a still face is not evaluated again', options, async () => {
  const {scene, mesh} = await load();
  let count = 0;
  const {face} = mesh, evaluate = face.evaluate.bind(face);
  face.evaluate = (...given) => { ++count; evaluate(...given); };
  for (let k = 0; k < 3; ++k) scene.render();
  assert.equal(count, 0);
  mesh.moveTo({jawOpen: 1}, {kind: 'newton', seconds: 0.05});
  for (let k = 0; k < 20; ++k) scene.render();
  assert.ok(count >= 4 && count < 10, `${count} times`);
});

test('left-handed scenes see the mirror image, with triangles the other way around', options, async () => {
  const {mesh: right} = await load(), {mesh: left} = await load({rightHanded: false});
  const a = positionsOf(right), b = positionsOf(left);
  assert.ok(a.every((value, k) => value === (k % 3 === 0 ? -b[k] : b[k])));
  const ways = [right, left].map((mesh) => [...mesh.getIndices().slice(0, 3)]);
  assert.deepEqual(ways[0], [ways[1][0], ways[1][2], ways[1][1]]);
});

test('each part of the face has a material', options, async () => {
  const {mesh} = await load(), {face: {parts}} = mesh;
  assert.deepEqual(mesh.material.subMaterials.map(({name}) => name), parts.map(({material}) => material));
  assert.deepEqual(mesh.subMeshes.map(({indexStart, indexCount, materialIndex}) => [indexStart, indexCount, materialIndex]),
                   parts.map(({start, count}, k) => [start, count, k]));
  assert.equal(mesh.getVerticesData(kinds.uv).length, 2 * mesh.face.vertexCount);
});

test('clones move by themselves and share the material', options, async () => {
  const {scene, mesh, SweepfaceMesh} = await load();
  mesh.setWeights({jawOpen: 0.5});
  mesh.position.set(1, 2, 3);
  const twin = mesh.clone('twin');
  assert.ok(twin instanceof SweepfaceMesh);
  assert.deepEqual([twin.name, twin.weights.jawOpen, twin.position.y], ['twin', 0.5, 2]);
  assert.equal(twin.material, mesh.material);
  twin.setWeights({jawOpen: 1});
  scene.render();
  assert.equal(mesh.weights.jawOpen, 0.5);
  assertShows(mesh);
  assertShows(twin);
  mesh.dispose();
  twin.setWeights({jawOpen: 0.25});
  scene.render();
  assertShows(twin);
});

test('clones are like those of other meshes', options, async () => {
  const {scene, mesh} = await load(), {Mesh} = await import(`${core}/Meshes/mesh.js`);
  const {Quaternion, Vector3} = await import(`${core}/Maths/math.vector.js`);
  const head = new Mesh('head', scene), hat = new Mesh('hat', scene);
  mesh.parent = head;
  hat.parent = mesh;
  const own = {receiveShadows: true, isPickable: false, renderingGroupId: 2, advancesWithScene: false, isVisible: false,
               visibility: 0.5, layerMask: 3, alphaIndex: 7, billboardMode: 2, checkCollisions: true,
               alwaysSelectAsActiveMesh: true, metadata: {mine: 1}};
  Object.assign(mesh, own);
  mesh.rotation.set(0.1, 0.2, 0.3);
  mesh.scaling.set(1, 2, 3);
  mesh.setPivotPoint(new Vector3(1, 2, 3));
  mesh.setEnabled(false);
  const twin = mesh.clone('twin'), bald = mesh.clone('bald', null, true);
  assert.deepEqual([twin, bald].map(({parent}) => parent), [head, head]);
  assert.deepEqual([twin, bald].map((clone) => clone.getChildren().map(({name}) => name)), [['twin.hat'], []]);
  assert.deepEqual(Object.fromEntries(Object.keys(own).map((key) => [key, twin[key]])), own);
  assert.deepEqual([twin.rotation.asArray(), twin.scaling.asArray()], [[0.1, 0.2, 0.3], [1, 2, 3]]);
  assert.deepEqual(twin.getPivotPoint().asArray(), [1, 2, 3]);
  assert.equal(twin.isEnabled(false), false);
  mesh.rotationQuaternion = Quaternion.FromEulerAngles(0.1, 0.2, 0.3);
  const turned = mesh.clone('turned').rotationQuaternion;
  assert.ok(turned !== mesh.rotationQuaternion && turned.equals(mesh.rotationQuaternion));
  for (const face of head.getChildren().slice(1)) face.dispose();
  const [face] = head.clone('other').getChildren();
  assert.equal(face.getClassName(), 'SweepfaceMesh');
  assert.equal(face.getChildren().length, 1);
  assert.equal(mesh.clone('plain', {doNotCloneChildren: true}).getChildren().length, 0);
  scene.render();
});

test('weights that are set right before a frame are in it', options, async () => {
  const {scene, mesh} = await load();
  scene.onBeforeRenderObservable.add(() => mesh.setWeights({jawOpen: 1}));
  scene.render();
  assertShows(mesh);
});

test('cuts show at once, also where time stands still', options, async () => {
  const {scene, mesh} = await load();
  scene.animationsEnabled = false;
  mesh.moveTo({jawOpen: 1}, 'cut');
  mesh.moveTo({browInnerUp: 1}, {kind: 'spring', frequency: 2});
  scene.render();
  assert.deepEqual([mesh.weights.jawOpen, mesh.weights.browInnerUp], [1, 0]);
  assertShows(mesh);
  assert.ok(mesh.advance(0.1));
});

test('a mesh makes ready to move', options, async () => {
  const {mesh} = await load(), before = mesh.face.memoryBytes;
  mesh.prepare();
  assert.ok(mesh.face.memoryBytes > before);
});

test('a geometry of other vertices is refused with a sentence', options, async () => {
  const {scene, mesh} = await load();
  mesh.convertToFlatShadedMesh();
  mesh.setWeights({jawOpen: 1});
  for (let frame = 0; frame < 2; ++frame)
    assert.throws(() => scene.render(), /^Error: The geometry must have the \d+ vertices of the face/);
});

test('what is no scene is refused with a sentence', options, async () => {
  const {scene, mesh, SweepfaceMesh} = await load();
  await assert.rejects(SweepfaceMesh.load(readFileSync(sample), {lod: 2}), /^TypeError: A mesh takes the scene/);
  assert.throws(() => new SweepfaceMesh('face', {lod: 2}, mesh.face), /^TypeError: A mesh takes the scene/);
  assert.equal(scene.meshes.length, 1);
  const {EngineStore} = await import(`${core}/Engines/engineStore.js`);
  for (const {scenes} of EngineStore.Instances) for (const each of [...scenes]) each.dispose();
  await assert.rejects(SweepfaceMesh.load(readFileSync(sample)), /^TypeError: A mesh takes the scene/);
});

test('a face goes if no mesh can be made of it, and leaves none behind', options, async () => {
  const {scene, mesh, SweepfaceMesh} = await load();
  mesh.dispose();
  assert.throws(() => new SweepfaceMesh('face', scene, mesh.face), /disposed of/);
  assert.equal(scene.meshes.length, 0);
  const poor = {...played(sample, {}, 0), vertexCount: 3, parts: [], advance: () => false,
                evaluate() { throw new Error('There is not enough memory.'); }};
  assert.throws(() => new SweepfaceMesh('face', scene, poor), /not enough memory/);
  assert.equal(scene.meshes.length, 0);
  const late = SweepfaceMesh.load(readFileSync(sample), scene);
  scene.dispose();
  await assert.rejects(late, /scene was disposed of while/);
});

test('a class made of it loads faces, too', options, async () => {
  const {scene, SweepfaceMesh} = await load();
  class Mine extends SweepfaceMesh {}
  assert.ok(await Mine.load(readFileSync(sample), scene) instanceof Mine);
});

test('a mesh has the name of its file', options, async (context) => {
  const {scene, SweepfaceMesh} = await load();
  context.mock.method(globalThis, 'fetch', async () => new Response(readFileSync(sample)));
  const nameOf = async (url) => (await SweepfaceMesh.load(url, scene)).name;
  assert.equal(await nameOf(new URL('https://example.org/a/smile.sweep?version=1/2#b')), 'smile.sweep');
  assert.equal(await nameOf('blob:https://example.org/0-1'), 'face');
  assert.equal(await nameOf('data:application/octet-stream;base64,AA/BB'), 'face');
  context.mock.method(globalThis, 'fetch', async () => new Response('GIF'));
  await assert.rejects(nameOf('http://a/faces/bad.sweep?key=1'), /^Error: http:\/\/a\/faces\/bad\.sweep does not begin/);
});

test('a load has the options of then', options, async (context) => {
  const {scene, SweepfaceMesh} = await load(), regions = [{name: 'chin', points: [[0, -9, 9]], fade: 7}];
  context.mock.method(globalThis, 'fetch', async () => new Response(readFileSync(sample)));
  const loading = SweepfaceMesh.load('http://a/face.sweep', scene, {regions});
  regions[0].name = 'nose';
  assert.deepEqual((await loading).regions, ['rest', 'chin']);
});

test('a mesh that is disposed of is forgotten', options, async () => {
  const {scene, mesh} = await load();
  const watched = [scene.onAfterAnimationsObservable, scene.onBeforeRenderTargetsRenderObservable];
  const count = () => watched.map(({observers}) => observers.length);
  assert.deepEqual(count(), [1, 1]);
  mesh.dispose();
  await new Promise((resolve) => setTimeout(resolve));  // Babylon.js may take its time
  assert.deepEqual(count(), [0, 0]);
  assert.ok(watched.every((observable) => !observable.hasObservers()));
  assert.throws(() => mesh.setWeights({jawOpen: 1}), /disposed of/);
  scene.render();
  mesh.update(1);
  assert.equal(scene.meshes.length, 0);
  const {scene: other} = await load();
  other.dispose();
});

test('faces have regions and eyes', options, async () => {
  const regions = [{name: 'chin', points: [[0, -9, 9]], fade: 7}], {scene, mesh} = await load({regions, eyes: true});
  assert.deepEqual([mesh.regions, mesh.eyeCount], [['rest', 'chin'], 2]);
  const before = positionsOf(mesh);
  const pose = {leftEye: {yaw: 0.3}, rightEye: {}};
  mesh.look(pose);
  scene.render();
  assert.notDeepEqual(positionsOf(mesh), before);
  mesh.setWeights({jawOpen: 1}, 'chin');
  assert.deepEqual([mesh.weightsIn('chin').jawOpen, mesh.weightsIn('rest').jawOpen], [1, 0]);
  const twin = mesh.clone();
  assert.deepEqual([twin.weightsIn('chin').jawOpen, twin.weightsIn('rest').jawOpen], [1, 0]);
  assert.deepEqual([mesh.pose, twin.pose], [pose, pose]);
  mesh.moveTo({jawOpen: 0.5}, 'cut', 'chin');
  assert.deepEqual([mesh.weightsIn('chin').jawOpen, mesh.weightsIn('rest').jawOpen], [0.5, 0]);
});

test('what is no face is refused', options, async () => {
  const {scene, SweepfaceMesh} = await load();
  assert.throws(() => new SweepfaceMesh('face', scene, readFileSync(sample)), /await Sweepface.load/);
  const {face} = (await load()).mesh;
  assert.throws(() => new SweepfaceMesh('face', scene, face, 'red'), /^TypeError: A mesh takes a Material/);
  await assert.rejects(SweepfaceMesh.load(new Uint8Array([1, 2, 3]), scene), /check that it is a \.sweep file/);
});

const page = `<!doctype html><link rel="icon" href="data:,"><canvas id="view" width="400" height="400"></canvas>
  <script type="importmap">{"imports": {"@babylonjs/core/": "./node_modules/@babylonjs/core/"}}</script>`;
const files = {'babylon.html': page, 'sample.sweep': readFileSync(sample), 'none.sweep': (response) => response.writeHead(404).end()};

test('it is drawn from outside, in scenes of both hands', {skip: options.skip || noBrowser, timeout: 300_000}, () =>
  withPage('babylon.html', {files, viewport: {width: 500, height: 500}}, async (page, complaints) => {
    await page.evaluate(async () => {
      const names = ['Engines/engine', 'scene', 'Cameras/freeCamera', 'Lights/hemisphericLight', 'Maths/math.vector'];
      const modules = await Promise.all(names.map((name) => import(`@babylonjs/core/${name}.js`)));
      const {Engine, Scene, FreeCamera, HemisphericLight, Vector3} = Object.assign({}, ...modules);
      const {SweepfaceMesh} = await import('./sweepface_babylon.js');
      globalThis.draw = async (rightHanded, culls, weights) => {
        const canvas = document.getElementById('view'), engine = new Engine(canvas, true, {preserveDrawingBuffer: true});
        const scene = new Scene(engine);
        scene.useRightHandedSystem = rightHanded;
        new FreeCamera('camera', new Vector3(0, 0, 60), scene).setTarget(Vector3.Zero());
        new HemisphericLight('light', new Vector3(0, 1, 0.5), scene);
        const mesh = await SweepfaceMesh.load('sample.sweep', scene);
        for (const material of mesh.material.subMaterials) material.backFaceCulling = culls;
        mesh.setWeights(weights);
        await scene.whenReadyAsync();
        scene.render();
        const drawn = await createImageBitmap(canvas), context = new OffscreenCanvas(400, 400).getContext('2d');
        context.drawImage(drawn, 0, 0);
        scene.dispose();
        engine.dispose();
        return [...context.getImageData(0, 0, 400, 400).data];
      };
    });
    const draw = (...given) => page.evaluate((given) => globalThis.draw(...given), given);
    const changed = (a, b) => a.filter((value, k) => Math.abs(value - b[k]) > 40).length / a.length;
    const whole = await draw(false, false, {}), [red, green, blue] = whole;
    const isSky = (k) => whole[k] === red && whole[k + 1] === green && whole[k + 2] === blue;
    const skin = whole.filter((_, k) => k % 4 === 0 && !isSky(k)).length / (whole.length / 4);
    assert.ok(skin > 0.1 && skin < 0.9, `the face fills ${skin} of the picture`);
    assert.ok(changed(whole, await draw(false, true, {})) < 0.005);
    const right = await draw(true, false, {});
    assert.ok(changed(right, await draw(true, true, {})) < 0.005);
    assert.ok(changed(whole, right) < 0.02);
    assert.ok(changed(whole, await draw(false, false, {jawOpen: 1})) > 0.003);
    const lost = page.evaluate(async () => {
      const {SweepfaceMesh} = await import('./sweepface_babylon.js');
      await SweepfaceMesh.load('none.sweep');
    });
    await assert.rejects(lost, /none\.sweep cannot be loaded: the server answers 404/);
    assert.deepEqual(complaints.filter((text) => !text.includes('404')), []);
  }));
