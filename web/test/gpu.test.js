import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {blank, skip, withPage} from './browser.js';
import {sample} from './native.js';

const face = readFileSync(process.env.SWEEPFACE_GPU_FACE ?? sample);
const files = {'blank.html': blank, 'face.sweep': face};

/** In the page: a face, weights for it, and what WebGL is given to upload. */
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

/** In the page: a table of rows as a vertex shader has them, by transform feedback. */
async function onTheCard(tangents) {
  const {SWEEPFACE_GLSL} = await import('./sweepface_gpu.js');
  const {face} = globalThis, tables = face.shaderTables(tangents), rows = tangents ? 2 : 1, count = face.pointCount;
  const gl = new OffscreenCanvas(1, 1).getContext('webgl2'), program = gl.createProgram();
  const shader = (type, source) => {
    const made = gl.createShader(type);
    gl.shaderSource(made, '#version 300 es\nprecision highp float;\n' + source);
    gl.compileShader(made);
    if (!gl.getShaderParameter(made, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(made));
    gl.attachShader(program, made);
  };
  shader(gl.VERTEX_SHADER, `uniform highp isampler2D basis; uniform highp sampler2D modes; uniform int row;
    in uvec2 place; in vec3 neutral; out vec3 result; ${SWEEPFACE_GLSL}
    void main() { result = sweepfaceRow(neutral, place, row, basis, modes); gl_Position = vec4(0); }`);
  shader(gl.FRAGMENT_SHADER, 'void main() {}');
  gl.bindAttribLocation(program, 0, 'place');
  gl.bindAttribLocation(program, 1, 'neutral');
  gl.transformFeedbackVaryings(program, ['result'], gl.INTERLEAVED_ATTRIBS);
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  const width = 1024;
  const texture = (unit, name, numbers, internal, format, type) => {
    const height = Math.max(1, Math.ceil(numbers.length / 4 / width));
    const data = new numbers.constructor(4 * width * height);
    data.set(numbers);
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, type, data);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    gl.uniform1i(gl.getUniformLocation(program, name), unit);
  };
  const modes = new Float32Array(4 * tables.modes);
  face.shaderModes(modes, tangents);
  texture(0, 'basis', tables.basis, gl.RGBA16I, gl.RGBA_INTEGER, gl.SHORT);
  texture(1, 'modes', modes, gl.RGBA32F, gl.RGBA, gl.FLOAT);
  const buffer = (target, data) => {
    gl.bindBuffer(target, gl.createBuffer());
    gl.bufferData(target, data, gl.STATIC_DRAW);
  };
  buffer(gl.ARRAY_BUFFER, tables.places);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribIPointer(0, 2, gl.UNSIGNED_INT, 0, 0);
  buffer(gl.ARRAY_BUFFER, tables.neutral);
  gl.enableVertexAttribArray(1);
  gl.enable(gl.RASTERIZER_DISCARD);
  const results = [];
  for (let row = 0; row < rows; ++row) {
    gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 12 * rows, 12 * row);
    gl.uniform1i(gl.getUniformLocation(program, 'row'), row);
    const out = gl.createBuffer();
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, out);
    gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 12 * count, gl.STREAM_READ);
    gl.beginTransformFeedback(gl.POINTS);
    gl.drawArrays(gl.POINTS, 0, count);
    gl.endTransformFeedback();
    const values = new Float32Array(3 * count);
    gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, values);
    results.push(values);
  }
  return results;
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
        const [places] = await onTheCard(false), [along, across] = await onTheCard(true);
        for (let k = 0; k < 3 * points; ++k) {
          most = Math.max(most, Math.abs(places[k] - positions[k]));
          moved = Math.max(moved, Math.abs(neutral[k] - positions[k]));
          size = Math.max(size, Math.abs(positions[k]));
        }
        for (let v = 0; v < points; ++v) {
          const [a, b] = [along, across].map((x) => x.subarray(3 * v, 3 * v + 3));
          const n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
          const length = Math.hypot(...n);
          for (let k = 0; k < 3 && length > 1e-3; ++k)
            turned = Math.max(turned, Math.abs(n[k] / length - normals[3 * v + k]));
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
      const {pose, load} = globalThis, size = 256;
      const renderer = new THREE.WebGLRenderer({canvas: new OffscreenCanvas(size, size), antialias: false});
      const target = new THREE.WebGLRenderTarget(size, size);
      const onCpu = new SweepfaceMesh(await load()), onGpu = new SweepfaceGpuMesh(await load());
      const sphere = (onCpu.geometry.computeBoundingSphere(), onCpu.geometry.boundingSphere);
      const camera = new THREE.PerspectiveCamera(30, 1, sphere.radius, 9 * sphere.radius);
      camera.position.copy(sphere.center).add(new THREE.Vector3(0, 0, 4.2 * sphere.radius));
      const light = new THREE.DirectionalLight(0xffffff, 3);
      light.position.set(1, 1, 2);

      const morphs = () => {  // the same face as three.js has it
        const face = onCpu.face, geometry = onCpu.geometry.clone(), at = (weights, normals) => {
          const out = new Float32Array(3 * face.vertexCount), other = new Float32Array(3 * face.vertexCount);
          face.reset();
          face.setWeights(weights);
          face.evaluate(out, other);
          return normals ? other : out;
        };
        geometry.setAttribute('position', new THREE.BufferAttribute(at({}), 3));
        geometry.setAttribute('normal', new THREE.BufferAttribute(at({}, true), 3));
        const minus = (a, b) => new THREE.BufferAttribute(a.map((x, k) => x - b[k]), 3);
        const {position, normal} = geometry.attributes;
        geometry.morphTargetsRelative = true;
        geometry.morphAttributes.position = face.names.map((name) => minus(at({[name]: 1}), position.array));
        geometry.morphAttributes.normal = face.names.map((name) => minus(at({[name]: 1}, true), normal.array));
        return new THREE.Mesh(geometry, onCpu.material);
      };

      const draw = (mesh) => {
        const scene = new THREE.Scene();
        scene.add(mesh, light, new THREE.AmbientLight(0xffffff, 0.5));
        const before = globalThis.uploaded, pixels = new Uint8Array(4 * size * size);
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
        return {pixels, uploaded: globalThis.uploaded - before};
      };
      const differ = (a, b) => {  // the share of pixels that anyone would tell apart
        let count = 0;
        for (let k = 0; k < a.length; k += 4)
          count += Math.max(...[0, 1, 2].map((c) => Math.abs(a[k + c] - b[k + c]))) > 24;
        return 4 * count / a.length;
      };
      const morph = morphs(), meshes = {onCpu, onGpu, morph}, result = {};
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
      return result;
    });
    console.log('bytes uploaded:', JSON.stringify(found));
    assert.ok(found.moved > 0.005, 'the pose changes nothing');
    assert.ok(found.atRest < 0.001 && found.posed < 0.001, `${found.posed} of the pixels differ`);
    assert.ok(found.likeMorphs < 0.05, `${found.likeMorphs} of the pixels differ from morph targets`);
    assert.ok(found.onGpu.first < 0.5 * found.morph.first);
    assert.ok(found.onGpu.everyFrame < found.onCpu.everyFrame);
    assert.deepEqual(complaints, []);
  });
}));
