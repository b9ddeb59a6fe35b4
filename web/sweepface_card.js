// Shared by the meshes of sweepface/gpu and sweepface/webgpu: tables in textures, the attributes that point into them,
// and materials that follow one face each.
import {BufferAttribute, DataTexture, NearestFilter, Vector3} from 'three';
import {geometryOf} from './sweepface_geometry.js';
import {FaceMesh, materialsOfClone, meet, share} from './sweepface_mesh.js';
import {expression, follow, show} from './sweepface_moved.js';
import {faceFrom} from './sweepface_values.js';

/** Texels in a row: texel k of a texture is at (k mod 1024, k / 1024). */
const WIDTH = 1024;

/** A texture of four 16-bit integers per texel, padded to whole rows. Its first parameter is CardMesh's `kind`. */
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

/**
 * What the shader reads: the tables of positions, followed in the same textures by those of tangents. All clones share
 * the basis.
 */
class Textures {
  #basis;
  #isGone = false;

  constructor({positions, tangents}, kind) {
    this.between = 4 * positions.modes;
    this.end = this.between + 4 * tangents.modes;
    const basis = texture(kind, positions.basis.length + tangents.basis.length, positions.basis, tangents.basis);
    this.#basis = {texture: basis, users: 1};
    this.modes = texture(kind, this.end);
    this.factor = 0;  // depends on the weights alone, and so is the same for both
  }

  get basis() { return this.#basis.texture; }

  share(original) {
    this.#basis = original.#basis;
    ++this.#basis.users;
  }

  update(face) {
    const numbers = numbersOf(this.modes);
    this.factor = face.shaderModes(numbers.subarray(0, this.between));
    face.shaderModes(numbers.subarray(this.between, this.end), true);
    this.modes.needsUpdate = true;
  }

  dispose() {
    if (this.#isGone) return;
    this.#isGone = true;
    if (--this.#basis.users === 0) this.basis.dispose();
    this.modes.dispose();
  }
}

/** The tables of positions and of tangents; places in the latter are those behind the former. */
function tablesOf(face) {
  const positions = faceFrom(face).shaderTables(), tangents = face.shaderTables(true);
  for (let k = 0; k < tangents.places.length; k += 3) {
    tangents.places[k] += positions.basis.length / 4;
    tangents.places[k + 1] += 64 * positions.modes;
  }
  return {positions, tangents};
}

/** An attribute that gives every vertex the numbers of its point. */
function spread(face, perPoint, size, from = 0, stride = size) {
  const points = face.pointCount, copies = face.copies, out = new perPoint.constructor(size * face.vertexCount);
  for (let v = 0; v < face.vertexCount; ++v) {
    const point = v < points ? v : copies[v - points];
    for (let k = 0; k < size; ++k) out[size * v + k] = perPoint[stride * point + from + k];
  }
  return new BufferAttribute(out, size);
}

/** The normals of points, from tangents [points x 2 x 3]. */
function normalsOf(tangents) {
  const normals = new Float32Array(tangents.length / 2), along = new Vector3(), across = new Vector3();
  for (let at = 0; at < normals.length; at += 3) {
    along.fromArray(tangents, 2 * at);
    across.fromArray(tangents, 2 * at + 3);
    along.normalize().cross(across.normalize()).normalize().toArray(normals, at);
  }
  return normals;
}

const attributesOf = (face, {positions, tangents}) => ({
  position: spread(face, positions.neutral, 3),
  sweepPlace: spread(face, positions.places, 3),
  sweepTangentPlace: spread(face, tangents.places, 3),
  normal: spread(face, normalsOf(tangents.neutral), 3),  // for materials that do not follow the face
  sweepAlong: spread(face, tangents.neutral, 3, 0, 6),
  sweepAcross: spread(face, tangents.neutral, 3, 3, 6)
});

/**
 * For materials that follow a face: the `hooks` that the mesh put on them, by the names of members, and what was there
 * `before`, as {hooks: {positionNode: the face's}, before: {positionNode: the material's own or null}}.
 */
const hooked = new WeakMap();

/** Says once for each kind of mesh that a renderer, which must not be stopped in the middle of a frame, cannot draw it. */
const complained = new Set();
export function complain(kind, renderer, instead) {
  if (complained.has(kind)) return;
  complained.add(kind);
  console.error(`${renderer} draws the neutral of every ${kind}; make a ${instead} for it.`);
}

export function refuse(material, what) {
  throw new TypeError(`The material '${material.name || material.type}' ${what}.`);
}

/**
 * What each kind of mesh defines for itself: the names of the members that it sets on a material that is to follow the
 * face, their values by these names, and a check that refuses materials. `textures` are what its shader reads; a clone
 * takes over their `basis` from its original.
 */
export const hookNames = Symbol('hookNames'), hooksFor = Symbol('hooksFor'), check = Symbol('check');
export const textures = Symbol('textures');

/** A face in a scene whose vertices are evaluated in the vertex shader. */
export class CardMesh extends FaceMesh {
  #textures;
  #followers = new Set();  // materials that follow the face
  #met = {};  // the face as it stood when a ray came last: attributes, and their bounding sphere

  /** `kind` says how textures hold integers: {Data, perTexel} and the members to set on them. */
  constructor(face, materials, kind) {
    const tables = tablesOf(face);
    super(face, geometryOf(face, {}, attributesOf(face, tables)), materials);
    this.frustumCulled = false;  // bounds are those of the neutral
    this.#textures = new Textures(tables, kind);
  }

  get [textures]() { return this.#textures; }

  /** Makes the mesh's current materials, and no others, follow the face. */
  [follow]() {
    const {material, customDepthMaterial, customDistanceMaterial} = this;
    const all = new Set([material, customDepthMaterial, customDistanceMaterial].flat().filter(Boolean));
    const fresh = [...all].filter((each) => !this.#isFollowing(each));
    for (const each of fresh) {  // check all before changing any
      if (hooked.has(each) && !this.#followers.has(each)) refuse(each, 'follows a face already; give each mesh a clone() of it');
      this[check](each);
    }
    for (const each of this.#followers) if (!all.has(each) || fresh.includes(each)) this.#release(each);
    for (const each of fresh) this.#patch(each);
  }

  /** Whether a material still has all the hooks that this mesh put on it. */
  #isFollowing(material) {
    if (!this.#followers.has(material)) return false;
    const {hooks} = hooked.get(material);
    return this[hookNames].every((name) => material[name] === hooks[name]);
  }

  /** A material's own members, in place of which the mesh puts its hooks. */
  #hooksOf(material) {
    return hooked.get(material)?.before ?? Object.fromEntries(this[hookNames].map((name) => [name, material[name] ?? null]));
  }

  #patch(material) {
    material.dispose();  // programs that a renderer made of it before know no face, or another
    const before = this.#hooksOf(material), hooks = this[hooksFor](material);
    this.#followers.add(material);
    hooked.set(material, {before, hooks});
    Object.assign(material, hooks);
    material.needsUpdate = true;
  }

  #release(material) {
    material.dispose();
    const {before, hooks} = hooked.get(material);
    for (const hook of this[hookNames])  // a member that was replaced since stays
      if (material[hook] === hooks[hook]) material[hook] = before[hook];
    material.needsUpdate = true;
    hooked.delete(material);
    this.#followers.delete(material);
  }

  /** Bytes of all textures on the graphics card, and of the part that changes every frame. */
  get textureBytes() { return this.#textures.basis.image.data.byteLength + this.frameBytes; }
  get frameBytes() { return this.#textures.modes.image.data.byteLength; }

  [show]() { this.#textures.update(this.face); }

  /** The attributes of the current pose, evaluated here because the geometry's own hold the neutral. */
  #stand({position, normal}) {
    const names = normal ? 'positions and normals' : 'positions', met = this.#met;
    if (met.at === this[expression] && met.names === names && met.position.array.length === position.array.length) return met;
    const made = () => new BufferAttribute(new Float32Array(position.array.length), 3);
    this.#met = {at: this[expression], names, position: made(), ...(normal && {normal: made()}), sphere: null};
    this.face.evaluate(this.#met.position.array, this.#met.normal?.array);
    return this.#met;
  }

  /** Intersects rays with the face in its current pose. Trees of triangles, as of three-mesh-bvh, are of the neutral. */
  [meet](raycaster, hits) {
    const {geometry} = this, {attributes, boundingSphere, boundingBox, boundsTree} = geometry;
    const met = this.#stand(attributes), {position, normal} = met;
    const standing = {...attributes, position, ...(normal && {normal})};
    Object.assign(geometry, {attributes: standing, boundingSphere: met.sphere, boundingBox: null});
    if (boundsTree) geometry.boundsTree = undefined;
    try {
      super[meet](raycaster, hits);
      met.sphere = geometry.boundingSphere;
    } finally {
      Object.assign(geometry, {attributes, boundingSphere, boundingBox}, boundsTree && {boundsTree});
    }
  }

  [share](original) {
    super[share](original);
    this.#textures.share(original.#textures);
  }

  /** Clones of the materials, each of which follows one face only. */
  [materialsOfClone]() {
    const clone = (material) => Object.assign(material.clone(), this.#hooksOf(material));
    return Array.isArray(this.material) ? this.material.map(clone) : clone(this.material);
  }

  dispose() {
    this.#textures.dispose();
    super.dispose();
    for (const material of this.#followers) this.#release(material);
  }
}
