// Shared by the meshes of sweepface/three, sweepface/gpu and sweepface/webgpu.
import {BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshStandardMaterial} from 'three';
import {begin, isGone, movedByWeights, shown, takeInfluences} from './sweepface_moved.js';
import {Pin} from './sweepface_pin.js';
import {twinOf} from './sweepface_twin.js';

/** Plain materials, named as in the source; double-sided, as mouths and lashes are seen from both sides. */
function materialsOf(face) {
  return face.parts.map(({material}) => new MeshStandardMaterial({name: material, roughness: 0.7, side: DoubleSide}));
}

/** The given materials; throws if they cannot be drawn. */
function materialsFrom(materials, {parts}) {
  const all = [materials].flat(), isEnough = !Array.isArray(materials) || all.length >= parts.length;
  if (isEnough && all.every((material) => material?.isMaterial)) return materials;
  throw new TypeError(`A mesh takes a material, or one for each part of the face, of which there are ${parts.length}.`);
}

/** A stand-in that is not on the graphics card: WebGPURenderer looks for every attribute that it has drawn. */
const NOTHING = new BufferAttribute(new Float32Array(0), 3);

/**
 * The geometry of a face. Clones share its fixed attributes: they are on the graphics card once, and are freed with the
 * last of the clones (but WebGPURenderer frees them with the first, and uploads them again to draw others).
 */
class FaceGeometry extends BufferGeometry {
  #changing = [];  // names of attributes that follow the weights
  #fixed = {all: new Set(), users: 0};  // the other attributes, and how many geometries show them
  #isUser = false;
  #isOfFace = false;

  /** Fixes all attributes that are there, except those in `changing`, which follow the weights. */
  fix(changing) {
    const others = Object.keys(this.attributes).filter((name) => !changing.includes(name));
    this.#changing = changing;
    this.#isOfFace = true;
    this.#fixed.all = new Set(others.map((name) => this.attributes[name]));
    return this;
  }

  /** Moving the vertices would last until the next expression. All of three.js's methods that do so come through here. */
  applyMatrix4(matrix) {
    if (!this.#isOfFace) return super.applyMatrix4(matrix);
    throw new Error('The vertices follow the face; move, turn or scale the mesh, or a clone() of its geometry.');
  }

  /** Takes over another geometry of the same file: shares its fixed attributes, and copies what was added to it. */
  take(original) {
    const {name, userData, index, attributes, groups, drawRange} = original;
    if (#fixed in original) {
      if (this.#isUser) ++original.#fixed.users;
      this.#fixed = original.#fixed;
    }
    const own = (attribute) => (this.#fixed.all.has(attribute) ? attribute : attribute.clone());
    this.setIndex(index?.clone() ?? null);  // a copy, as some applications reorder it
    for (const key of Object.keys(this.attributes)) if (!attributes[key]) this.deleteAttribute(key);
    for (const [key, attribute] of Object.entries(attributes))
      if (!this.#changing.includes(key)) this.setAttribute(key, own(attribute));
    Object.assign(this, {name, userData, groups: groups.map((group) => ({...group})), drawRange: {...drawRange}});
  }

  /** Renderers listen to what they show: this geometry then counts as a user of the fixed attributes. */
  addEventListener(type, listener) {
    super.addEventListener(type, listener);
    if (type !== 'dispose' || this.#isUser) return;
    this.#isUser = true;
    ++this.#fixed.users;
  }

  /** Frees all but what other geometries show, which three.js would free as well. */
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
 * The triangles of a face, its texture coordinates and a group for each part, with attributes by name: `changing` ones,
 * which follow the weights, and `fixed` ones.
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
 * What each kind of mesh defines for itself, under names that no class derived from it has by chance: `meet` intersects
 * rays with the face, `share` gives a clone what it need not have twice, and `materialsOfClone` makes a clone's
 * materials. `standing` returns the current positions.
 */
export const meet = Symbol('meet'), share = Symbol('share'), standing = Symbol('standing');
export const materialsOfClone = Symbol('materialsOfClone');

/** A face as one mesh in a scene. Whatever moves morph targets moves it, too. */
export class FaceMesh extends movedByWeights(Mesh) {
  #group = new Set();  // of itself and its clones, which share materials: WeakRefs
  #self = new WeakRef(this);
  #positions;

  constructor(face, geometry, materials = materialsOf(face)) {
    super(geometry, materialsFrom(materials, face));
    this.#group.add(this.#self);
    this.morphTargetDictionary = Object.fromEntries(face.names.map((name, k) => [name, k]));
    this.morphTargetInfluences = face.names.map(() => 0);
    this[begin](face, [{mesh: this, targets: face.names.map((_, k) => k)}]);
  }

  update(seconds) {
    const isNew = super.update(seconds);
    this.#movePins();
    return isNew;
  }

  /** Adds an object that follows the skin at its point nearest to `point`, and turns with it. */
  pin(point) {
    this.update();
    const pin = new Pin().fasten(point, this.face.triangles, this[standing](), this[shown]);
    this.add(pin);
    return pin;
  }

  /** Brings pins to the pose on show, including new ones that have not followed it yet. */
  #movePins() {
    if (this[isGone]) return;
    const size = 3 * this.face.vertexCount;
    const behind = this.children.filter((child) => child instanceof Pin && child.isBehind(size, this[shown]));
    if (behind.length === 0) return;
    const positions = this[standing]();
    for (const pin of behind) pin.follow(positions, this[shown]);
  }

  [standing]() {
    this.#positions ??= new Float32Array(3 * this.face.vertexCount);
    this.face.evaluate(this.#positions, null);
    return this.#positions;
  }

  raycast(raycaster, hits) {
    if (!this[isGone]) this[meet](raycaster, hits);
  }

  [meet](raycaster, hits) { super.raycast(raycaster, hits); }

  /** Another face of the same file, in the same pose, that moves independently. */
  clone(recursive) {
    this[takeInfluences]();
    this.morphTargetInfluences ??= undefined;  // three.js cannot copy null
    const face = twinOf(this.face);
    const materials = this[materialsOfClone](), lacks = face.parts.length - materials.length;  // if groups were changed
    const filled = lacks > 0 ? [...materials, ...Array(lacks).fill(materials.at(-1))] : materials;
    const twin = new this.constructor(face, filled).copy(this, recursive);
    if (lacks > 0) twin.material = materials;
    twin[share](this);
    twin.#group = this.#group.add(twin.#self);
    twin.traverse((part) => {
      if (part.geometry === this.geometry) part.geometry = twin.geometry;
    });
    twin.#movePins();
    return twin;
  }

  [share](original) { this.geometry.take?.(original.geometry); }

  [materialsOfClone]() { return Array.isArray(this.material) ? this.material.slice() : this.material; }

  /** Copies what three.js copies of a mesh, except what follows this face. */
  copy(source, recursive) {
    const {geometry, material, morphTargetDictionary, morphTargetInfluences} = this;
    super.copy(source, recursive);
    return Object.assign(this, {geometry, material, morphTargetDictionary, morphTargetInfluences});
  }

  dispose() {
    super.dispose();
    this.#group.delete(this.#self);
    this.geometry.dispose();
    const inUse = new Set([...this.#group].flatMap((other) => other.deref()?.material ?? []));
    for (const material of [this.material].flat()) if (!inUse.has(material)) material?.dispose();
  }
}
