// .sweep faces for three.js: a loader, and a mesh whose geometry follows the weights.
import {BufferAttribute, BufferGeometry, DynamicDrawUsage, FileLoader, Loader} from 'three';
import {Sweepface} from './sweepface.js';
import {FaceMesh} from './sweepface_mesh.js';

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

/** A face in a scene. Weights are set at any time; `update` brings the geometry up to date. */
export class SweepfaceMesh extends FaceMesh {
  constructor(face, materials) {
    super(face, geometryOf(face), materials);
    this.update();
  }

  show() {
    const {position, normal} = this.geometry.attributes;
    this.face.evaluate(position.array, normal.array);
    position.needsUpdate = normal.needsUpdate = true;
    this.geometry.boundingBox = null;
    this.geometry.computeBoundingSphere();
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
