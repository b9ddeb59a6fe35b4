import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {blank, skip, withPage} from './browser.js';
import {sample} from './native.js';

const face = readFileSync(process.env.SWEEPFACE_GPU_FACE ?? sample);
const files = {'blank.html': blank, 'face.sweep': face};

/** In the page: a face, weights for it, and a count of the bytes that WebGL uploads. */
async function prepare() {
  const {Sweepface} = await import('./sweepface.js');
  const bytes = await (await fetch('./face.sweep')).arrayBuffer();
  globalThis.load = () => Sweepface.load(bytes.slice(0));
  const face = globalThis.face = await globalThis.load();
  globalThis.pose = Object.fromEntries(face.names.map((name, k) => [name, ((7 * k) % 10) / 20]));
  globalThis.uploaded = 0;
  const prototype = WebGL2RenderingContext.prototype;
  for (const name of ['texImage2D', 'texSubImage2D', 'texImage3D', 'texSubImage3D', 'bufferData', 'bufferSubData']) {
    const call = prototype[name];
    prototype[name] = function(...given) {
      for (const x of given) if (ArrayBuffer.isView(x)) globalThis.uploaded += x.byteLength;
      return call.apply(this, given);
    };
  }
}

/** In the page: positions and normals of all points as a vertex shader computes them, read by transform feedback. */
async function onTheCard() {
  const {SWEEPFACE_GLSL} = await import('./sweepface_gpu.js');
  const {face} = globalThis, count = face.pointCount;
  const gl = new OffscreenCanvas(1, 1).getContext('webgl2'), program = gl.createProgram();
  const shader = (type, source) => {
    const made = gl.createShader(type);
    gl.shaderSource(made, '#version 300 es\nprecision highp float;\n' + source);
    gl.compileShader(made);
    if (!gl.getShaderParameter(made, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(made));
    gl.attachShader(program, made);
  };
  shader(gl.VERTEX_SHADER, `uniform highp isampler2D basis, modes, tangentBasis, tangentModes; uniform float factor;
    in uvec3 place, tangentPlace; in vec3 neutral, along, across; out vec3 position, normal; ${SWEEPFACE_GLSL}
    void main() {
      position = sweepfacePosition(neutral, place, basis, modes, factor);
      normal = sweepfaceNormal(along, across, tangentPlace, tangentBasis, tangentModes, factor);
      gl_Position = vec4(0);
    }`);
  shader(gl.FRAGMENT_SHADER, 'void main() {}');
  gl.transformFeedbackVaryings(program, ['position', 'normal'], gl.SEPARATE_ATTRIBS);
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  const texture = (unit, name, numbers) => {
    const width = 1024, height = Math.max(1, Math.ceil(numbers.length / 4 / width));
    const data = new Int16Array(4 * width * height);
    data.set(numbers);
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16I, width, height, 0, gl.RGBA_INTEGER, gl.SHORT, data);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    gl.uniform1i(gl.getUniformLocation(program, name), unit);
  };
  const buffer = (target, data) => {
    const made = gl.createBuffer();
    gl.bindBuffer(target, made);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    return made;
  };
  const attribute = (name, data, stride = 0, offset = 0) => {
    const at = gl.getAttribLocation(program, name);
    buffer(gl.ARRAY_BUFFER, data);
    gl.enableVertexAttribArray(at);
    if (data instanceof Uint32Array) gl.vertexAttribIPointer(at, 3, gl.UNSIGNED_INT, stride, offset);
    else gl.vertexAttribPointer(at, 3, gl.FLOAT, false, stride, offset);
  };
  for (const tangents of [false, true]) {
    const tables = face.shaderTables(tangents), modes = new Int16Array(4 * tables.modes);
    gl.uniform1f(gl.getUniformLocation(program, 'factor'), face.shaderModes(modes, tangents));
    const named = (name) => tangents ? 'tangent' + name[0].toUpperCase() + name.slice(1) : name;
    texture(tangents ? 2 : 0, named('basis'), tables.basis);
    texture(tangents ? 3 : 1, named('modes'), modes);
    attribute(named('place'), tables.places);
    if (!tangents) attribute('neutral', tables.neutral);
    else for (const k of [0, 1]) attribute(['along', 'across'][k], tables.neutral, 24, 12 * k);
  }
  gl.enable(gl.RASTERIZER_DISCARD);
  const outs = [0, 1].map(() => buffer(gl.TRANSFORM_FEEDBACK_BUFFER, new Float32Array(3 * count)));
  outs.forEach((out, k) => gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, k, out));
  gl.beginTransformFeedback(gl.POINTS);
  gl.drawArrays(gl.POINTS, 0, count);
  gl.endTransformFeedback();
  return outs.map((out) => {
    const values = new Float32Array(3 * count);
    gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, out);
    gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, values);
    return values;
  });
}

const options = {skip, timeout: 240_000};
test('the vertex shader', options, (t) => withPage('blank.html', {files}, async (page, complaints) => {
  await page.evaluate(`globalThis.onTheCard = ${onTheCard}`);
  await page.evaluate(prepare);

  await t.test('has the positions and the normals of the processor', async () => {
    const found = await page.evaluate(async () => {
      const {face, pose, onTheCard} = globalThis, points = face.pointCount;
      const positions = new Float32Array(3 * face.vertexCount), normals = new Float32Array(3 * face.vertexCount);
      let most = 0, turned = 0, moved = 0, size = 0;
      const neutral = new Float32Array(3 * face.vertexCount);
      face.evaluate(neutral);
      for (const weights of [pose, {}]) {
        face.reset();
        face.setWeights(weights);
        face.evaluate(positions, normals);
        const [places, directions] = await onTheCard();
        for (let k = 0; k < 3 * points; ++k) {
          most = Math.max(most, Math.abs(places[k] - positions[k]));
          moved = Math.max(moved, Math.abs(neutral[k] - positions[k]));
          size = Math.max(size, Math.abs(positions[k]));
          turned = Math.max(turned, Math.abs(directions[k] - normals[k]));
        }
      }
      return {most: most / size, turned, moved: moved / size};
    });
    assert.ok(found.moved > 0.01, 'the pose moves nothing');
    assert.ok(found.most < 1e-6, `positions differ by ${found.most} of the face's size`);
    assert.ok(found.turned < 1e-4, `normals differ by ${found.turned}`);
  });

  await t.test('draws what the processor and morph targets draw, with less to upload', async () => {
    const found = await page.evaluate(async () => {
      const THREE = await import('three');
      const {SweepfaceMesh} = await import('./sweepface_three.js');
      const {SweepfaceGpuMesh} = await import('./sweepface_gpu.js');
      const {morphMesh} = await import('./test/morph_mesh.js');
      const {pose, load} = globalThis, size = 256;
      const renderer = new THREE.WebGLRenderer({canvas: new OffscreenCanvas(size, size), antialias: false});
      const target = new THREE.WebGLRenderTarget(size, size);
      const onCpu = new SweepfaceMesh(await load()), onGpu = new SweepfaceGpuMesh(await load());
      const sphere = (onCpu.geometry.computeBoundingSphere(), onCpu.geometry.boundingSphere);
      const camera = new THREE.PerspectiveCamera(30, 1, sphere.radius, 9 * sphere.radius);
      camera.position.copy(sphere.center).add(new THREE.Vector3(0, 0, 4.2 * sphere.radius));
      const light = new THREE.DirectionalLight(0xffffff, 3);
      light.position.set(1, 1, 2);

      const scene = new THREE.Scene();
      scene.add(light, new THREE.AmbientLight(0xffffff, 0.5));
      const draw = (mesh) => {
        scene.add(mesh);
        const before = globalThis.uploaded, pixels = new Uint8Array(4 * size * size);
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
        scene.remove(mesh);
        return {pixels, uploaded: globalThis.uploaded - before};
      };
      const differ = (a, b) => {  // the share of pixels that differ visibly
        let count = 0;
        for (let k = 0; k < a.length; k += 4)
          count += Math.max(...[0, 1, 2].map((c) => Math.abs(a[k + c] - b[k + c]))) > 24;
        return 4 * count / a.length;
      };
      const morph = morphMesh(onCpu.face, onCpu.geometry, onCpu.material), meshes = {onCpu, onGpu, morph}, result = {};
      onCpu.setWeights(Object.fromEntries(onCpu.face.names.map((name) => [name, 0])));
      onCpu.update();
      const first = Object.fromEntries(Object.entries(meshes).map(([name, mesh]) => [name, draw(mesh)]));
      for (const mesh of [onCpu, onGpu]) {
        mesh.setWeights(pose);
        mesh.update();
      }
      morph.morphTargetInfluences = onCpu.face.names.map((name) => pose[name]);
      const second = Object.fromEntries(Object.entries(meshes).map(([name, mesh]) => [name, draw(mesh)]));
      for (const name of Object.keys(meshes))
        result[name] = {first: first[name].uploaded, everyFrame: second[name].uploaded};
      result.moved = differ(first.onCpu.pixels, second.onCpu.pixels);
      result.atRest = differ(first.onCpu.pixels, first.onGpu.pixels);
      result.posed = differ(second.onCpu.pixels, second.onGpu.pixels);
      result.likeMorphs = differ(second.morph.pixels, second.onGpu.pixels);

      const other = new SweepfaceMesh(await load());
      draw(other);
      const worn = new SweepfaceGpuMesh(await load({lod: 2}), other.material);  // drawn before without the shader
      worn.setWeights(pose);
      worn.update();
      result.worn = differ(second.onCpu.pixels, draw(worn).pixels);

      const wall = new THREE.Mesh(new THREE.PlaneGeometry(9 * sphere.radius, 9 * sphere.radius),
                                  new THREE.MeshStandardMaterial());
      wall.position.copy(sphere.center).add(new THREE.Vector3(0, 0, -sphere.radius));
      wall.receiveShadow = renderer.shadowMap.enabled = true;
      scene.add(wall);
      scene.remove(light);
      const reach = {near: 0.1 * sphere.radius, far: 9 * sphere.radius};
      const sun = new THREE.DirectionalLight(0xffffff, 3), lamp = new THREE.PointLight(0xffffff, 3, 0, 0);
      const side = 1.5 * sphere.radius;
      Object.assign(sun.shadow.camera, reach, {left: -side, right: side, bottom: -side, top: side});
      Object.assign(lamp.shadow.camera, reach);
      const shadow = (mesh, light) => {  // the face itself is not drawn
        mesh.castShadow = light.castShadow = true;
        for (const material of [mesh.material].flat()) material.colorWrite = material.depthWrite = false;
        light.position.copy(sphere.center).add(new THREE.Vector3(3, 0, 2).multiplyScalar(0.7 * sphere.radius));
        if (light.target) light.target.position.copy(sphere.center), light.target.updateMatrixWorld();
        scene.add(light);
        const {pixels} = draw(mesh);
        scene.remove(light);
        return pixels;
      };
      result.shadows = [sun, lamp].map((light) => {
        const here = shadow(onCpu, light), there = shadow(onGpu, light);
        onCpu.setWeights(Object.fromEntries(onCpu.names.map((name) => [name, 0])));
        onCpu.update();
        const atRest = shadow(onCpu, light);
        onCpu.setWeights(pose);
        onCpu.update();
        return {moved: differ(here, atRest), off: differ(here, there)};
      });
      return result;
    });
    console.log('bytes uploaded:', JSON.stringify(found));
    assert.ok(found.moved > 0.005, 'the pose changes nothing');
    assert.ok(found.atRest < 0.001 && found.posed < 0.001, `${found.posed} of the pixels differ`);
    assert.ok(found.worn < 0.01, `${found.worn} of the pixels differ with a material that was drawn before`);
    assert.ok(found.likeMorphs < 0.05, `${found.likeMorphs} of the pixels differ from morph targets`);
    for (const {moved, off} of found.shadows) assert.ok(moved > 0.0002 && off < 0.1 * moved, `${moved} of the shadow`);
    assert.ok(found.onGpu.first < 0.5 * found.morph.first);
    assert.ok(found.onGpu.everyFrame < found.onCpu.everyFrame);
    assert.deepEqual(complaints, []);
  });

  await t.test('goes with materials that dither or change shaders themselves, and with clones', async () => {
    const found = await page.evaluate(async () => {
      const THREE = await import('three');
      const {SweepfaceMesh} = await import('./sweepface_three.js');
      const {SweepfaceGpuMesh} = await import('./sweepface_gpu.js');
      const {pose, load} = globalThis, size = 256, scene = new THREE.Scene();
      const renderer = new THREE.WebGLRenderer({canvas: new OffscreenCanvas(size, size), antialias: false});
      const target = new THREE.WebGLRenderTarget(size, size), camera = new THREE.PerspectiveCamera(30, 1, 1, 1000);
      const bright = (mesh) => {  // how many pixels the face covers
        mesh.geometry.computeBoundingSphere();
        const {center, radius} = sphere ??= mesh.geometry.boundingSphere;
        camera.position.copy(center).add(new THREE.Vector3(0, 0, 4.2 * radius));
        const pixels = new Uint8Array(4 * size * size);
        scene.add(mesh);
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
        scene.remove(mesh);
        return pixels.filter((value, k) => k % 4 === 0 && value > 0).length;
      };
      let sphere;
      const white = (given) => new THREE.MeshBasicMaterial({side: THREE.DoubleSide, ...given});
      const hash = () => white({alphaHash: true, opacity: 0.5});
      const wide = () => white({onBeforeCompile(shader) {
        shader.vertexShader = shader.vertexShader.replace(
          '#include <begin_vertex>', '#include <begin_vertex>\ntransformed.x *= 0.5;');
      }, customProgramCacheKey: () => 'wide'});
      const place = 'gl_Position = projectionMatrix * modelViewMatrix * vec4(transformed, 1.0);';
      const main = `void main() {\n#include <begin_vertex>\n${place}\n}`;
      const shader = () => new THREE.ShaderMaterial({
        side: THREE.DoubleSide, vertexShader: main, fragmentShader: 'void main() { gl_FragColor = vec4(1.0); }'
      });
      const raw = () => new THREE.RawShaderMaterial({
        side: THREE.DoubleSide, glslVersion: THREE.GLSL3,
        vertexShader: `in vec3 position; uniform mat4 modelViewMatrix, projectionMatrix; ${main}`,
        fragmentShader: 'precision highp float; out vec4 colour; void main() { colour = vec4(1.0); }'
      });
      const draw = async (Made, materials) => {
        const mesh = new Made(await load(), materials);
        mesh.setWeights(pose);
        mesh.update();
        const twin = mesh.clone(), both = [bright(mesh), bright(twin)];
        mesh.dispose();  // which leaves the twin what they shared
        return [...both, bright(twin)];
      };
      const result = {};
      for (const [name, make] of [['plain', white], ['hash', hash], ['changed', wide], ['shader', shader], ['raw', raw]])
        result[name] = [await draw(SweepfaceMesh, make()), await draw(SweepfaceGpuMesh, make())];
      return result;
    });
    for (const [name, [cpu, gpu]] of Object.entries(found)) {
      assert.ok(cpu[0] > 1000, name);
      for (const all of [...cpu, ...gpu]) assert.ok(Math.abs(all / cpu[0] - 1) < 0.05, `${name}: ${all} of ${cpu[0]}`);
    }
    for (const name of ['hash', 'changed']) assert.ok(found[name][1][0] < 0.9 * found.plain[1][0], name);
    assert.deepEqual(complaints, []);
  });

  await t.test('has once on the card what clones share', async () => {
    const found = await page.evaluate(async () => {
      const THREE = await import('three');
      const {SweepfaceMesh} = await import('./sweepface_three.js');
      const {SweepfaceGpuMesh} = await import('./sweepface_gpu.js');
      const {pose, load} = globalThis, canvas = new OffscreenCanvas(64, 64);
      const renderer = new THREE.WebGLRenderer({canvas}), gl = renderer.getContext();
      const bufferData = gl.bufferData.bind(gl), createTexture = gl.createTexture.bind(gl);
      let bytes = 0, textures = 0;
      gl.bufferData = (target, data, usage) => {
        bytes += data.byteLength ?? data;
        bufferData(target, data, usage);
      };
      gl.createTexture = () => (++textures, createTexture());
      const camera = new THREE.PerspectiveCamera(30, 1, 1, 1000);
      camera.position.z = 100;
      const sent = (mesh) => {
        const before = {bytes, textures}, scene = new THREE.Scene();
        mesh.frustumCulled = false;
        scene.add(mesh);
        renderer.render(scene, camera);
        return {bytes: bytes - before.bytes, textures: textures - before.textures};
      };
      const result = {};
      for (const Made of [SweepfaceMesh, SweepfaceGpuMesh]) {
        const mesh = new Made(await load());
        mesh.setWeights(pose);
        mesh.update();
        result[Made.name] = {first: sent(mesh), twin: sent(mesh.clone().clone()), vertices: mesh.face.vertexCount,
                             index: mesh.geometry.index.array.byteLength};
      }
      return result;
    });
    const {SweepfaceMesh: cpu, SweepfaceGpuMesh: gpu} = found;
    assert.ok(cpu.first.bytes > 24 * cpu.vertices);
    assert.equal(cpu.twin.bytes, 24 * cpu.vertices + cpu.index);  // positions and normals
    assert.ok(gpu.first.bytes > 72 * gpu.vertices);
    assert.deepEqual(gpu.twin, {bytes: gpu.index, textures: gpu.first.textures - 1});  // only the modes are its own
    assert.deepEqual(complaints, []);
  });

  await t.test('goes on where clones go, in any order', async () => {
    const found = await page.evaluate(async () => {
      const THREE = await import('three');
      const {SweepfaceMesh} = await import('./sweepface_three.js');
      const {SweepfaceGpuMesh} = await import('./sweepface_gpu.js');
      const {pose, load} = globalThis, canvas = new OffscreenCanvas(64, 64), renderer = new THREE.WebGLRenderer({canvas});
      const camera = new THREE.PerspectiveCamera(30, 1, 1, 1000), result = [];
      camera.position.z = 100;
      for (const Made of [SweepfaceMesh, SweepfaceGpuMesh])
        for (const order of [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]])
          for (const isWhole of [true, false]) {
            const scene = new THREE.Scene(), model = new Made(await load());
            const meshes = [model, model.clone()], triangles = [];
            meshes.push(meshes[1].clone());
            scene.add(...meshes);
            for (const mesh of meshes) mesh.frustumCulled = false;
            const draw = () => {
              for (const mesh of scene.children) mesh.setWeights(pose), mesh.update();
              renderer.render(scene, camera);
              triangles.push(renderer.info.render.triangles);
            };
            draw();
            for (const k of order) {
              // Or the geometry alone, as code that clears scenes does: it is drawn again all the same.
              if (isWhole) for (let twice = 0; twice < 2; ++twice) scene.remove(meshes[k]), meshes[k].dispose();
              else meshes[k].geometry.dispose();
              draw();
            }
            for (const mesh of meshes) mesh.dispose();
            const {geometries, textures} = renderer.info.memory;
            result.push({triangles: triangles.map((count) => count / triangles[0]), isWhole, geometries, textures});
          }
      return result;
    });
    for (const {triangles, isWhole, geometries, textures} of found) {
      assert.deepEqual(triangles.map((share) => Math.round(3 * share)), isWhole ? [3, 2, 1, 0] : [3, 3, 3, 3]);
      assert.equal(geometries, 0);
      assert.equal(textures, found[0].textures);  // the renderer's own: that mesh has none
    }
    assert.deepEqual(complaints, []);
  });

  await t.test('goes with materials that are put in later', async () => {
    const found = await page.evaluate(async () => {
      const THREE = await import('three');
      const {SweepfaceGpuMesh} = await import('./sweepface_gpu.js');
      const {pose, load} = globalThis, size = 256, scene = new THREE.Scene();
      const renderer = new THREE.WebGLRenderer({canvas: new OffscreenCanvas(size, size), antialias: false});
      const target = new THREE.WebGLRenderTarget(size, size), camera = new THREE.PerspectiveCamera(30, 1, 1, 1000);
      const draw = (mesh) => {
        mesh.geometry.computeBoundingSphere();
        const {center, radius} = mesh.geometry.boundingSphere, pixels = new Uint8Array(4 * size * size);
        camera.position.copy(center).add(new THREE.Vector3(0, 0, 4.2 * radius));
        scene.add(mesh);
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
        scene.remove(mesh);
        return pixels;
      };
      const differing = (a, b) => a.filter((value, k) => value !== b[k]).length;
      const given = new SweepfaceGpuMesh(await load(), new THREE.MeshNormalMaterial());
      const late = new SweepfaceGpuMesh(await load()), put = new THREE.MeshNormalMaterial();
      const neutral = draw(given);
      for (const mesh of [given, late]) mesh.setWeights(pose);
      late.update();
      late.material = put;
      for (const mesh of [given, late]) mesh.update();
      const posed = draw(given), result = {moved: differing(posed, neutral), off: differing(posed, draw(late))};
      const refused = (act) => { try { act(); } catch (error) { return error.message; } };
      given.material = put;
      result.message = refused(() => given.update());
      late.material = new THREE.MeshBasicMaterial();
      late.update();
      given.update();
      result.again = differing(posed, draw(given));
      given.material = late.material;
      late.material = new THREE.MeshBasicMaterial();
      for (const mesh of [late, given]) mesh.update();
      result.programs = renderer.info.programs.length;
      return result;
    });
    assert.ok(found.moved > 1000, `${found.moved}`);
    assert.equal(found.off, 0);
    assert.match(found.message, /follows a face already/);
    assert.equal(found.again, 0, 'a material that a face has left follows another');
    assert.equal(found.programs, 0, 'what a renderer made of a material goes when the face leaves it');
    assert.deepEqual(complaints, []);
  });
}));
