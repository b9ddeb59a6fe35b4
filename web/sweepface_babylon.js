// .sweep faces for Babylon.js: a mesh whose geometry follows the weights.
import {VertexBuffer} from '@babylonjs/core/Buffers/buffer.js';
import {MultiMaterial} from '@babylonjs/core/Materials/multiMaterial.js';
import {StandardMaterial} from '@babylonjs/core/Materials/standardMaterial.js';
import {Mesh} from '@babylonjs/core/Meshes/mesh.js';
import {VertexData} from '@babylonjs/core/Meshes/mesh.vertexData.js';
import {SubMesh} from '@babylonjs/core/Meshes/subMesh.js';
import {Sweepface} from './sweepface.js';
import {ownRegions} from './sweepface_regions.js';

/** Plain materials, named as in the source; seen from both sides, as mouths and lashes are. */
function materialsOf(face, scene) {
  return face.parts.map(({material}) => {
    const plain = new StandardMaterial(material, scene);
    plain.backFaceCulling = false;
    plain.twoSidedLighting = true;
    plain.specularColor.set(0.1, 0.1, 0.1);
    return plain;
  });
}

/** The triangles the other way around, as right-handed scenes have them. */
const reversed = (triangles) => triangles.map((_, k) => triangles[k + [0, 1, -1][k % 3]]);

/** The seconds that pass with a frame, as for Babylon.js's own animations. */
function passing(scene) {
  if (!scene.animationsEnabled) return 0;
  const milliseconds = scene.useConstantAnimationDeltaTime ? 16 : scene.getEngine().getDeltaTime();
  return Math.max(milliseconds, 0) * scene.animationTimeScale / 1000;
}

async function bytesOf(source) {
  if (typeof source !== 'string' && !(source instanceof URL)) return source;
  const answer = await fetch(source);
  if (answer.ok) return answer.arrayBuffer();
  throw new Error(`${source} cannot be loaded: the server answers ${answer.status} ${answer.statusText}`.trimEnd() + '.');
}

/** A face in a scene. Weights can be set at any time; each time the scene is rendered, it moves on and follows them. */
export class SweepfaceMesh extends Mesh {
  /** Whether time passes with the frames of the scene; false where something else, such as a TimelinePlayer, advances it. */
  advancesWithScene = true;

  #vectors;
  #stale = true;
  #moving;
  #rendering;

  /** Loads a face from a URL, or from bytes; `options` are those of Sweepface.load. */
  static async load(source, scene, options = {}) {
    const usual = {...options}, isUrl = typeof source === 'string' || source instanceof URL;
    if (usual.regions) usual.regions = ownRegions(usual.regions);
    if (isUrl) usual.name ??= String(source);
    const face = await Sweepface.load(await bytesOf(source), usual);
    return new this(isUrl ? String(source).split('/').pop() : 'face', scene, face);
  }

  /** The mesh disposes of the face with itself. Materials are made for its parts if none is given. */
  constructor(name, scene, face, material) {
    if (typeof face?.evaluate !== 'function') throw new TypeError('A mesh is made of a face; await Sweepface.load for it.');
    super(name, scene);
    this.face = face;
    this.#moving = face.advance(0);
    this.#vectors = [VertexBuffer.PositionKind, VertexBuffer.NormalKind].map((kind) => {
      return {kind, values: new Float32Array(3 * face.vertexCount)};
    });
    this.#makeGeometry();
    this.material = material ?? this.#makeMaterial();
    this.#rendering = this.getScene().onBeforeRenderObservable.add((scene) => {
      this.update(this.advancesWithScene ? passing(scene) : 0);
    });
  }

  #makeGeometry() {
    const {face} = this, data = new VertexData();
    this.#evaluate();
    [data.positions, data.normals] = this.#vectors.map(({values}) => values);
    data.indices = this.getScene().useRightHandedSystem ? reversed(face.triangles) : face.triangles;
    if (face.texcoords) data.uvs = face.texcoords;
    data.applyToMesh(this, true);
    this.releaseSubMeshes();
    face.parts.forEach(({start, count}, k) => new SubMesh(k, 0, face.vertexCount, start, count, this));
  }

  #makeMaterial() {
    const made = materialsOf(this.face, this.getScene());
    if (made.length === 1) return made[0];
    const all = new MultiMaterial(this.name, this.getScene());
    all.subMaterials = made;
    return all;
  }

  /** Faces are right-handed, and most scenes are left-handed: they see the mirror image of x. */
  #evaluate() {
    this.face.evaluate(...this.#vectors.map(({values}) => values));
    if (!this.getScene().useRightHandedSystem)
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
    this.#moving = true;
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

  /** The scene calls it before each frame, with the seconds since the last; costs nothing while nothing moves. */
  update(seconds = 0) {
    if (this.isDisposed()) return;
    if ((this.#moving && seconds > 0) || !Number.isFinite(seconds)) this.advance(seconds);
    if (!this.#stale) return;
    this.#evaluate();
    for (const {kind, values} of this.#vectors) this.updateVerticesData(kind, values);
    this.refreshBoundingInfo();
  }

  /** Another face of the same file, in the same pose, that moves independently; it shares the material. */
  clone(name = this.name, parent = this.parent) {
    const face = this.face.clone(), regions = face.regions.length > 0 ? face.regions : [undefined];
    for (const region of regions) {
      const weights = region === undefined ? this.face.weights : this.face.weightsIn(region);
      const set = Object.entries(weights).filter(([, weight]) => weight !== 0);  // if none, no targets need to be read
      face.setWeights(Object.fromEntries(set), region);
    }
    if (this.face.pose) face.look(this.face.pose);
    const twin = new this.constructor(name, this.getScene(), face, this.material);
    twin.position.copyFrom(this.position);
    twin.rotation.copyFrom(this.rotation);
    twin.rotationQuaternion = this.rotationQuaternion?.clone() ?? null;
    twin.scaling.copyFrom(this.scaling);
    twin.parent = parent;
    return twin;
  }

  dispose(doNotRecurse, disposeMaterialAndTextures = false) {
    this.getScene().onBeforeRenderObservable.remove(this.#rendering);
    super.dispose(doNotRecurse, disposeMaterialAndTextures);
    this.face.dispose();
  }
}
