import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {blank, skip, withPage} from './browser.js';
import {converted, loadScene, model} from './scene_file.js';

/** A model whose skeleton stands askew; if it `isFlat`, without normals. */
function file(isFlat) {
  const made = model(), {nodes, meshes} = made.json;
  nodes[1].rotation = [0, 0, 0.1, 0.995];
  for (const {attributes} of isFlat ? meshes.flatMap(({primitives}) => primitives) : []) delete attributes.NORMAL;
  return readFileSync(converted(made));
}

/** In the page: loads scenes, and makes pictures of them by one of three.js's renderers. */
async function prepare(kind) {
  const isNodes = kind !== 'WebGLRenderer', THREE = globalThis.THREE = await import(isNodes ? 'three/webgpu' : 'three');
  const {SweepfaceSceneLoader, cloneScene} = await import('./sweepface_scene.js');
  const {SweepfaceGpuMesh} = await import('./sweepface_gpu.js'), {SweepfaceMesh} = await import('./sweepface_three.js');
  const CardMesh = isNodes ? (await import('./sweepface_webgpu.js')).SweepfaceNodeMesh : SweepfaceGpuMesh;
  const bytesOf = async (name) => (await fetch(name)).arrayBuffer(), size = 256, canvas = document.createElement('canvas');
  const renderer = isNodes ? new THREE.WebGPURenderer({canvas, forceWebGL: kind === 'nodes in WebGL'})
                           : new THREE.WebGLRenderer({canvas});
  await renderer.init?.();
  renderer.shadowMap.enabled = true;
  const Target = isNodes ? THREE.RenderTarget : THREE.WebGLRenderTarget, target = new Target(size, size);
  const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 50), light = new THREE.DirectionalLight(0xffffff, 3);
  const scene = globalThis.scene = new THREE.Scene();
  camera.position.set(0.5, 0.4, 5);
  camera.lookAt(0, 0.2, 0);
  light.position.set(1, 1, 2);
  scene.add(light, new THREE.AmbientLight(0xffffff, 0.5));
  Object.assign(globalThis, {
    renderer, light, camera, cloneScene,
    both: (name = 'model.sweep') => Promise.all([SweepfaceMesh, CardMesh].map(async (mesh) => {
      return new SweepfaceSceneLoader().parseAsync(await bytesOf(name), {name, mesh});
    })),
    pose({scene, face}, jawOpen, smile, look) {
      face.setWeights({jawOpen, smile, look});
      face.update();
      scene.getObjectByName('neck').rotation.z = jawOpen / 2;
    },
    async draw(...models) {
      await new Promise(requestAnimationFrame);  // shadows are redrawn once a frame
      const shown = models.map((model) => model.scene ?? model);
      scene.add(...shown);
      renderer.setRenderTarget(target);
      renderer.render(scene, camera);
      scene.remove(...shown);
      if (isNodes) return renderer.readRenderTargetPixelsAsync(target, 0, 0, size, size);
      const pixels = new Uint8Array(4 * size * size);
      renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
      return pixels;
    },
    /** The share of pixels that differ visibly. */
    differ(a, b) {
      let count = 0;
      for (let k = 0; k < a.length; k += 4) count += [0, 1, 2].some((c) => Math.abs(a[k + c] - b[k + c]) > 24);
      return 4 * count / a.length;
    }
  });
  return renderer.backend?.isWebGPUBackend === true;
}

const files = {'blank.html': blank, ...(!skip && {'model.sweep': file(false), 'flat.sweep': file(true)})}, options = {skip, timeout: 240_000};

/** Asserts that something changes what is seen, and pairs of pictures do not differ. */
function assertAlike({moved, off}) {
  for (const [name, share] of Object.entries(moved)) assert.ok(share > 0.01, `${name} changes ${share} of the picture`);
  for (const [name, share] of Object.entries(off)) assert.ok(share < 0.002, `${name}: ${share} of the pixels differ`);
}

for (const kind of ['WebGLRenderer', 'nodes in WebGPU', 'nodes in WebGL'])
  test(`a scene on the graphics card, by ${kind}`, options, (t) => withPage('blank.html', {files}, async (page, complaints) => {
    const isThere = kind !== 'nodes in WebGPU' || await page.evaluate(() => navigator.gpu?.requestAdapter().then(Boolean));
    if (!isThere) return t.skip('this browser has no WebGPU');
    await page.evaluate(`globalThis.prepare = ${prepare}`);
    assert.equal(await page.evaluate((kind) => globalThis.prepare(kind), kind), kind === 'nodes in WebGPU');

    await t.test('is drawn as the processor would have it, shadows included', async () => {
      const found = await page.evaluate(async () => {
        const {THREE, both, draw, differ, pose, light, scene} = globalThis, models = await both();
        const pictures = async () => [await draw(models[0]), await draw(models[1])];
        const rest = await pictures();
        for (const model of models) pose(model, 1, 0.5, 1);
        const posed = await pictures(), wall = new THREE.Mesh(new THREE.PlaneGeometry(9, 9), new THREE.MeshStandardMaterial());
        wall.position.z = -0.5;
        scene.add(wall);
        const bright = await draw(models[0]);
        for (const model of models) model.scene.traverse((object) => {
          object.castShadow = object.receiveShadow = true;
          if (object.material) object.material.shadowSide = THREE.DoubleSide;  // as its surfaces are open
        });
        light.castShadow = wall.receiveShadow = true;
        const shaded = await pictures();
        for (const model of models) pose(model, 0, 0, 0);
        const relaxed = await pictures();
        scene.remove(wall);
        light.castShadow = false;
        return {
          moved: {pose: differ(rest[0], posed[0]), shadow: differ(bright, shaded[0]), rest: differ(shaded[0], relaxed[0])},
          off: {rest: differ(...rest), posed: differ(...posed), shaded: differ(...shaded), relaxed: differ(...relaxed)}
        };
      });
      assertAlike(found);
      assert.deepEqual(complaints, []);
    });

    await t.test('does without normals', async () => {
      assertAlike(await page.evaluate(async () => {
        const {both, draw, differ, pose} = globalThis, smooth = await both(), flat = await both('flat.sweep');
        for (const model of [...smooth, ...flat]) pose(model, 1, 0.5, 1);
        const [onCpu, onCard, other] = [await draw(flat[0]), await draw(flat[1]), await draw(smooth[0])];
        return {moved: {shading: differ(onCpu, other)}, off: {flat: differ(onCpu, onCard)}};
      }));
      assert.deepEqual(complaints, []);
    });

    await t.test('goes on in its clones, and without the original', async () => {
      assertAlike(await page.evaluate(async () => {
        const {both, draw, differ, pose, cloneScene} = globalThis, models = await both();
        const twins = models.map((model) => cloneScene(model));
        models.forEach(({scene}) => { scene.position.x = -1; });
        twins.forEach(({scene}) => { scene.position.x = 1; });
        const pictures = async () => [await draw(models[0], twins[0]), await draw(models[1], twins[1])];
        for (const model of models) pose(model, 1, 0, 1);
        const apart = await pictures();
        for (const model of twins) pose(model, -1, 1, 0);
        const moved = await pictures();
        for (const {face} of models) face.dispose();
        const alone = [await draw(twins[0]), await draw(twins[1])];
        return {moved: {twin: differ(apart[0], moved[0])},
                off: {apart: differ(...apart), moved: differ(...moved), alone: differ(...alone)}};
      }));
      assert.deepEqual(complaints, []);
    });
  }));

const three = await import('three').catch(() => undefined);
const inNode = {skip: three ? false : 'three is not installed; try npm ci'};

/** The model on the processor and on the graphics card. */
async function pair(bytes = readFileSync(converted(model()))) {
  const {SweepfaceGpuMesh} = await import('../sweepface_gpu.js');
  return Promise.all([loadScene(bytes), loadScene(bytes, {mesh: SweepfaceGpuMesh})]);
}

test('rays meet the face as it stands, until it is disposed of', inNode, async () => {
  const models = await pair(), ray = new three.Raycaster();
  const met = (weights) => models.map(({scene, face}) => {
    face.setWeights(weights);
    face.update();
    scene.updateMatrixWorld(true);
    return [[0, -0.5], [0.05, 0.05], [0.4, 0.35]].flatMap(([x, y]) => {
      ray.set(new three.Vector3(x, y, 5), new three.Vector3(0, 0, -1));
      return ray.intersectObject(scene).map(({object, point, normal}) => [object.name, ...point.toArray(), ...normal.toArray()]);
    });
  });
  const rest = met({jawOpen: 0, look: 0}), moved = met({jawOpen: 1, smile: 1, look: 1});
  for (const [onCpu, onCard] of [rest, moved]) assert.deepEqual(onCard, onCpu);
  assert.notDeepEqual(rest[0], moved[0]);
  assert.ok(moved[0].length > 3);
  models[1].face.dispose();
  assert.deepEqual(ray.intersectObjects(models[1].face.meshes, false), []);
});

test('materials that follow the face are on nothing else', inNode, async () => {
  const made = model();
  made.json.meshes[2].primitives[0].material = 0;  // the hat is of skin
  const [, {scene, face}] = await pair(readFileSync(converted(made)));
  const [lips, skin, eye, otherEye] = face.meshes.map(({material}) => material), hat = scene.getObjectByName('hat').material;
  assert.deepEqual([lips, skin, eye, hat].map(({name}) => name), ['lips', 'skin', 'skin', 'skin']);
  assert.equal(new Set([lips, skin, eye, hat]).size, 4);  // eyes stand otherwise than the head
  assert.equal(eye, otherEye);
  assert.ok(face.meshes.every(({frustumCulled}) => !frustumCulled));  // as bounds are those of the neutral
  const follows = (material) => Object.hasOwn(material, 'onBeforeCompile');
  assert.deepEqual([lips, skin, eye, hat].map(follows), [true, true, true, false]);
  const fresh = new three.MeshBasicMaterial();
  face.meshes[0].material = fresh;
  face.update();
  assert.deepEqual([fresh, lips].map(({onBeforeCompile}) => onBeforeCompile.length), [2, 0]);
  const blind = new three.ShaderMaterial({name: 'blind', vertexShader: 'void main() { gl_Position = vec4(0); }'});
  face.meshes[0].material = blind;
  assert.throws(() => face.update(), {message: /^The material 'blind' has no `#include <begin_vertex>`/});
  face.meshes[0].material = hat;
  face.update();
  assert.deepEqual([hat, face.meshes[0].material].map(follows), [false, true]);
});

test('materials of the face may go to any of its meshes', inNode, async () => {
  const [, {scene, face}] = await pair(), [lips, skin, eye] = face.meshes;
  const materials = [lips, skin, eye].map(({material}) => material);
  [lips.material, eye.material] = [eye.material, lips.material];
  face.update();
  assert.equal(eye.material, materials[0]);
  assert.notEqual(lips.material, materials[2]);  // which the other eye has
  assert.equal(lips.material.name, 'skin');
  const [one, two] = ['one', 'two'].map((name) => new three.MeshStandardMaterial({name}));
  for (const mesh of face.meshes) mesh.material = one;
  face.update();
  assert.deepEqual([lips, skin, eye].map(({material}) => material.name), ['one', 'one', 'one']);
  assert.equal(lips.material, skin.material);
  assert.notEqual(lips.material, eye.material);
  scene.traverse((object) => { if (object.isMesh) object.material = two; });
  face.update();
  assert.equal(scene.getObjectByName('hat').material, two);
  assert.ok([lips, skin, eye].every(({material}) => material !== two && material.name === 'two'));
  [lips, skin, eye].forEach((mesh, k) => { mesh.material = materials[k]; });
  face.update();
  assert.deepEqual([lips, skin, eye].map(({material}) => material), materials);
});

/** A material such as plugins make: its constructor changes the shader, by what it holds itself. */
class Painted extends (three?.ShaderMaterial ?? Object) {
  paint = 'fresh';

  constructor() {
    super({vertexShader: '#include <begin_vertex>', uniforms: {tint: {value: new three.Color()}}});
    this.onBeforeCompile = (shader) => { shader.defines = {PAINT: this.paint}; };
  }
}

test('clones of materials go on with the values of the original, and are themselves otherwise', inNode, async () => {
  const {cloneScene} = await import('../sweepface_scene.js');
  const [, model] = await pair(), [lips, skin, eye] = model.face.meshes, painted = new Painted();
  skin.material.color.setHex(0xff8800);
  assert.equal(eye.material.color.getHex(), 0xff8800);
  lips.material = eye.material = painted;
  model.face.update();
  const twin = cloneScene(model).face.meshes[0].material;
  for (const clone of [eye.material, twin]) {
    painted.uniforms.tint.value.setHex(0x00ff00);
    assert.equal(clone.uniforms.tint.value.getHex(), 0x00ff00);
    clone.paint = 'dry';
    const shader = {vertexShader: clone.vertexShader, uniforms: clone.uniforms};
    clone.onBeforeCompile(shader);
    assert.deepEqual(shader.defines, {PAINT: 'dry'});
    assert.ok(shader.uniforms.sweepModes && shader.uniforms.tint);
    assert.ok(!clone.uniforms.sweepModes && !painted.uniforms.sweepModes);
  }
});

test('a material that takes away where vertices move says so', inNode, async () => {
  const [, {face}] = await pair(), {error} = console, told = [];
  face.meshes[0].material = Object.assign(new three.MeshBasicMaterial({name: 'own'}), {
    onBeforeCompile(shader) { shader.vertexShader = shader.vertexShader.replace('#include <begin_vertex>', 'vec3 transformed;'); }
  });
  face.update();
  console.error = (message) => told.push(message);
  try {
    face.meshes[0].material.onBeforeCompile({vertexShader: three.ShaderLib.basic.vertexShader, uniforms: {}});
  } finally {
    console.error = error;
  }
  assert.match(told.join(), /^The material 'own' shows the neutral, as its onBeforeCompile takes away `#include <begin_vertex>`/);
});

test('shadows are compiled again where holes come or go', inNode, async () => {
  const [, {face}] = await pair(), [mesh] = face.meshes, depth = mesh.customDepthMaterial;
  const cast = (changes) => {
    const {version} = Object.assign(depth, changes);
    mesh.onBeforeShadow(null, mesh, null, null, mesh.geometry, depth, null);
    return depth.version > version;
  };
  const map = new three.Texture();
  assert.deepEqual([{}, {alphaTest: 0.5}, {map}, {}, {alphaTest: 0.4}, {alphaTest: 0, map: null}].map(cast),
                   [false, true, true, false, false, true]);
});

test('a skinned face leaves room for buffers of its own', inNode, async () => {
  const [, {face}] = await pair(), buffers = Object.values(face.meshes[0].geometry.attributes).map((each) => each.data ?? each);
  assert.equal(new Set(buffers).size, 5);  // positions and normals, what points into tables, texture coordinates, joints, weights
});

test('a clone that fails frees what it took', inNode, async () => {
  const {cloneScene} = await import('../sweepface_scene.js');
  const [, model] = await pair(), {face, scene} = model, [mesh] = face.meshes, {material} = mesh, gone = [];
  scene.getObjectByName('hat').material.addEventListener('dispose', () => gone.push('hat'));
  mesh.material = new three.ShaderMaterial({name: 'blind', vertexShader: ''});
  assert.throws(() => cloneScene(model), {message: /^The material 'blind' has no/});
  mesh.material = material;
  face.dispose();
  assert.deepEqual(gone, ['hat']);
});

test('what plugins put on meshes of the face stays', inNode, async () => {
  const {GLTFLoader} = await import('three/addons/loaders/GLTFLoader.js'), {SweepfaceGpuMesh} = await import('../sweepface_gpu.js');
  const depth = new three.MeshDepthMaterial(), called = [];
  const gltfLoader = new GLTFLoader().register(() => ({
    name: 'test',
    async afterRoot({scene}) {
      scene.traverse((mesh) => {
        if (!mesh.isMesh) return;
        mesh.customDepthMaterial = depth;
        for (const name of ['onBeforeRender', 'onBeforeShadow']) mesh[name] = (...given) => called.push([name, given.length]);
      });
    }
  }));
  const {face} = await loadScene(readFileSync(converted(model())), {mesh: SweepfaceGpuMesh, gltfLoader}), [mesh] = face.meshes;
  assert.equal(mesh.customDepthMaterial, depth);
  assert.equal(depth.onBeforeCompile.length, 2);
  mesh.onBeforeRender({}, 1, 2, 3, 4, 5);
  mesh.onBeforeShadow({}, 1, 2, 3, 4, depth, 5);
  assert.deepEqual(called, [['onBeforeRender', 6], ['onBeforeShadow', 7]]);
});

test('geometries on the graphics card hold the neutral, in the space of their meshes', inNode, async () => {
  const models = await pair();
  for (const {face} of models) {
    face.reset();
    face.update();
  }
  const [cpu, card] = models.map(({face}) => face.meshes.map(({geometry}) => geometry.attributes));
  for (const name of ['position', 'normal'])
    cpu.forEach((attributes, k) => {
      const at = (list, v) => new three.Vector3().fromBufferAttribute(list, v), other = card[k][name];
      for (let v = 0; v < other.count; ++v) assert.ok(at(attributes[name], v).distanceTo(at(other, v)) < 1e-3, `${name} ${k} ${v}`);
    });
});

test('a scene on the graphics card frees what was made for it', inNode, async () => {
  const {cloneScene} = await import('../sweepface_scene.js');
  const [, model] = await pair(), twin = cloneScene(model), [, {material: skin}] = model.face.meshes, gone = [];
  const [, {material: theirs, customDepthMaterial: depth}] = twin.face.meshes;
  assert.notEqual(theirs, skin);
  const read = (material) => {  // the textures that its shader reads
    const shader = {vertexShader: '#include <begin_vertex>', uniforms: {}};
    material.onBeforeCompile(shader);
    return shader.uniforms;
  };
  const {sweepModes: {value: modes}, sweepBasis: {value: basis}} = read(theirs);
  assert.equal(read(skin).sweepBasis.value, basis);
  for (const [name, it] of Object.entries({skin, theirs, depth, modes, basis})) it.addEventListener('dispose', () => gone.push(name));
  twin.face.setWeights({jawOpen: 1});
  twin.face.update();
  assert.equal(model.face.weights.jawOpen, 0.25);
  twin.face.dispose();
  assert.deepEqual([...new Set(gone)].sort(), ['depth', 'modes', 'theirs']);
  model.face.dispose();
  assert.ok(gone.includes('skin') && gone.includes('basis'));
  assert.equal(skin.onBeforeCompile.length, 0);
});

test('what cannot draw a scene on the graphics card says so', inNode, async () => {
  const [, {scene, face}] = await pair(), told = [], {error} = console, [mesh] = face.meshes;
  console.error = (message) => told.push(message);
  try {
    for (let frame = 0; frame < 2; ++frame) mesh.onBeforeRender({isRenderer: true}, scene);
  } finally {
    console.error = error;
  }
  assert.deepEqual(told, ['WebGPURenderer draws the neutral of every SweepfaceGpuMesh; make a SweepfaceNodeMesh for it.']);
});
