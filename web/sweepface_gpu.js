// .sweep faces that a vertex shader evaluates: a mesh for three.js, and the shader for others. Every frame only the
// modes of the weights go to the graphics card, about a tenth of a megabyte (docs/evaluation.md).
import {BufferAttribute, DataTexture, FloatType, NearestFilter, RGBAFormat, RGBAIntegerFormat, ShortType} from 'three';
import {FaceMesh, geometryOf} from './sweepface_mesh.js';

/** GLSL ES 3: a row of a face, from its neutral, its place and the two textures. */
export const SWEEPFACE_GLSL = `
  vec3 sweepfaceRow(vec3 neutral, uvec2 place, int row, highp isampler2D basis, highp sampler2D modes) {
    int texels = int(place.y & 63u), first = int(place.x) + row * texels, at = int(place.y >> 6);
    int basisWidth = textureSize(basis, 0).x, modesWidth = textureSize(modes, 0).x;
    vec3 sum = vec3(0.0);
    for (int t = 0; t < texels; ++t) {
      int b = first + t;
      vec4 x = vec4(texelFetch(basis, ivec2(b % basisWidth, b / basisWidth), 0));
      for (int k = 0; k < 4; ++k) {
        int m = at + 4 * t + k;
        sum += x[k] * texelFetch(modes, ivec2(m % modesWidth, m / modesWidth), 0).xyz;
      }
    }
    return neutral + sum;
  }`;

const WIDTH = 1024;

/** A texture of four numbers a texel, filled up to whole rows. */
function texture(numbers, format, type, internalFormat) {
  const height = Math.max(1, Math.ceil(numbers.length / (4 * WIDTH)));
  const data = new numbers.constructor(4 * WIDTH * height);
  data.set(numbers);
  const made = new DataTexture(data, WIDTH, height, format, type);
  made.internalFormat = internalFormat;
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
    this.basis = texture(basis, RGBAIntegerFormat, ShortType, 'RGBA16I');
    this.modes = texture(new Float32Array(4 * modes), RGBAFormat, FloatType, 'RGBA32F');
  }

  update(face) {
    face.shaderModes(this.modes.image.data.subarray(0, 4 * this.modeCount), this.tangents);
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
      sweepPlace: spread(face, positions.places, 2),
      sweepTangentPlace: spread(face, tangents.places, 2),
      normal: spread(face, tangents.neutral, 3, 0, 6),  // along the sweep
      sweepAcross: spread(face, tangents.neutral, 3, 3, 6)
    });
    super(face, geometry, materials);
    this.frustumCulled = false;  // bounds are those of the neutral
    this.#tables = [positions, tangents];
    for (const material of [this.material].flat()) this.#patch(material);
    this.update();
  }

  #patch(material) {
    const [positions, tangents] = this.#tables;
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, {
        sweepBasis: {value: positions.basis}, sweepModes: {value: positions.modes},
        sweepTangentBasis: {value: tangents.basis}, sweepTangentModes: {value: tangents.modes}
      });
      shader.vertexShader = `
        uniform highp isampler2D sweepBasis, sweepTangentBasis;
        uniform highp sampler2D sweepModes, sweepTangentModes;
        in uvec2 sweepPlace, sweepTangentPlace;
        in vec3 sweepAcross;
        ${SWEEPFACE_GLSL}
        ` + shader.vertexShader
        .replace('#include <beginnormal_vertex>', `
          vec3 objectNormal = normalize(cross(
            sweepfaceRow(normal, sweepTangentPlace, 0, sweepTangentBasis, sweepTangentModes),
            sweepfaceRow(sweepAcross, sweepTangentPlace, 1, sweepTangentBasis, sweepTangentModes)));`)
        .replace('#include <begin_vertex>', `
          vec3 transformed = sweepfaceRow(position, sweepPlace, 0, sweepBasis, sweepModes);`);
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
    super.dispose();
  }
}
