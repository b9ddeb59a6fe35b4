// What the vertex shaders of sweepface/gpu and sweepface/webgpu read: tables in textures, and attributes that point into
// them.
import {
  BufferAttribute, DataTexture, InterleavedBuffer, InterleavedBufferAttribute, NearestFilter, Vector3
} from 'three';
import {faceFrom} from './sweepface_values.js';

/** Texels in a row: texel k of a texture is at (k mod 1024, k / 1024). */
const WIDTH = 1024;

/** A texture of four 16-bit integers per texel, padded to whole rows. `integers` say how it holds them. */
function texture({Data, perTexel, ...settings}, count, ...parts) {
  const height = Math.max(1, Math.ceil(count / (4 * WIDTH))), data = new Data(perTexel * WIDTH * height);
  const made = Object.assign(new DataTexture(data, WIDTH, height), settings);
  made.minFilter = made.magFilter = NearestFilter;
  made.needsUpdate = true;
  const numbers = numbersOf(made);
  parts.reduce((at, part) => (numbers.set(part, at), at + part.length), 0);
  return made;
}

const numbersOf = ({image: {data}}) => new Int16Array(data.buffer, data.byteOffset, data.byteLength / 2);

/** The tables of positions, followed in the same textures by those of tangents. All clones of a face share the basis. */
class Textures {
  #tables;  // {between, end, integers, basis}: where modes end, how textures hold integers, {texture, users}
  #isGone = false;

  constructor(tables) {
    this.#tables = tables;
    this.modes = texture(tables.integers, tables.end);
    this.factor = 0;  // depends on the weights alone, and so is the same for both
    ++tables.basis.users;
  }

  get basis() { return this.#tables.basis.texture; }

  /** Those of a clone. */
  twin() { return new Textures(this.#tables); }

  share(original) {
    this.#tables = original.#tables;
    ++this.#tables.basis.users;
  }

  update(face) {
    const numbers = numbersOf(this.modes), {between, end} = this.#tables;
    this.factor = face.shaderModes(numbers.subarray(0, between));
    face.shaderModes(numbers.subarray(between, end), true);
    this.modes.needsUpdate = true;
  }

  dispose() {
    if (this.#isGone) return;
    this.#isGone = true;
    if (--this.#tables.basis.users === 0) this.basis.dispose();
    this.modes.dispose();
  }
}

/** The tables of positions and of tangents; places in the latter are those behind the former. */
export function tablesOf(face) {
  const positions = faceFrom(face).shaderTables(), tangents = face.shaderTables(true);
  for (let k = 0; k < tangents.places.length; k += 3) {
    tangents.places[k] += positions.basis.length / 4;
    tangents.places[k + 1] += 64 * positions.modes;
  }
  return {positions, tangents};
}

/** `integers` is {Data, perTexel} and the members to set on a texture that holds four 16-bit integers per texel. */
export function texturesOf({positions, tangents}, integers) {
  const between = 4 * positions.modes, end = between + 4 * tangents.modes;
  const basis = texture(integers, positions.basis.length + tangents.basis.length, positions.basis, tangents.basis);
  return new Textures({between, end, integers, basis: {texture: basis, users: 0}});
}

/** Copies the `size` numbers that each point has in `from`, to `at` in every `stride` numbers. */
function spread(points, size, from, to, stride, at) {
  points.forEach((point, v) => {
    for (let k = 0; k < size; ++k) to[stride * v + at + k] = from[size * point + k];
  });
}

/** Likewise the normals of surfaces that have tangents [count x 2 x 3]. */
function spreadNormals(points, tangents, to, stride, at) {
  const along = new Vector3(), across = new Vector3();
  points.forEach((point, v) => {
    along.fromArray(tangents, 6 * point).normalize();
    across.fromArray(tangents, 6 * point + 3).normalize();
    along.cross(across).normalize().toArray(to, stride * v + at);
  });
}

/** An attribute of the three from `at` on of every `stride` numbers. */
function separate(numbers, stride, at) {
  const own = new numbers.constructor(3 * numbers.length / stride);
  for (let k = 0; k < own.length; ++k) own[k] = numbers[stride * Math.floor(k / 3) + at + k % 3];
  return new BufferAttribute(own, 3);
}

/**
 * The attributes of vertices that are these points of a face, an Uint32Array; `inFewBuffers` for meshes that have many
 * others, as WebGPU allows only eight buffers.
 */
export function attributesOf({positions, tangents}, points, inFewBuffers = false) {
  const floats = new Float32Array(6 * points.length), words = new Uint32Array(12 * points.length);
  // Shaders get what they read in whole words, and turn tangents back into floats.
  const bits = new Uint32Array(tangents.neutral.buffer, tangents.neutral.byteOffset, tangents.neutral.length);
  spread(points, 3, positions.neutral, floats, 6, 0);
  spreadNormals(points, tangents.neutral, floats, 6, 3);
  spread(points, 3, positions.places, words, 12, 0);
  spread(points, 3, tangents.places, words, 12, 3);
  spread(points, 6, bits, words, 12, 6);
  const named = (names, numbers) => {
    const stride = 3 * names.length, buffer = new InterleavedBuffer(numbers, stride);
    return names.map((name, k) => {
      return [name, inFewBuffers ? new InterleavedBufferAttribute(buffer, 3, 3 * k) : separate(numbers, stride, 3 * k)];
    });
  };
  return Object.fromEntries([
    ...named(['position', 'normal'], floats),  // normals are for materials that do not follow the face
    ...named(['sweepPlace', 'sweepTangentPlace', 'sweepAlong', 'sweepAcross'], words)
  ]);
}
