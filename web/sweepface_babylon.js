// .sweep faces for Babylon.js: a mesh whose geometry follows the weights.
import {VertexBuffer} from '@babylonjs/core/Buffers/buffer.js';
import {EngineStore} from '@babylonjs/core/Engines/engineStore.js';
import {MultiMaterial} from '@babylonjs/core/Materials/multiMaterial.js';
import {StandardMaterial} from '@babylonjs/core/Materials/standardMaterial.js';
import {Mesh} from '@babylonjs/core/Meshes/mesh.js';
import {VertexData} from '@babylonjs/core/Meshes/mesh.vertexData.js';
import {SubMesh} from '@babylonjs/core/Meshes/subMesh.js';
import {bound, endsOf} from './sweepface_babylon_bounds.js';
import {eachFrame} from './sweepface_babylon_frames.js';
import {checkScene, loadFor, nameIn} from './sweepface_babylon_source.js';
import {twinOf} from './sweepface_twin.js';
import {faceFrom, otherGeometry} from './sweepface_values.js';

/** Materials that meshes made for themselves. */
const made = new WeakSet();

/** Plain materials, named as in the source; seen from both sides, as mouths and lashes are. */
function materialsOf(face, scene) {
  return face.parts.map(({material}) => {
    const plain = new StandardMaterial(material, scene);
    plain.backFaceCulling = false;
    plain.twoSidedLighting = true;
    plain.specularColor.set(0.1, 0.1, 0.1);
    made.add(plain);
    return plain;
  });
}

/** Disposes of a material that was made here, and of its parts, once nothing shows them. */
function release(material) {
  const holds = ({subMaterials}) => subMaterials.includes(material);
  if (!made.has(material) || material.getBindedMeshes().length > 0 || material.getScene().multiMaterials.some(holds)) return;
  made.delete(material);
  const parts = material.subMaterials ?? [];
  material.dispose();
  parts.forEach(release);
}

/** The triangles the other way around, as right-handed scenes have them. */
const reversed = (triangles) => triangles.map((_, k) => triangles[k + [0, 1, -1][k % 3]]);

/** What a clone has in common with its original, besides place, pivot and parent. */
const COPIED = [
  'advancesWithScene', 'isVisible', 'visibility', 'isPickable', 'receiveShadows', 'renderingGroupId', 'layerMask',
  'alphaIndex', 'billboardMode', 'checkCollisions', 'alwaysSelectAsActiveMesh', 'metadata'
];

/** What Babylon.js gives to `clone` after the name: a node, or options when it clones a mesh with its children. */
function cloning(parent, doNotCloneChildren) {
  return !parent || typeof parent.getClassName === 'function' ? {parent, doNotCloneChildren} : {...parent};
}

/** A face in a scene. Weights can be set at any time; each time the scene is rendered, it moves on and follows them. */
export class SweepfaceMesh extends Mesh {
  /** Whether time passes with the frames of the scene; false where something else, such as a TimelinePlayer, advances it. */
  advancesWithScene = true;

  #vectors;
  #stale = true;
  #moving;
  #leave = () => {};  // the frames of the scene
  #material;  // that it was made with
  #isMirrored;

  /** Loads a face from a URL, or from bytes; `options` are those of Sweepface.load, and `load`, loadInWorker. */
  static async load(source, scene, options = {}) {
    return loadFor(scene, source, options, async (bytes, load, usual, url) => {
      return SweepfaceMesh.#from.call(this, await load(bytes, usual), nameIn(url), scene);
    });
  }

  static #from(face, name, scene) {
    try {
      if (scene?.isDisposed) throw new Error('The scene was disposed of while the face was loading.');
      return new this(name, scene, face);
    } catch (error) {
      face.dispose();
      throw error;
    }
  }

  /** The mesh disposes of the face with itself. Materials are made for its parts if none is given. */
  constructor(name, scene, face, material) {
    faceFrom(face);
    checkScene(scene ?? EngineStore.LastCreatedScene);
    if (material && typeof material.isReady !== 'function')
      throw new TypeError('A mesh takes a Material of Babylon.js, or none.');
    const moving = face.advance(0);  // throws if it was disposed of, before the scene has a mesh of it
    super(name, scene);
    this.face = face;
    this.#moving = moving;
    try {
      this.#show(material);
    } catch (error) {  // as when there is no memory left
      super.dispose();
      throw error;
    }
  }

  #show(material) {
    const {face} = this;
    this.#isMirrored = !this.getScene().useRightHandedSystem;
    this.#vectors = [VertexBuffer.PositionKind, VertexBuffer.NormalKind].map((kind) => {
      return {kind, values: new Float32Array(3 * face.vertexCount)};
    });
    this.#makeGeometry();
    this.material = this.#material = material ?? this.#makeMaterial();
    const pass = (seconds) => this.#pass(this.advancesWithScene ? seconds : 0);
    this.#leave = eachFrame(this.getScene(), pass, () => this.update());
  }

  #makeGeometry() {
    const {face} = this, data = new VertexData();
    this.#evaluate();
    [data.positions, data.normals] = this.#vectors.map(({values}) => values);
    data.indices = this.#isMirrored ? face.triangles : reversed(face.triangles);
    if (face.texcoords) data.uvs = face.texcoords;
    data.applyToMesh(this, true);
    this.releaseSubMeshes();
    face.parts.forEach(({start, count}, k) => new SubMesh(k, 0, face.vertexCount, start, count, this));
    this.#bound();
  }

  #bound() { bound(this, endsOf(this.#vectors[0].values)); }

  #makeMaterial() {
    const plain = materialsOf(this.face, this.getScene());
    if (plain.length === 1) return plain[0];
    const all = new MultiMaterial(this.name, this.getScene());
    all.subMaterials = plain;
    made.add(all);
    return all;
  }

  /** Faces are right-handed, and most scenes are left-handed: they see the mirror image of x. */
  #evaluate() {
    this.face.evaluate(...this.#vectors.map(({values}) => values));
    if (this.#isMirrored)
      for (const {values} of this.#vectors) for (let k = 0; k < values.length; k += 3) values[k] = -values[k];
    this.#stale = false;
  }

  get names() { return this.face.names; }
  get weights() { return this.face.weights; }
  get pose() { return this.face.pose; }
  get eyeCount() { return this.face.eyeCount; }
  get regions() { return this.face.regions; }

  getClassName() { return 'SweepfaceMesh'; }

  weightsIn(region) { return this.face.weightsIn(region); }

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
    this.advance(0);  // cuts are there at once
  }

  push(name, velocityChange, drag) {
    this.face.push(name, velocityChange, drag);
    this.#moving = true;
  }

  /** Lets time pass without showing it; returns whether anything still moves. */
  advance(seconds) {
    this.#moving = this.face.advance(seconds);
    this.#stale = true;
    return this.#moving;
  }

  /** Prepares the face to move. Otherwise that happens at its first move, and takes a few frames. */
  prepare() { this.face.prepare(); }

  #pass(seconds) {
    if (!this.isDisposed() && ((this.#moving && seconds > 0) || !Number.isFinite(seconds))) this.advance(seconds);
  }

  /**
   * Lets time pass and shows it, as the scene does before each frame; costs nothing while nothing moves. Returns whether
   * there is something new to draw, or will be in the next frame.
   */
  update(seconds = 0) {
    this.#pass(seconds);
    if (this.isDisposed()) return false;
    if (!this.#stale) return this.#moving;
    if (this.getTotalVertices() !== this.face.vertexCount) throw otherGeometry(this.face);
    this.#evaluate();
    for (const {kind, values} of this.#vectors) this.updateVerticesData(kind, values);
    this.#bound();
    return true;
  }

  /** Another face of the same file, in the same pose, that moves independently; it shares the material. */
  clone(name = this.name, newParent = null, doNotClone = false) {
    const {parent, doNotCloneChildren} = cloning(newParent, doNotClone);
    const twin = new this.constructor(name, this.getScene(), twinOf(this.face), this.material);
    twin.position.copyFrom(this.position);
    twin.rotation.copyFrom(this.rotation);
    twin.rotationQuaternion = this.rotationQuaternion?.clone() ?? null;
    twin.scaling.copyFrom(this.scaling);
    twin.setPivotMatrix(this.getPivotMatrix(), this._postMultiplyPivotMatrix);
    for (const key of COPIED) twin[key] = this[key];
    twin.setEnabled(this.isEnabled(false));
    twin.parent = parent ?? this.parent;
    if (!doNotCloneChildren)
      for (const child of this.getDescendants(true)) child.clone?.(`${twin.name}.${child.name}`, twin);
    return twin;
  }

  dispose(doNotRecurse, disposeMaterialAndTextures = false) {
    this.#leave();
    const materials = new Set([this.#material, this.material]);
    super.dispose(doNotRecurse, disposeMaterialAndTextures);
    materials.forEach(release);
    this.face.dispose();
  }
}
