// What the meshes of sweepface/three, sweepface/gpu and sweepface/webgpu have in common.
import {BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshStandardMaterial} from 'three';
import {Pin} from './sweepface_pin.js';
import {isWeight} from './sweepface_values.js';

/** Plain materials, named as in the source. Mouths and lashes are seen from both sides. */
function materialsOf(face) {
  return face.parts.map(({material}) => new MeshStandardMaterial({name: material, roughness: 0.7, side: DoubleSide}));
}

/** The materials that are given, if they can be drawn. */
function materialsFrom(materials, {parts}) {
  const all = [materials].flat(), isEnough = !Array.isArray(materials) || all.length >= parts.length;
  if (isEnough && all.every((material) => material?.isMaterial)) return materials;
  throw new TypeError(`A mesh takes a material, or one for each part of the face, of which there are ${parts.length}.`);
}

/** The face that is given, not what Sweepface.load promises or takes. */
export function faceFrom(face) {
  if (typeof face?.evaluate === 'function') return face;
  throw new TypeError('A mesh is made of a face; await Sweepface.load for it.');
}

/** Nothing that is on the graphics card: WebGPURenderer looks for every attribute that it has drawn. */
const NOTHING = new BufferAttribute(new Float32Array(0), 3);

/**
 * The geometry of a face. What of it stays as it was made, clones have together with it: on the graphics card it is there
 * once, and goes with the last of them (but WebGPURenderer takes it away with the first, and sends it again to draw others).
 */
class FaceGeometry extends BufferGeometry {
  #changing = [];  // names of attributes that follow the weights
  #fixed = {all: new Set(), users: 0};  // the other ones, and how many geometries show them
  #isUser = false;

  /** Everything that is there is fixed, but for attributes that follow the weights. */
  fix(changing) {
    const others = Object.keys(this.attributes).filter((name) => !changing.includes(name));
    this.#changing = changing;
    this.#fixed.all = new Set(others.map((name) => this.attributes[name]));
    return this;
  }

  /** Takes what another geometry of the same file has: what is fixed itself, of what was put into it copies. */
  take(original) {
    const {name, userData, index, attributes, groups, drawRange} = original;
    if (#fixed in original) {
      if (this.#isUser) ++original.#fixed.users;
      this.#fixed = original.#fixed;
    }
    const own = (attribute) => (this.#fixed.all.has(attribute) ? attribute : attribute.clone());
    this.setIndex(index?.clone() ?? null);  // which some put into an order of their own
    for (const key of Object.keys(this.attributes)) if (!attributes[key]) this.deleteAttribute(key);
    for (const [key, attribute] of Object.entries(attributes))
      if (!this.#changing.includes(key)) this.setAttribute(key, own(attribute));
    Object.assign(this, {name, userData, groups: groups.map((group) => ({...group})), drawRange: {...drawRange}});
  }

  /** Renderers listen to what they show. */
  addEventListener(type, listener) {
    super.addEventListener(type, listener);
    if (type !== 'dispose' || this.#isUser) return;
    this.#isUser = true;
    ++this.#fixed.users;
  }

  /** Gives back all but what others show: three.js would take that away from them. */
  dispose() {
    const {attributes} = this, {all} = this.#fixed;
    if (this.#isUser) --this.#fixed.users;
    this.#isUser = false;
    if (this.#fixed.users > 0) {
      const given = ([name, attribute]) => [name, all.has(attribute) ? NOTHING : attribute];
      this.attributes = Object.fromEntries(Object.entries(attributes).map(given));
    }
    super.dispose();
    this.attributes = attributes;
  }
}

/**
 * The triangles of a face, its texture coordinates and a group for each part, with attributes by name, those that follow
 * the weights and others.
 */
export function geometryOf(face, changing, fixed = {}) {
  const geometry = new FaceGeometry(), {texcoords} = face;
  geometry.setIndex(new BufferAttribute(face.triangles, 1));
  for (const [name, attribute] of Object.entries({...changing, ...fixed})) geometry.setAttribute(name, attribute);
  if (texcoords) geometry.setAttribute('uv', new BufferAttribute(texcoords, 2));
  face.parts.forEach(({start, count}, k) => geometry.addGroup(start, count, k));
  return geometry.fix(Object.keys(changing));
}

/**
 * What the meshes do each in their own way, under names that no class made of them has: bring weights to the screen, see
 * to what has changed otherwise, tell where rays meet the face and where its vertices stand, and have of a mesh what its
 * clone needs not have again.
 */
export const show = Symbol('show'), follow = Symbol('follow'), meet = Symbol('meet'), share = Symbol('share');
export const materialsOfClone = Symbol('materialsOfClone'), standing = Symbol('standing');

/**
 * A face in a scene. Weights are set at any time; `update` brings them to the screen. They stand in
 * `morphTargetInfluences`, too, and are taken from there, so that what moves morph targets moves a face.
 */
export class FaceMesh extends Mesh {
  #stale = true;
  #moving;
  #isGone = false;
  #told = [];  // the influences, as they were told last
  #positions;
  #pose = {};  // another object whenever another pose is shown

  constructor(face, geometry, materials = materialsOf(face)) {
    super(geometry, materialsFrom(materials, face));
    this.face = face;
    this.#moving = face.advance(0);
    this.morphTargetDictionary = Object.fromEntries(face.names.map((name, k) => [name, k]));
    this.morphTargetInfluences = face.names.map(() => 0);
    this.#tellInfluences();
  }

  get names() { return this.face.names; }
  get weights() { return this.face.weights; }
  get pose() { return this.face.pose; }
  get eyeCount() { return this.face.eyeCount; }
  get regions() { return this.face.regions; }

  weightsIn(region) { return this.face.weightsIn(region); }

  look(pose) {
    this.face.look(pose);
    this.#stale = true;
  }

  setWeights(weights, region) {
    this.#takeInfluences();
    this.face.setWeights(weights, region);
    this.#tellInfluences();
  }

  reset() {
    this.face.reset();
    this.#tellInfluences();
  }

  moveTo(goals, drive, region) {
    this.#takeInfluences();
    this.face.moveTo(goals, drive, region);
    this.#moving = true;
  }

  push(name, velocityChange, drag) {
    this.#takeInfluences();
    this.face.push(name, velocityChange, drag);
    this.#moving = true;
  }

  /** Lets time pass without showing it; says whether anything goes on moving. */
  advance(seconds) {
    this.#takeInfluences();
    const moving = this.face.advance(seconds);
    if (moving || this.#moving) this.#tellInfluences();  // once more where it stopped
    return this.#moving = moving;
  }

  /** Sets the weights whose influences were set. What is no number changes nothing: others may write it. */
  #takeInfluences() {
    const influences = this.morphTargetInfluences ?? [], {face} = this;
    const isSet = (told, k) => influences[k] !== told && isWeight(influences[k]);
    if (!this.#told.some(isSet)) return;
    const set = face.names.map((name, k) => [name, influences[k]]).filter((_, k) => isSet(this.#told[k], k));
    face.setWeights(Object.fromEntries(set));
    this.#tellInfluences();
  }

  /** Weights have changed: they are to be shown, and the influences are what they are, as far as there are any. */
  #tellInfluences() {
    const influences = this.morphTargetInfluences ?? [];
    this.#told = Array.from(this.face.weightValues, (weight, k) => {
      if (k < influences.length) Reflect.set(influences, k, weight);  // a frozen one stays as it is
      return influences[k];  // or rounded, or none
    });
    this.#stale = true;
  }

  /** Call it once a frame with the seconds since the last; costs nothing where nothing moves. */
  update(seconds = 0) {
    if (this.#isGone) return;
    this.#takeInfluences();
    if ((this.#moving && seconds > 0) || !Number.isFinite(seconds)) this.advance(seconds);
    this[follow]();
    if (this.#stale) {
      this[show]();
      this.#pose = {};
    }
    this.#stale = false;
    this.#movePins();
  }

  /** Adds an object that follows the point of the skin nearest to a point, and turns with it. */
  pin(point) {
    this.update();
    const pin = new Pin().fasten(point, this.face.triangles, this[standing](), this.#pose);
    this.add(pin);
    return pin;
  }

  /** Brings pins to the pose that is shown, which new ones may not have seen. */
  #movePins() {
    const size = 3 * this.face.vertexCount;
    const behind = this.children.filter((child) => child instanceof Pin && child.isBehind(size, this.#pose));
    if (behind.length === 0) return;
    const positions = this[standing]();
    for (const pin of behind) pin.follow(positions, this.#pose);
  }

  [standing]() {
    this.#positions ??= new Float32Array(3 * this.face.vertexCount);
    this.face.evaluate(this.#positions, null);
    return this.#positions;
  }

  /** Makes ready to move, which else happens when it first does and takes a few frames. */
  prepare() { this.face.prepare(); }

  [follow]() {}

  raycast(raycaster, hits) {
    if (!this.#isGone) this[meet](raycaster, hits);
  }

  [meet](raycaster, hits) { super.raycast(raycaster, hits); }

  /** Another face of the same file that stands as this one, and moves by itself. */
  clone(recursive) {
    this.#takeInfluences();
    this.morphTargetInfluences ??= undefined;  // null is not what three.js copies
    const face = this.face.clone(), regions = face.regions.length > 0 ? face.regions : [undefined];
    for (const region of regions) {
      const weights = region === undefined ? this.face.weights : this.face.weightsIn(region);
      const set = Object.entries(weights).filter(([, weight]) => weight !== 0);  // none: nothing is to be read for it
      face.setWeights(Object.fromEntries(set), region);
    }
    if (this.face.pose) face.look(this.face.pose);
    const materials = this[materialsOfClone](), lacks = face.parts.length - materials.length;  // where groups are others
    const filled = lacks > 0 ? [...materials, ...Array(lacks).fill(materials.at(-1))] : materials;
    const twin = new this.constructor(face, filled).copy(this, recursive);
    if (lacks > 0) twin.material = materials;
    twin[share](this);
    twin.traverse((part) => {
      if (part.geometry === this.geometry) part.geometry = twin.geometry;
    });
    twin.#movePins();
    return twin;
  }

  [share](original) { this.geometry.take?.(original.geometry); }

  [materialsOfClone]() { return Array.isArray(this.material) ? this.material.slice() : this.material; }

  /** What three.js copies of a mesh, but for what follows this face. */
  copy(source, recursive) {
    const {geometry, material, morphTargetDictionary, morphTargetInfluences} = this;
    super.copy(source, recursive);
    return Object.assign(this, {geometry, material, morphTargetDictionary, morphTargetInfluences});
  }

  dispose() {
    this.#isGone = true;
    this.geometry.dispose();
    for (const material of [this.material].flat()) material?.dispose();
    this.face.dispose();
  }
}
