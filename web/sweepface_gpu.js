// .sweep faces evaluated in a vertex shader: a mesh for three.js, and the shader for other engines. Every frame only
// the modes of the weights are uploaded, less than a tenth of a megabyte (docs/evaluation.md).
import {GLSL3, MeshDepthMaterial, MeshDistanceMaterial, RGBADepthPacking, RGBAIntegerFormat, ShortType} from 'three';
import {CardMesh} from './sweepface_card.js';
import {card, complain, refuse} from './sweepface_followers.js';

/** GLSL ES 3 that moves a vertex from its neutral. Texel k of a texture is at (k mod 1024, k / 1024). */
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

const INTEGERS = {Data: Int16Array, perTexel: 4, format: RGBAIntegerFormat, type: ShortType, internalFormat: 'RGBA16I'};

/** After this the shaders of materials move vertices. */
const PLACE = '#include <begin_vertex>';

/** How materials of WebGLRenderer follow a face. */
const BY_CHUNKS = {
  integers: INTEGERS,
  names: ['onBeforeCompile', 'customProgramCacheKey'],

  check(material) {
    if (!material.isShaderMaterial) return;
    if (!material.vertexShader.includes(PLACE))
      refuse(material, `has no \`${PLACE}\` in its vertex shader, to follow the face by; have it, and use \`transformed\``);
    if (material.isRawShaderMaterial && material.glslVersion !== GLSL3)
      refuse(material, 'is written in GLSL ES 1, which reads no face; set its glslVersion to GLSL3');
  },

  hooks(material, {textures, linear, upright}) {
    const {onBeforeCompile, customProgramCacheKey} = material;
    return {
      customProgramCacheKey: () => 'sweepface' + onBeforeCompile + customProgramCacheKey.call(material),
      onBeforeCompile(shader, renderer) {
        onBeforeCompile.call(material, shader, renderer);
        if (!shader.vertexShader.includes(PLACE))
          console.error(`The material '${material.name || material.type}' shows the neutral, as its onBeforeCompile takes ` +
                        `away \`${PLACE}\`; keep that, and change \`transformed\` after it.`);
        shader.uniforms = {  // a copy, as materials may have theirs in common
          ...shader.uniforms, sweepBasis: {value: textures.basis}, sweepModes: {value: textures.modes},
          sweepFactor: {get value() { return textures.factor; }}, sweepLinear: {value: linear}, sweepUpright: {value: upright}
        };
        shader.vertexShader = `
          uniform highp isampler2D sweepBasis, sweepModes;
          uniform float sweepFactor;
          uniform mat3 sweepLinear, sweepUpright;
          in uvec3 sweepPlace, sweepTangentPlace, sweepAlong, sweepAcross;
          ${SWEEPFACE_GLSL}
          ` + shader.vertexShader
          .replace('#include <beginnormal_vertex>', `$&
            objectNormal = sweepfaceUnit(sweepUpright * sweepfaceNormal(
              uintBitsToFloat(sweepAlong), uintBitsToFloat(sweepAcross), sweepTangentPlace, sweepBasis, sweepModes,
              sweepFactor));`)
          .replace(PLACE, `$&
            transformed = position + sweepLinear * sweepfacePosition(
              vec3(0.0), sweepPlace, sweepBasis, sweepModes, sweepFactor);`);
      }
    };
  },

  shadows: () => ({
    customDepthMaterial: new MeshDepthMaterial({depthPacking: RGBADepthPacking}),
    customDistanceMaterial: new MeshDistanceMaterial()
  }),

  drawn() {},

  meet(renderer) {
    if (renderer.isRenderer) complain('SweepfaceGpuMesh', 'WebGPURenderer', 'SweepfaceNodeMesh');
  }
};

/** A face in a scene that follows its weights without its vertices leaving the graphics card. */
export class SweepfaceGpuMesh extends CardMesh {
  static get [card]() { return BY_CHUNKS; }
}
