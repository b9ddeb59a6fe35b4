// .sweep faces for three.js: a loader, and a mesh whose geometry follows the weights.
import {BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, FileLoader, Loader, Mesh, MeshStandardMaterial} from 'three';
import {Sweepface} from './sweepface.js';

function attribute(length, size) {
  return new BufferAttribute(new Float32Array(length * size), size).setUsage(DynamicDrawUsage);
}

function geometryOf(face) {
  const geometry = new BufferGeometry();
  geometry.setIndex(new BufferAttribute(face.triangles, 1));
  geometry.setAttribute('position', attribute(face.vertexCount, 3));
  geometry.setAttribute('normal', attribute(face.vertexCount, 3));
  const texcoords = face.texcoords;
  if (texcoords) geometry.setAttribute('uv', new BufferAttribute(texcoords, 2));
  face.parts.forEach(({start, count}, k) => geometry.addGroup(start, count, k));
  return geometry;
}

/** Plain materials, named as in the source. Mouths and lashes are seen from both sides. */
function materialsOf(face) {
  return face.parts.map(({material}) => new MeshStandardMaterial({name: material, roughness: 0.7, side: DoubleSide}));
}

/** A face in a scene. Weights are set at any time; `update` brings the geometry up to date. */
export class SweepfaceMesh extends Mesh {
  #stale = true;
  #moving = false;

  constructor(face, materials = materialsOf(face)) {
    super(geometryOf(face), materials);
    this.face = face;
    this.update();
  }

  setWeights(weights) {
    this.face.setWeights(weights);
    this.#stale = true;
  }

  moveTo(goals, drive) {
    this.face.moveTo(goals, drive);
    this.#moving = true;
  }

  push(name, velocityChange, drag) {
    this.face.push(name, velocityChange, drag);
    this.#moving = true;
  }

  /** Call it once a frame with the seconds since the last; costs nothing where nothing moves. */
  update(seconds = 0) {
    if (this.#moving && seconds > 0) {
      this.#moving = this.face.advance(seconds);
      this.#stale = true;
    }
    if (!this.#stale) return;
    const {position, normal} = this.geometry.attributes;
    this.face.evaluate(position.array, normal.array);
    position.needsUpdate = normal.needsUpdate = true;
    this.geometry.boundingBox = null;
    this.geometry.computeBoundingSphere();
    this.#stale = false;
  }

  dispose() {
    this.geometry.dispose();
    for (const material of [this.material].flat()) material.dispose();
    this.face.dispose();
  }
}

/** Loads a .sweep file as a SweepfaceMesh, as three.js's own loaders do. */
export class SweepfaceLoader extends Loader {
  /** Options of Sweepface.load. */
  constructor(manager, options = {}) {
    super(manager);
    this.options = options;
  }

  load(url, onLoad, onProgress, onError) {
    const loader = new FileLoader(this.manager);
    loader.setPath(this.path).setResponseType('arraybuffer');
    loader.setRequestHeader(this.requestHeader).setWithCredentials(this.withCredentials);
    const fail = (error) => {
      if (onError) onError(error);
      else console.error(error);
      this.manager.itemError(url);
    };
    loader.load(url, (bytes) => this.parseAsync(bytes, {name: url}).then(onLoad, fail), onProgress, fail);
  }

  async parseAsync(bytes, options = {}) {
    return new SweepfaceMesh(await Sweepface.load(bytes, {...this.options, ...options}));
  }
}
