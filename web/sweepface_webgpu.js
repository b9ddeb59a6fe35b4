// .sweep faces evaluated in a node shader, for three.js's WebGPURenderer: what sweepface/gpu is for WebGLRenderer
// (docs/evaluation.md), in the shading language that compiles to WGSL with WebGPU and to GLSL without.
import {DataTexture, IntType, REVISION, RGIntegerFormat} from 'three';
import {
  Fn, Loop, attribute, bitcast, cross, float, instancedMesh, int, ivec2, materialReference, normalLocal,
  positionGeometry, positionLocal, positionPrevious, skinning, tangentGeometry, tangentLocal, texture, uniform, vec3,
  vec4
} from 'three/tsl';
import {CardMesh} from './sweepface_card.js';
import {card, complain, refuse, sourceOf} from './sweepface_followers.js';

/** Two 16-bit integers in a 32-bit one, the first in the lower half: WebGPURenderer has no 16-bit integer textures. */
const INTEGERS = {Data: Int32Array, perTexel: 2, format: RGIntegerFormat, type: IntType};

/** Placeholders that are read without a face, as a shader needs textures from the start. */
const nothing = () => Object.assign(new DataTexture(new Int32Array(2), 1, 1, RGIntegerFormat, IntType), {needsUpdate: true});
const NONE = sourceOf({basis: nothing(), modes: nothing(), factor: 0});

/** What is read by mesh or its geometry: one shader serves all faces, and reads that of the one that it draws. */
const sources = new WeakMap();
const drawn = ({object}) => sources.get(object) ?? sources.get(object.geometry) ?? NONE;
const basis = texture(NONE.textures.basis).onObjectUpdate((frame) => drawn(frame).textures.basis);
const modes = texture(NONE.textures.modes).onObjectUpdate((frame) => drawn(frame).textures.modes);

/** Texel k of a texture of 1024 texels a row: four integers. */
function fourAt(table, k) {
  const pair = table.load(ivec2(k.bitAnd(1023), k.shiftRight(10))).xy.toVar();
  const low = (word) => float(word.shiftLeft(16).shiftRight(16)), high = (word) => float(word.shiftRight(16));
  return vec4(low(pair.x), high(pair.x), low(pair.y), high(pair.y));
}

/** What the weights add, before scaling, to `rows` rows of the neutral at a point's `place`. */
function sumOf(place, rows) {
  const first = int(place.x), at = int(place.y.shiftRight(6)).toVar(), texels = int(place.y.bitAnd(63)).toVar();
  const sums = Array.from({length: rows}, () => vec3(0).toVar());
  Loop({start: int(0), end: texels, type: 'int'}, ({i}) => {
    const four = [0, 1, 2, 3].map((k) => fourAt(modes, at.add(i.mul(4)).add(k)).xyz.toVar());
    sums.forEach((sum, row) => {
      const factors = fourAt(basis, first.add(texels.mul(row)).add(i)).toVar();
      ['x', 'y', 'z', 'w'].forEach((axis, k) => sum.addAssign(four[k].mul(factors[axis])));
    });
  });
  return sums;
}

/** A unit vector, finite at poles. */
const unit = (a) => a.mul(a.dot(a).max(1e-36).inverseSqrt());

/** What a displacement map adds. Materials have added it to the neutral before they ask for its position. */
function displacement() {
  const [map, scale, bias] = [['Map', 'texture'], ['Scale', 'float'], ['Bias', 'float']]
    .map(([name, type]) => materialReference(`displacement${name}`, type));
  return normalLocal.mul(map.x.mul(scale).add(bias));
}

/** The position of a vertex, with its normal set on the way; `next`, a material's own node, goes on from there. */
const evaluated = (next) => Fn((builder) => {
  const {material, object, renderer} = builder;
  const factor = uniform(0).onObjectUpdate((frame) => drawn(frame).textures.factor);
  const matrix = (name) => uniform(NONE[name]).onObjectUpdate((frame) => drawn(frame)[name]);
  const place = attribute('sweepPlace', 'uvec3'), tangentPlace = attribute('sweepTangentPlace', 'uvec3');
  const floats = (words) => vec3(...['x', 'y', 'z'].map((axis) => bitcast(words[axis], 'float')));
  const scale = (of) => bitcast(of.z, 'float').mul(factor);
  const [moved] = sumOf(place, 1), [along, across] = sumOf(tangentPlace, 2);
  const row = (name, sum) => unit(floats(attribute(name, 'uvec3')).add(sum.mul(scale(tangentPlace))));
  positionLocal.assign(positionGeometry.add(matrix('linear').mul(moved.mul(scale(place)))));
  if (builder.hasGeometryAttribute('normal'))
    normalLocal.assign(unit(matrix('upright').mul(cross(row('sweepAlong', along), row('sweepAcross', across)))));
  // What the expression has moved would otherwise seem to move every frame.
  const isFollowed = renderer.getMRT()?.has('velocity');
  // Once more, as they have placed the neutral; before 0.185 they come after this.
  const isToCome = Number.parseInt(REVISION) < 185;
  if (object.isSkinnedMesh && !isToCome) {
    if (isFollowed) positionPrevious.assign(positionLocal);
    if (builder.hasGeometryAttribute('tangent')) tangentLocal.assign(tangentGeometry);
    skinning(object).toStack();
  }
  if (material.displacementMap) positionLocal.addAssign(displacement());
  if (object.isInstancedMesh && !isToCome) instancedMesh(object).toStack();
  if (isFollowed && !object.isSkinnedMesh) positionPrevious.assign(positionLocal);
  return next ?? positionLocal;
})();

const ALONE = evaluated();

/** How materials of WebGPURenderer follow a face. */
const BY_NODES = {
  integers: INTEGERS,
  names: ['positionNode', 'castShadowPositionNode'],

  check(material) {
    if (material.isShaderMaterial) refuse(material, 'is written in GLSL, which WebGPURenderer does not draw; take one of nodes');
  },

  hooks({positionNode, castShadowPositionNode}) {
    return {
      positionNode: positionNode ? evaluated(positionNode) : ALONE,
      castShadowPositionNode: castShadowPositionNode ? evaluated(castShadowPositionNode) : null
    };
  },

  shadows: () => ({}),  // are drawn by the same nodes

  drawn(object, source) { sources.set(object, source); },

  meet(renderer) {
    if (renderer.isWebGLRenderer) complain('SweepfaceNodeMesh', 'WebGLRenderer', 'SweepfaceGpuMesh');
  }
};

/** A face in a scene that follows its weights without its vertices leaving the graphics card. */
export class SweepfaceNodeMesh extends CardMesh {
  static get [card]() { return BY_NODES; }
}
