// What the meshes of sweepface/three and sweepface/gpu have in common.
import {BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshStandardMaterial} from 'three';

/** Plain materials, named as in the source. Mouths and lashes are seen from both sides. */
function materialsOf(face) {
  return face.parts.map(({material}) => new MeshStandardMaterial({name: material, roughness: 0.7, side: DoubleSide}));
}

/** The materials that are given, if they can be drawn. */
function materialsFrom(materials) {
  const all = [materials].flat();
  if (all.length > 0 && all.every((material) => material?.isMaterial)) return materials;
  throw new TypeError('A mesh takes a material, or one for each part of the face.');
}

/** The face that is given, not what Sweepface.load promises or takes. */
export function faceFrom(face) {
  if (typeof face?.evaluate === 'function') return face;
  throw new TypeError('A mesh is made of a face; await Sweepface.load for it.');
}

/** The triangles of a face, its texture coordinates and a group for each part, with attributes by name. */
export function geometryOf(face, attributes) {
  const geometry = new BufferGeometry(), {texcoords} = face;
  geometry.setIndex(new BufferAttribute(face.triangles, 1));
  for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
  if (texcoords) geometry.setAttribute('uv', new BufferAttribute(texcoords, 2));
  face.parts.forEach(({start, count}, k) => geometry.addGroup(start, count, k));
  return geometry;
}

/** Gives a geometry what was put into another of the same face: attributes, groups and what of it is drawn. */
function addTo(geometry, {name, userData, attributes, groups, drawRange}) {
  for (const [key, attribute] of Object.entries(attributes))
    if (!geometry.hasAttribute(key)) geometry.setAttribute(key, attribute.clone());
  Object.assign(geometry, {name, userData, groups: groups.map((group) => ({...group})), drawRange: {...drawRange}});
}

/**
 * A face in a scene. Weights are set at any time; `update` has `show` bring them to the screen, `prepare` see to what has
 * changed otherwise, and `raycast` has `meet` tell where rays meet it.
 */
export class FaceMesh extends Mesh {
  #stale = true;
  #moving;
  #isGone = false;

  constructor(face, geometry, materials = materialsOf(face)) {
    super(geometry, materialsFrom(materials));
    this.face = face;
    this.#moving = face.advance(0);
  }

  get names() { return this.face.names; }
  get eyeCount() { return this.face.eyeCount; }
  get regions() { return this.face.regions; }

  look(pose) {
    this.face.look(pose);
    this.#stale = true;
  }

  setWeights(weights, region) {
    this.face.setWeights(weights, region);
    this.#stale = true;
  }

  reset() {
    this.face.reset();
    this.#stale = true;
  }

  moveTo(goals, drive, region) {
    this.face.moveTo(goals, drive, region);
    this.#moving = true;
  }

  push(name, velocityChange, drag) {
    this.face.push(name, velocityChange, drag);
    this.#moving = true;
  }

  /** Lets time pass without showing it; says whether anything goes on moving. */
  advance(seconds) {
    const moving = this.face.advance(seconds);
    this.#stale ||= moving || this.#moving;  // once more where it stopped
    return this.#moving = moving;
  }

  /** Call it once a frame with the seconds since the last; costs nothing where nothing moves. */
  update(seconds = 0) {
    if (this.#isGone) return;
    if ((this.#moving && seconds > 0) || !Number.isFinite(seconds)) this.advance(seconds);
    this.prepare();
    if (this.#stale) this.show();
    this.#stale = false;
  }

  prepare() {}

  raycast(raycaster, hits) {
    if (!this.#isGone) this.meet(raycaster, hits);
  }

  meet(raycaster, hits) { super.raycast(raycaster, hits); }

  /** Another face of the same file that stands as this one, and moves by itself. */
  clone(recursive) {
    const face = this.face.clone(), regions = face.regions.length > 0 ? face.regions : [undefined];
    for (const region of regions) {
      const weights = region === undefined ? this.face.weights : this.face.weightsIn(region);
      const set = Object.entries(weights).filter(([, weight]) => weight !== 0);  // none: nothing is to be read for it
      face.setWeights(Object.fromEntries(set), region);
    }
    if (this.face.pose) face.look(this.face.pose);
    const twin = new this.constructor(face, this.materialsOfClone()).copy(this, recursive);
    addTo(twin.geometry, this.geometry);
    twin.traverse((part) => {
      if (part.geometry === this.geometry) part.geometry = twin.geometry;
    });
    return twin;
  }

  materialsOfClone() { return Array.isArray(this.material) ? this.material.slice() : this.material; }

  /** What three.js copies of a mesh, but for what follows this face. */
  copy(source, recursive) {
    const {geometry, material} = this;
    super.copy(source, recursive);
    return Object.assign(this, {geometry, material});
  }

  dispose() {
    this.#isGone = true;
    this.geometry.dispose();
    for (const material of [this.material].flat()) material.dispose();
    this.face.dispose();
  }
}
