// .sweep faces that a vertex shader evaluates: a mesh for three.js, and the shader for others. Every frame only the
// modes of the weights go to the graphics card, less than a tenth of a megabyte (docs/evaluation.md).
import {
  BufferAttribute, DataTexture, GLSL3, MeshDepthMaterial, MeshDistanceMaterial, NearestFilter, RGBADepthPacking,
  RGBAIntegerFormat, ShortType, Vector3
} from 'three';
import {FaceMesh, faceFrom, follow, geometryOf, materialsOfClone, meet, share, show} from './sweepface_mesh.js';

/** GLSL ES 3: what moves a vertex from its neutral. Texel k of a texture is at (k mod 1024, k / 1024). */
export const SWEEPFACE_GLSL = `
  ivec2 sweepfaceTexel(int k) { return ivec2(k & 1023, k >> 10); }
  vec4 sweepfaceBasis(highp isampler2D basis, int k) { return vec4(texelFetch(basis, sweepfaceTexel(k), 0)); }
  vec3 sweepfaceMode(highp isampler2D modes, int k) { return vec3(texelFetch(modes, sweepfaceTexel(k), 0).xyz); }
  mat4x3 sweepfaceModes(highp isampler2D modes, int k) {
    return mat4x3(sweepfaceMode(modes, k), sweepfaceMode(modes, k + 1),
                  sweepfaceMode(modes, k + 2), sweepfaceMode(modes, k + 3));
  }
  vec3 sweepfaceUnit(vec3 a) { return a * inversesqrt(max(dot(a, a), 1e-36)); }  // finite at poles

  vec3 sweepfacePosition(vec3 neutral, uvec3 place, highp isampler2D basis, highp isampler2D modes, float factor) {
    int first = int(place.x), at = int(place.y >> 6), texels = int(place.y & 63u);
    vec3 sum = vec3(0.0);
    for (int t = 0; t < texels; ++t)
      sum += sweepfaceModes(modes, at + 4 * t) * sweepfaceBasis(basis, first + t);
    return neutral + uintBitsToFloat(place.z) * factor * sum;
  }

  vec3 sweepfaceNormal(vec3 along, vec3 across, uvec3 place, highp isampler2D basis, highp isampler2D modes,
                       float factor) {
    int first = int(place.x), at = int(place.y >> 6), texels = int(place.y & 63u);
    vec3 a = vec3(0.0), b = vec3(0.0);
    for (int t = 0; t < texels; ++t) {
      mat4x3 four = sweepfaceModes(modes, at + 4 * t);
      a += four * sweepfaceBasis(basis, first + t);
      b += four * sweepfaceBasis(basis, first + texels + t);
    }
    float scale = uintBitsToFloat(place.z) * factor;
    return sweepfaceUnit(cross(sweepfaceUnit(along + scale * a), sweepfaceUnit(across + scale * b)));
  }`;

const WIDTH = 1024;

/** A texture of four integers a texel, filled up to whole rows. */
function texture(length, ...parts) {
  const height = Math.max(1, Math.ceil(length / (4 * WIDTH))), data = new Int16Array(4 * WIDTH * height);
  parts.reduce((at, part) => (data.set(part, at), at + part.length), 0);
  const made = new DataTexture(data, WIDTH, height, RGBAIntegerFormat, ShortType);
  made.internalFormat = 'RGBA16I';
  made.minFilter = made.magFilter = NearestFilter;
  made.needsUpdate = true;
  return made;
}

/** What the shader reads: the tables of positions and, behind them in the same textures, those of tangents. */
class Textures {
  constructor(positions, tangents) {
    for (let k = 0; k < tangents.places.length; k += 3) {
      tangents.places[k] += positions.basis.length / 4;
      tangents.places[k + 1] += 64 * positions.modes;
    }
    this.between = 4 * positions.modes;
    this.end = this.between + 4 * tangents.modes;
    this.basis = texture(positions.basis.length + tangents.basis.length, positions.basis, tangents.basis);
    this.modes = texture(this.end);
    this.factor = {value: 0};  // of the weights, and so the same for both
  }

  update(face) {
    const numbers = this.modes.image.data;
    this.factor.value = face.shaderModes(numbers.subarray(0, this.between));
    face.shaderModes(numbers.subarray(this.between, this.end), true);
    this.modes.needsUpdate = true;
  }

  dispose() {
    this.basis.dispose();
    this.modes.dispose();
  }
}

/** For every vertex the numbers of its point. */
function spread(face, perPoint, size, from = 0, stride = size) {
  const points = face.pointCount, copies = face.copies, out = new perPoint.constructor(size * face.vertexCount);
  for (let v = 0; v < face.vertexCount; ++v) {
    const point = v < points ? v : copies[v - points];
    for (let k = 0; k < size; ++k) out[size * v + k] = perPoint[stride * point + from + k];
  }
  return new BufferAttribute(out, size);
}

/** The normals of points whose tangents lie behind each other. */
function normalsOf(tangents) {
  const normals = new Float32Array(tangents.length / 2), along = new Vector3(), across = new Vector3();
  for (let at = 0; at < normals.length; at += 3) {
    along.fromArray(tangents, 2 * at);
    across.fromArray(tangents, 2 * at + 3);
    along.normalize().cross(across.normalize()).normalize().toArray(normals, at);
  }
  return normals;
}

/** What materials that follow a face were told of their own before. */
const own = new WeakMap();

/** Refuses a material that cannot follow a face, or follows one. */
function check(material) {
  const refuse = (what) => { throw new TypeError(`The material '${material.name || material.type}' ${what}.`); };
  if (own.has(material)) refuse('follows a face already; give each mesh a clone() of it');
  if (!material.isShaderMaterial) return;
  if (!material.vertexShader.includes('#include <begin_vertex>'))
    refuse('has no `#include <begin_vertex>` in its vertex shader, to follow the face by; have it, and use `transformed`');
  if (material.isRawShaderMaterial && material.glslVersion !== GLSL3)
    refuse('is written in GLSL ES 1, which reads no face; set its glslVersion to GLSL3');
}

/** A face in a scene that follows its weights without its vertices leaving the graphics card. */
export class SweepfaceGpuMesh extends FaceMesh {
  #textures;
  #followers = new Set();  // materials

  constructor(face, materials) {
    const positions = faceFrom(face).shaderTables(), tangents = face.shaderTables(true);
    const textures = new Textures(positions, tangents);
    const geometry = geometryOf(face, {}, {
      position: spread(face, positions.neutral, 3),
      sweepPlace: spread(face, positions.places, 3),
      sweepTangentPlace: spread(face, tangents.places, 3),
      normal: spread(face, normalsOf(tangents.neutral), 3),  // for materials that do not follow the face
      sweepAlong: spread(face, tangents.neutral, 3, 0, 6),
      sweepAcross: spread(face, tangents.neutral, 3, 3, 6)
    });
    super(face, geometry, materials);
    this.frustumCulled = false;  // bounds are those of the neutral
    this.#textures = textures;
    this.customDepthMaterial = new MeshDepthMaterial({depthPacking: RGBADepthPacking});  // for shadows
    this.customDistanceMaterial = new MeshDistanceMaterial();
    this.update();
  }

  /** Has the face followed by the materials that it has now, and by no others. */
  [follow]() {
    const {material, customDepthMaterial, customDistanceMaterial} = this;
    const all = new Set([material, customDepthMaterial, customDistanceMaterial].flat().filter(Boolean));
    const fresh = [...all].filter((each) => !this.#followers.has(each));
    fresh.forEach(check);  // all before the first is changed
    for (const each of this.#followers) if (!all.has(each)) this.#release(each);
    for (const each of fresh) this.#patch(each);
  }

  #patch(material) {
    const textures = this.#textures, {modes, factor} = textures;
    material.dispose();  // what a renderer made of it before knows no face, or another
    const {onBeforeCompile, customProgramCacheKey} = material;
    const hooks = {customProgramCacheKey: () => 'sweepface' + onBeforeCompile + customProgramCacheKey.call(material)};
    this.#followers.add(material);
    own.set(material, {before: {onBeforeCompile, customProgramCacheKey}, hooks});
    hooks.onBeforeCompile = (shader, renderer) => {
      onBeforeCompile.call(material, shader, renderer);
      Object.assign(shader.uniforms, {sweepBasis: {value: textures.basis}, sweepModes: {value: modes}, sweepFactor: factor});
      shader.vertexShader = `
        uniform highp isampler2D sweepBasis, sweepModes;
        uniform float sweepFactor;
        in uvec3 sweepPlace, sweepTangentPlace;
        in vec3 sweepAlong, sweepAcross;
        ${SWEEPFACE_GLSL}
        ` + shader.vertexShader
        .replace('#include <beginnormal_vertex>', `$&
          objectNormal = sweepfaceNormal(
            sweepAlong, sweepAcross, sweepTangentPlace, sweepBasis, sweepModes, sweepFactor);`)
        .replace('#include <begin_vertex>', `$&
          transformed = sweepfacePosition(position, sweepPlace, sweepBasis, sweepModes, sweepFactor);`);
    };
    Object.assign(material, hooks);
  }

  #release(material) {
    material.dispose();
    const {before, hooks} = own.get(material);
    for (const hook of Object.keys(hooks))  // what was put in its place later stays
      if (material[hook] === hooks[hook]) material[hook] = before[hook];
    own.delete(material);
    this.#followers.delete(material);
  }

  /** Bytes of textures on the graphics card, and of them those that change every frame. */
  get textureBytes() { return this.#textures.basis.image.data.byteLength + this.frameBytes; }
  get frameBytes() { return this.#textures.modes.image.data.byteLength; }

  [show]() { this.#textures.update(this.face); }

  /** Rays meet the face as it stands, which the attributes do not tell: it is evaluated for them. */
  [meet](raycaster, hits) {
    const {geometry} = this, {attributes, boundingSphere, boundingBox} = geometry;
    const standing = {};
    for (const name of ['position', 'normal'])
      if (attributes[name]) standing[name] = new BufferAttribute(new Float32Array(attributes[name].array.length), 3);
    this.face.evaluate(standing.position.array, standing.normal?.array);
    Object.assign(geometry, {attributes: {...attributes, ...standing}, boundingSphere: null, boundingBox: null});
    try {
      super[meet](raycaster, hits);
    } finally {
      Object.assign(geometry, {attributes, boundingSphere, boundingBox});
    }
  }

  /** Also the basis, whose textures have one image, which three.js keeps until the last of them goes. */
  [share](original) {
    super[share](original);
    this.#textures.basis = original.#textures.basis.clone();
  }

  /** Materials follow one face each. */
  [materialsOfClone]() {
    const clone = (material) => {
      const {onBeforeCompile, customProgramCacheKey} = own.get(material)?.before ?? material;
      return Object.assign(material.clone(), {onBeforeCompile, customProgramCacheKey});
    };
    return Array.isArray(this.material) ? this.material.map(clone) : clone(this.material);
  }

  dispose() {
    this.#textures.dispose();
    super.dispose();
    for (const material of this.#followers) this.#release(material);
  }
}
