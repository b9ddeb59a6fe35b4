// .sweep faces that a vertex shader evaluates: a mesh for three.js, and the shader for others. Every frame only the
// modes of the weights go to the graphics card, less than a tenth of a megabyte (docs/evaluation.md).
import {
  BufferAttribute, DataTexture, MeshDepthMaterial, MeshDistanceMaterial, NearestFilter, RGBADepthPacking,
  RGBAIntegerFormat, ShortType
} from 'three';
import {FaceMesh, geometryOf} from './sweepface_mesh.js';

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
function texture(numbers) {
  const height = Math.max(1, Math.ceil(numbers.length / (4 * WIDTH)));
  const data = new Int16Array(4 * WIDTH * height);
  data.set(numbers);
  const made = new DataTexture(data, WIDTH, height, RGBAIntegerFormat, ShortType);
  made.internalFormat = 'RGBA16I';
  made.minFilter = made.magFilter = NearestFilter;
  made.needsUpdate = true;
  return made;
}

/** The tables of positions or of tangents as textures. */
class Tables {
  constructor(face, tangents) {
    const {basis, places, neutral, modes} = face.shaderTables(tangents);
    this.tangents = tangents;
    this.places = places;
    this.neutral = neutral;
    this.modeCount = modes;
    this.basis = texture(basis);
    this.modes = texture(new Int16Array(4 * modes));
    this.factor = {value: 0};
  }

  update(face) {
    this.factor.value = face.shaderModes(this.modes.image.data.subarray(0, 4 * this.modeCount), this.tangents);
    this.modes.needsUpdate = true;
  }

  get bytes() { return this.basis.image.data.byteLength + this.modes.image.data.byteLength; }

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

/** A face in a scene that follows its weights without its vertices leaving the graphics card. */
export class SweepfaceGpuMesh extends FaceMesh {
  #tables;

  constructor(face, materials) {
    const positions = new Tables(face, false), tangents = new Tables(face, true);
    const geometry = geometryOf(face, {
      position: spread(face, positions.neutral, 3),
      sweepPlace: spread(face, positions.places, 3),
      sweepTangentPlace: spread(face, tangents.places, 3),
      normal: spread(face, tangents.neutral, 3, 0, 6),  // along the sweep
      sweepAcross: spread(face, tangents.neutral, 3, 3, 6)
    });
    super(face, geometry, materials);
    this.frustumCulled = false;  // bounds are those of the neutral
    this.#tables = [positions, tangents];
    this.customDepthMaterial = new MeshDepthMaterial({depthPacking: RGBADepthPacking});  // for shadows
    this.customDistanceMaterial = new MeshDistanceMaterial();
    for (const material of this.#materials) this.#patch(material);
    this.update();
  }

  get #materials() { return [this.material, this.customDepthMaterial, this.customDistanceMaterial].flat(); }

  #patch(material) {
    const [positions, tangents] = this.#tables;
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, {
        sweepBasis: {value: positions.basis}, sweepModes: {value: positions.modes},
        sweepTangentBasis: {value: tangents.basis}, sweepTangentModes: {value: tangents.modes},
        sweepFactor: positions.factor  // of the weights, and so that of tangents
      });
      shader.vertexShader = `
        uniform highp isampler2D sweepBasis, sweepTangentBasis, sweepModes, sweepTangentModes;
        uniform float sweepFactor;
        in uvec3 sweepPlace, sweepTangentPlace;
        in vec3 sweepAcross;
        ${SWEEPFACE_GLSL}
        ` + shader.vertexShader
        .replace('#include <beginnormal_vertex>', `
          vec3 objectNormal = sweepfaceNormal(
            normal, sweepAcross, sweepTangentPlace, sweepTangentBasis, sweepTangentModes, sweepFactor);`)
        .replace('#include <begin_vertex>', `
          vec3 transformed = sweepfacePosition(position, sweepPlace, sweepBasis, sweepModes, sweepFactor);`);
    };
  }

  /** Bytes of textures on the graphics card, and of them those that change every frame. */
  get textureBytes() { return this.#tables.reduce((sum, {bytes}) => sum + bytes, 0); }
  get frameBytes() { return this.#tables.reduce((sum, {modes}) => sum + modes.image.data.byteLength, 0); }

  show() {
    for (const tables of this.#tables) tables.update(this.face);
  }

  dispose() {
    for (const tables of this.#tables) tables.dispose();
    this.customDepthMaterial.dispose();
    this.customDistanceMaterial.dispose();
    super.dispose();
  }
}
