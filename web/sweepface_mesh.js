// Shared by the meshes of sweepface/three, sweepface/gpu and sweepface/webgpu.
import {DoubleSide, Mesh, MeshStandardMaterial} from 'three';
import {begin, isGone, movedByWeights, release, shown, takeInfluences} from './sweepface_moved.js';
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
    this[begin](face, [{mesh: this, names: face.names}]);
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

  [release]() {
    this.#group.delete(this.#self);
    this.geometry.dispose();
    const inUse = new Set([...this.#group].flatMap((other) => other.deref()?.material ?? []));
    for (const material of [this.material].flat()) if (!inUse.has(material)) material?.dispose();
  }
}
