import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {blank, skip, withPage} from './browser.js';
import {sample} from './native.js';

const files = {'blank.html': blank, 'face.sweep': readFileSync(process.env.SWEEPFACE_GPU_FACE ?? sample)};

/** In the page: makes meshes, and pictures of them by WebGPURenderer with one of its backends. */
async function prepare(forceWebGL) {
  const THREE = globalThis.THREE = await import('three/webgpu');
  const {Sweepface} = await import('./sweepface.js'), {SweepfaceMesh} = await import('./sweepface_three.js');
  const {SweepfaceNodeMesh} = await import('./sweepface_webgpu.js');
  const bytes = await (await fetch('./face.sweep')).arrayBuffer(), size = 256;
  const renderer = new THREE.WebGPURenderer({canvas: document.createElement('canvas'), forceWebGL});
  await renderer.init();
  renderer.shadowMap.enabled = true;
  const target = new THREE.RenderTarget(size, size), scene = globalThis.scene = new THREE.Scene();
  const {center, radius} = globalThis.sphere = new SweepfaceMesh(await Sweepface.load(bytes)).geometry.boundingSphere;
  const camera = new THREE.PerspectiveCamera(30, 1, radius, 9 * radius), light = new THREE.DirectionalLight(0xffffff, 3);
  camera.position.copy(center).add(new THREE.Vector3(0, 0, 4.2 * radius));
  light.position.copy(center).add(new THREE.Vector3(1, 0, 2).multiplyScalar(radius));
  light.target.position.copy(center);
  scene.add(light, light.target, new THREE.AmbientLight(0xffffff, 0.5));
  Object.assign(globalThis, {
    light, renderer, camera, load: () => Sweepface.load(bytes),
    make: async (materials) => Promise.all([SweepfaceMesh, SweepfaceNodeMesh].map(
      async (Made) => new Made(await Sweepface.load(bytes), materials?.()))),
    async draw(mesh) {
      await new Promise(requestAnimationFrame);  // shadows are redrawn once a frame
      scene.add(mesh);
      renderer.setRenderTarget(target);
      renderer.render(scene, camera);
      scene.remove(mesh);
      return renderer.readRenderTargetPixelsAsync(target, 0, 0, size, size);
    },
    /** The share of pixels that differ visibly. */
    differ(a, b) {
      let count = 0;
      for (let k = 0; k < a.length; k += 4) count += [0, 1, 2].some((c) => Math.abs(a[k + c] - b[k + c]) > 24);
      return 4 * count / a.length;
    },
    pose(mesh, step = 7) {
      mesh.setWeights(Object.fromEntries(mesh.names.map((name, k) => [name, ((step * k) % 10) / 20])));
      mesh.update();
      return mesh;
    },
    /** The pictures of meshes, all in the same pose. */
    async posed(...meshes) {
      const pictures = [];
      for (const mesh of meshes) pictures.push(await globalThis.draw(globalThis.pose(mesh)));
      return pictures;
    }
  });
  return renderer.backend.isWebGPUBackend === true;
}

const options = {skip, timeout: 240_000};
for (const backend of ['WebGPU', 'WebGL'])
  test(`nodes, with ${backend}`, options, (t) => withPage('blank.html', {files}, async (page, complaints) => {
    const isThere = backend === 'WebGL' || await page.evaluate(() => navigator.gpu?.requestAdapter().then(Boolean));
    if (!isThere) return t.skip('this browser has no WebGPU');
    await page.evaluate(`globalThis.prepare = ${prepare}`);
    assert.equal(await page.evaluate((forceWebGL) => globalThis.prepare(forceWebGL), backend === 'WebGL'), backend === 'WebGPU');

    await t.test('draw what the processor draws', async () => {
      const found = await page.evaluate(async () => {
        const {make, draw, differ, posed} = globalThis, [onCpu, onCard] = await make();
        const rest = [await draw(onCpu), await draw(onCard)], pose = await posed(onCpu, onCard);
        return {moved: differ(rest[0], pose[0]), rest: differ(...rest), posed: differ(...pose),
                bytes: [onCard.textureBytes, onCard.frameBytes]};
      });
      assert.ok(found.moved > 0.005, 'the pose changes nothing');
      assert.ok(found.rest < 0.001 && found.posed < 0.001, `${found.posed} of the pixels differ`);
      assert.ok(found.bytes[0] > found.bytes[1] && found.bytes[1] > 0);
    });

    await t.test('draw each face as it stands', async () => {
      const found = await page.evaluate(async () => {
        const {THREE, scene, sphere: {radius}, make, draw, differ, pose} = globalThis;
        const all = (await Promise.all([make(), make()])).flat(), [cpu, card, otherCpu, otherCard] = all;
        const both = async (...meshes) => {  // side by side
          const group = new THREE.Group().add(...meshes);
          meshes.forEach((mesh, k) => { mesh.position.x = (0.6 * k - 0.3) * radius; });
          return draw(group);
        };
        const compared = async (first, second) => differ(await both(...first), await both(...second));
        for (const mesh of [cpu, card]) pose(mesh);
        const result = {moved: await compared([cpu, cpu.clone()], [cpu, otherCpu])};
        result.two = await compared([cpu, otherCpu], [card, otherCard]);
        scene.overrideMaterial = new THREE.MeshNormalMaterial();
        result.override = await compared([cpu, otherCpu], [card, otherCard]);
        scene.overrideMaterial = null;
        const twins = [cpu.clone(), card.clone()];
        for (const mesh of twins) pose(mesh, 3);
        result.twins = await compared([cpu, twins[0]], [card, twins[1]]);
        card.dispose();
        result.left = await compared([otherCpu, twins[0]], [otherCard, twins[1]]);
        const plain = (mesh) => Object.assign(new THREE.Mesh(mesh.geometry, mesh.material), {frustumCulled: false});
        result.plain = await compared([plain(twins[0]), otherCpu], [plain(twins[1]), otherCard]);
        const many = (mesh) => {
          const made = Object.assign(new THREE.InstancedMesh(mesh.geometry, mesh.material, 2), {frustumCulled: false});
          made.setMatrixAt(0, new THREE.Matrix4().makeScale(0.5, 0.5, 0.5));
          made.setMatrixAt(1, new THREE.Matrix4().makeRotationY(1).scale(new THREE.Vector3(0.4, 0.4, 0.4)).setPosition(0.5 * radius, 0, 0));
          return made;
        };
        result.instances = await compared([many(twins[0]), otherCpu], [many(twins[1]), otherCard]);
        return result;
      });
      const {moved, ...off} = found;
      assert.ok(moved > 0.01, 'the poses are alike');
      for (const [name, share] of Object.entries(off)) assert.ok(share < 0.001, `${name}: ${share} of the pixels differ`);
    });

    await t.test('cast the same shadows', async () => {
      const found = await page.evaluate(async () => {
        const {THREE, scene, sphere: {center, radius}, light, make, draw, differ, posed} = globalThis;
        const wall = new THREE.Mesh(new THREE.PlaneGeometry(9 * radius, 9 * radius), new THREE.MeshStandardMaterial());
        wall.position.copy(center).add(new THREE.Vector3(0, 0, -radius));
        wall.receiveShadow = light.castShadow = true;
        Object.assign(light.shadow.camera, {near: 0.1 * radius, far: 9 * radius, left: -1.5 * radius, right: 1.5 * radius,
                                            bottom: -1.5 * radius, top: 1.5 * radius});
        light.shadow.camera.updateProjectionMatrix();
        scene.add(wall);
        const {positionLocal, vec3} = await import('three/tsl');
        const unseen = (own) => Object.assign(new THREE.MeshStandardNodeMaterial({colorWrite: false, depthWrite: false}), own);
        const narrow = () => unseen({castShadowPositionNode: positionLocal.mul(vec3(0.7, 1, 1))});
        const [cpu, card] = await make(unseen), [otherCpu, otherCard] = await make(unseen), narrowed = await make(narrow);
        for (const mesh of [cpu, card, otherCpu, otherCard, ...narrowed]) mesh.castShadow = true;
        const rest = await draw(otherCpu), pictures = await posed(cpu, card), result = {moved: differ(rest, pictures[0])};
        result.off = [differ(...pictures), differ(rest, await draw(otherCard))];
        const {material} = card;
        card.material = unseen();
        card.update();
        otherCard.material = material;  // of the one that moves
        otherCard.update();
        result.off.push(differ(pictures[0], await draw(card)), differ(rest, await draw(otherCard)));
        const narrowPictures = await posed(...narrowed);
        result.off.push(differ(...narrowPictures));
        result.narrow = differ(narrowPictures[0], pictures[0]);
        const lamp = new THREE.PointLight(0xffffff, 3, 0, 0), [lit, unlit] = await make(unseen);
        lamp.position.copy(light.position);
        Object.assign(lamp.shadow.camera, {near: 0.1 * radius, far: 9 * radius});
        for (const caster of [lamp, lit, unlit]) caster.castShadow = true;
        scene.remove(light);
        scene.add(lamp);
        const still = await draw(lit), byLamp = await posed(lit, unlit);
        result.lamp = differ(still, byLamp[0]);
        result.off.push(differ(...byLamp));
        scene.remove(lamp, wall);
        scene.add(light);
        light.castShadow = false;
        return result;
      });
      assert.ok(found.moved > 0.0002 && found.narrow > found.moved && found.lamp > found.moved, JSON.stringify(found));
      for (const share of found.off) assert.ok(share < 0.1 * found.moved, JSON.stringify(found));
    });

    await t.test('seem to move with what they are part of only', async () => {
      const moving = await page.evaluate(async () => {
        const {THREE, scene, renderer, camera, make, posed} = globalThis, {mrt, output, velocity} = await import('three/tsl');
        const [, card] = await make(), target = new THREE.RenderTarget(64, 64, {count: 2, type: THREE.FloatType});
        await posed(card);
        ['output', 'velocity'].forEach((name, k) => { target.textures[k].name = name; });
        renderer.setMRT(mrt({output, velocity}));
        const drawn = async () => {
          await new Promise(requestAnimationFrame);
          scene.add(card);
          renderer.setRenderTarget(target);
          renderer.render(scene, camera);
          scene.remove(card);
          const numbers = await renderer.readRenderTargetPixelsAsync(target, 0, 0, 64, 64, 1);
          return numbers.filter((number, k) => k % 4 < 2 && Math.abs(number) > 1e-5).length;
        };
        const still = [await drawn(), await drawn()];
        card.position.x += 1;
        const moved = await drawn();
        renderer.setMRT(null);
        return [...still, moved];
      });
      assert.equal(moving[1], 0);
      assert.ok(moving[2] > 100, `${moving}`);
    });

    await t.test('go with materials that move vertices themselves, with clones, and with what is put in later', async () => {
      const found = await page.evaluate(async () => {
        const {THREE, sphere, load, make, draw, differ, posed} = globalThis, {positionLocal, vec3} = await import('three/tsl');
        const wide = () => Object.assign(new THREE.MeshNormalNodeMaterial(), {positionNode: positionLocal.mul(vec3(0.5, 1, 1))});
        const [onCpu, onCard] = await make(wide), [cpu, card] = await posed(onCpu, onCard), result = {own: differ(cpu, card)};
        const twin = onCard.clone();
        result.twin = differ(cpu, await draw(twin));
        onCard.dispose();  // which leaves the twin what they shared
        result.left = differ(cpu, await draw(twin));
        const displacementMap = new THREE.DataTexture(new Uint8Array(4).fill(255), 1, 1);
        displacementMap.needsUpdate = true;
        const thick = await make(() => new THREE.MeshNormalMaterial({
          displacementMap, displacementScale: 0.1 * sphere.radius, displacementBias: 0.2 * sphere.radius
        }));
        result.thick = differ(...await posed(...thick));
        const later = await make(() => new THREE.MeshNormalNodeMaterial());
        await posed(...later);
        for (const {material} of later) Object.assign(material, {positionNode: positionLocal.mul(vec3(0.5, 1, 1)), needsUpdate: true});
        const [laterCpu, laterCard] = await posed(...later);
        result.later = differ(laterCpu, laterCard) + differ(laterCpu, cpu);
        try { new later[1].constructor(await load(), new THREE.ShaderMaterial()); } catch (error) { result.shader = error.message; }
        const put = new THREE.MeshNormalMaterial(), [plain] = await make(() => put.clone());
        result.other = differ(cpu, (await posed(plain))[0]);
        twin.material = put;
        twin.update();
        result.late = differ(await draw(plain), await draw(twin));
        const [, another] = await make();
        another.material = put;
        try { another.update(); } catch (error) { result.message = error.message; }
        twin.material = new THREE.MeshBasicMaterial();
        twin.update();
        result.freed = put.positionNode;
        return result;
      });
      const {other, message, shader, freed, ...off} = found;
      assert.match(shader, /^The material 'ShaderMaterial' is written in GLSL/);
      for (const [name, share] of Object.entries(off)) assert.ok(share < 0.001, `${name}: ${share} of the pixels differ`);
      assert.ok(other > 0.01);
      assert.match(message, /follows a face already/);
      assert.equal(freed, null);
      assert.deepEqual(complaints, []);
    });
  }));
