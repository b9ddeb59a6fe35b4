// Materials that follow a face: their vertex shaders evaluate it.
import {Matrix3} from 'three';

/**
 * What a class of meshes has under this name says how materials follow a face: `integers`, of textures; the `names` of the
 * members that are set on a material, and `hooks(material, source)`, their values by these names; `check(material)`, which
 * refuses materials; `shadows()`, materials for shadows, as members of meshes; `drawn(object, source)`, called for what
 * will be drawn; and `meet(renderer)`, called before it is.
 */
export const card = Symbol('card');

/** What a shader reads: textures, and what turns displacements and normals to the space of a mesh. */
export const sourceOf = (textures, linear = new Matrix3(), upright = new Matrix3()) => ({textures, linear, upright});

/**
 * For materials that follow a face: the `hooks` that were put on them, by the names of members, and what was there
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

/** For materials that cast shadows: what they were last compiled for. */
const shapes = new WeakMap();

/**
 * Materials that cast a mesh's shadow get what makes holes in a surface from the material that it has, but three.js compiles
 * them only once. Call it before one is drawn.
 */
export function refreshShadow({customDepthMaterial, customDistanceMaterial}, material) {
  if (![customDepthMaterial, customDistanceMaterial].includes(material)) return;
  const {map, alphaMap, displacementMap, alphaTest} = material;
  const shape = [map, alphaMap, displacementMap, alphaTest > 0].map(Boolean).join();
  if (shapes.has(material) && shapes.get(material) !== shape) material.needsUpdate = true;
  shapes.set(material, shape);
}

const isValue = (it) => it?.isColor || it?.isVector2 || it?.isVector3 || it?.isVector4 || it?.isMatrix3 || it?.isEuler;

/** Has a clone of a material go on with colours and other values of the original, so that what changes them changes both. */
function shareValues(clone, {...members}) {
  for (const [key, value] of Object.entries(members))
    if (isValue(value) && Object.hasOwn(clone, key)) clone[key] = value;
  if (members.uniforms) clone.uniforms = {...members.uniforms};
}

/** The materials that follow a face. */
export class Followers {
  #way;  // how they do it: what a class has as `card`
  #source;
  #all = new Set();

  constructor(way, source) {
    this.#way = way;
    this.#source = source;
  }

  /** Makes these materials, and no others, follow the face. */
  follow(materials) {
    const all = new Set(materials), fresh = [...all].filter((each) => !this.#isFollowing(each));
    for (const each of fresh) {  // check all before changing any
      if (this.isTaken(each)) refuse(each, 'follows a face already; give each mesh a clone() of it');
      this.#way.check(each);
    }
    this.keep([...all].filter((each) => !fresh.includes(each)));
    for (const each of fresh) this.#patch(each);
  }

  /** Makes no other materials than these follow the face. */
  keep(materials) {
    for (const each of this.#all) if (!materials.includes(each)) this.#release(each);
  }

  has(material) { return this.#all.has(material); }

  /** Whether a material follows something else. */
  isTaken(material) { return hooked.has(material) && !this.has(material); }

  /** Whether a material still has all the hooks that were put on it. */
  #isFollowing(material) {
    if (!this.#all.has(material)) return false;
    const {hooks} = hooked.get(material);
    return this.#way.names.every((name) => material[name] === hooks[name]);
  }

  /** A material's own members, in place of which there are hooks. */
  #before(material) {
    return hooked.get(material)?.before ??
      Object.fromEntries(this.#way.names.map((name) => [name, material[name] ?? null]));
  }

  #patch(material) {
    material.dispose();  // programs that a renderer made of it before know no face, or another
    const before = this.#before(material), hooks = this.#way.hooks(material, this.#source);
    this.#all.add(material);
    hooked.set(material, {before, hooks});
    Object.assign(material, hooks);
    material.needsUpdate = true;
  }

  #release(material) {
    material.dispose();
    const {before, hooks} = hooked.get(material);
    for (const name of this.#way.names)  // a member that was replaced since stays
      if (material[name] === hooks[name]) material[name] = before[name];
    material.needsUpdate = true;
    hooked.delete(material);
    this.#all.delete(material);
  }

  /** A clone, which follows no face; `sharing` colours and other values or not. */
  cloneOf(material, sharing = false) {
    const clone = material.clone(), {hooks} = hooked.get(material) ?? {};
    for (const [name, before] of Object.entries(this.#before(material)))  // some constructors make members of their own
      if (!Object.hasOwn(clone, name) || (hooks && clone[name] === hooks[name])) clone[name] = before;
    if (sharing) shareValues(clone, material);
    return clone;
  }

  /** No material follows the face from now on. */
  dispose() { this.keep([]); }
}
