// A small model as an artist would export it, for tests of scenes: a skinned head of two materials, one textured, whose
// neck moves; an eye that is scaled and mirrored by its node and shown by two nodes; a hat that does not morph.
import {execFileSync} from 'node:child_process';
import {writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {deflateSync} from 'node:zlib';
import {crc32} from '../sweepface_chunks.js';
import {formatGlb} from '../sweepface_glb.js';
import {newFolder, tool} from './native.js';

const TYPES = {1: 'SCALAR', 2: 'VEC2', 3: 'VEC3', 4: 'VEC4', 16: 'MAT4'};
const COMPONENTS = {Float32Array: 5126, Uint16Array: 5123, Uint8Array: 5121};

/** Collects accessors and views of one buffer. */
class Builder {
  json = {asset: {version: '2.0'}, accessors: [], bufferViews: [], buffers: [{byteLength: 0}]};
  #parts = [];

  view(bytes) {
    const {bufferViews, buffers: [buffer]} = this.json, padding = -bytes.length & 3;
    bufferViews.push({buffer: 0, byteOffset: buffer.byteLength, byteLength: bytes.length});
    this.#parts.push(bytes, new Uint8Array(padding));
    buffer.byteLength += bytes.length + padding;
    return bufferViews.length - 1;
  }

  accessor(array, width, more) {
    const view = this.view(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    const componentType = COMPONENTS[array.constructor.name], {accessors} = this.json;
    accessors.push({bufferView: view, componentType, count: array.length / width, type: TYPES[width], ...more});
    return accessors.length - 1;
  }

  get binary() { return new Uint8Array(Buffer.concat(this.#parts)); }
}

/** A dome of n x n quads: positions, texture coordinates and triangles. */
function dome(n, radius) {
  const positions = [], texcoords = [], quads = [];
  for (let j = 0; j <= n; ++j)
    for (let i = 0; i <= n; ++i) {
      const x = 2 * i / n - 1, y = 2 * j / n - 1;
      positions.push(radius * x, radius * y, radius * (1 - (x * x + y * y) / 2));
      texcoords.push(i / n, j / n);
      const a = j * (n + 1) + i;
      if (i < n && j < n) quads.push([a, a + 1, a + n + 2, a, a + n + 2, a + n + 1]);
    }
  return {positions: new Float32Array(positions), texcoords: new Float32Array(texcoords), quads};
}

/** How a target moves each vertex. */
const deltas = ({positions}, move) => {
  const moved = new Float32Array(positions.length);
  for (let k = 0; k < moved.length; k += 3) moved.set(move(...positions.subarray(k, k + 3)), k);
  return moved;
};
const bump = (x, y) => Math.max(0, 1 - 2 * (x * x + y * y)) ** 2;
const SHAPES = {
  jawOpen: (x, y) => [0, -0.3 * bump(x, y + 0.5), 0], smile: (x, y) => [0.2 * x * bump(x, y), 0, 0.1 * bump(x, y)],
  look: (x, y) => [0.05 * bump(x, y), 0, 0]
};

/** A PNG of one pixel. */
function pixel(...rgb) {
  const chunk = (kind, ...bytes) => {
    const body = Buffer.from([...Buffer.from(kind), ...bytes]), out = Buffer.alloc(body.length + 8);
    out.writeUInt32BE(bytes.length);
    body.copy(out, 4);
    out.writeUInt32BE(crc32(body), body.length + 4);
    return out;
  };
  const header = [0, 0, 0, 1, 0, 0, 0, 1, 8, 2, 0, 0, 0];
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', ...header),
                        chunk('IDAT', ...deflateSync(Buffer.from([0, ...rgb]))), chunk('IEND')]);
}

/** The model as {json, binary}; `imageBytes` is the size of another image in it. */
export function model(imageBytes = 0) {
  const b = new Builder(), head = dome(12, 1), eye = dome(8, 0.1), hat = dome(4, 1);
  const shapes = (mesh, names) => names.map((name) => ({POSITION: b.accessor(deltas(mesh, SHAPES[name]), 3)}));
  const attributes = ({positions, texcoords}) => ({
    POSITION: b.accessor(positions, 3, {min: [-1, -1, -1], max: [1, 1, 1]}),
    NORMAL: b.accessor(positions.map((x, k) => (k % 3 === 2 ? 1 : 0)), 3), TEXCOORD_0: b.accessor(texcoords, 2)
  });
  const indices = (quads) => b.accessor(new Uint16Array(quads.flat()), 1);
  const count = head.positions.length / 3, targets = shapes(head, ['jawOpen', 'smile']);
  const skin = {
    JOINTS_0: b.accessor(Uint8Array.from({length: 4 * count}, (_, k) => (k % 4 === 1 ? 1 : 0)), 4),
    WEIGHTS_0: b.accessor(Float32Array.from({length: 4 * count}, (_, k) => [0.5, 0.5, 0, 0][k % 4]), 4)
  };
  const shared = {...attributes(head), ...skin}, half = head.quads.length / 2;
  const primitives = [[head.quads.slice(0, half), 1], [head.quads.slice(half), 0]].map(([quads, material]) => {
    return {attributes: shared, indices: indices(quads), material, targets};
  });
  const still = Float32Array.from({length: 2 * 16}, (_, k) => (k % 16 % 5 === 0 ? 1 : 0));
  const images = [pixel(200, 120, 80), Buffer.alloc(imageBytes, 7)].filter(({length}) => length > 0);
  const times = b.accessor(new Float32Array([0, 1]), 1, {min: [0], max: [1]});
  return Object.assign(b, {
    json: Object.assign(b.json, {
      scene: 0, scenes: [{nodes: [0, 1, 3, 4, 5]}],
      nodes: [
        {name: 'head', mesh: 0, skin: 0}, {name: 'body', translation: [0, 0, 0], children: [2]},
        {name: 'neck', translation: [0, -1, 0]},
        {name: 'eyeL', mesh: 1, scale: [-2, 2, 2], translation: [0.4, 0.3, 0.9], rotation: [0, 0.6, 0, 0.8]},
        {name: 'eyeR', mesh: 1, scale: [2, 2, 2], translation: [-0.4, 0.3, 0.9], weights: [0]},
        {name: 'hat', mesh: 2, translation: [0, 1, 0]}
      ],
      meshes: [
        {name: 'head', primitives, extras: {targetNames: ['jawOpen', 'smile']}, weights: [0.25, 0]},
        {name: 'eye', extras: {targetNames: ['look']},
         primitives: [{attributes: attributes(eye), indices: indices(eye.quads), material: 0, targets: shapes(eye, ['look'])}]},
        {name: 'hat', primitives: [{attributes: attributes(hat), indices: indices(hat.quads), material: 2}]}
      ],
      skins: [{joints: [1, 2], inverseBindMatrices: b.accessor(still, 16)}],
      materials: [{name: 'skin', pbrMetallicRoughness: {baseColorTexture: {index: 0}, metallicFactor: 0}}, {name: 'lips'},
                  {name: 'felt'}],
      textures: [{source: 0}], images: images.map((bytes) => ({bufferView: b.view(bytes), mimeType: 'image/png'})),
      animations: [{
        name: 'take',
        channels: [{sampler: 0, target: {node: 0, path: 'weights'}}, {sampler: 1, target: {node: 2, path: 'translation'}}],
        samplers: [{input: times, output: b.accessor(new Float32Array([0, 0, 1, 0.5]), 1)},
                   {input: times, output: b.accessor(new Float32Array([0, -1, 0, 0, -2, 0]), 3)}]
      }]
    })
  });
}

/** A packed file of a model, with further options of the tool. */
export function converted({json, binary}, ...options) {
  const folder = newFolder(), glb = join(folder, 'model.glb'), file = join(folder, 'model.sweep');
  writeFileSync(glb, new Uint8Array(formatGlb({json, binary})));
  const all = ['convert', glb, '-o', file, '--tolerance', '0.002', '--pack', '--quiet', ...options];
  execFileSync(tool, all, {stdio: ['ignore', 'ignore', 'pipe']});
  return file;
}

/** The model changed by `change`, as a file. */
export function changed(change, ...options) {
  const made = model();
  change(made.json, made);
  return converted(made, ...options);
}

/** Changes the model: a strip, a fan, and a hat of a face without indices. */
export function inOtherModes(json, builder) {
  const [head, eye, hat] = json.meshes.map(({primitives: [first]}) => first), {accessors} = json;
  const take = (list) => builder.accessor(new Uint16Array(list), 1);
  Object.assign(eye, {mode: 5, indices: take([0, 9, 1, 10, 2, 11, 2, 11, 12, 20, 21])});
  Object.assign(head, {mode: 6, indices: take([14, 0, 1, 2, 15, 28, 27, 26, 13])});
  hat.targets = [{POSITION: hat.attributes.POSITION}];
  delete hat.indices;
  for (const index of Object.values(hat.attributes)) accessors[index].count = 24;
  json.meshes[2].extras = {targetNames: ['lift']};
}

/** Changes the model: the eye has a target of the head's name, too. */
export function smilingEye(json) {
  const [, eye] = json.meshes;
  eye.primitives[0].targets.push(eye.primitives[0].targets[0]);
  eye.extras.targetNames.push('smile');
  delete json.nodes[4].weights;
}

/** Node has no images: three.js complains about each. */
export async function inSilence(act) {
  const {error} = console;
  console.error = () => {};
  try {
    return await act();
  } finally {
    console.error = error;
  }
}

/** What a loader of scenes makes of a file in Node. */
export async function loadScene(bytes, settings) {
  globalThis.self ??= globalThis;  // as GLTFLoader expects it
  globalThis.ProgressEvent ??= Event;  // as FileLoader does
  const {SweepfaceSceneLoader} = await import('../sweepface_scene.js');
  return inSilence(() => new SweepfaceSceneLoader().parseAsync(bytes, {name: 'model.sweep', ...settings}));
}
