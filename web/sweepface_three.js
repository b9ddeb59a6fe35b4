// .sweep faces for three.js: a loader, and a mesh whose geometry follows the weights.
import {BufferAttribute, DynamicDrawUsage, FileLoader, Loader} from 'three';
import {Sweepface} from './sweepface.js';
import {FaceMesh, faceFrom, geometryOf, show, standing} from './sweepface_mesh.js';
import {ownRegions} from './sweepface_regions.js';
import {otherGeometry} from './sweepface_values.js';

export {animationFor} from './sweepface_animation.js';

/** An attribute of three numbers per vertex that change every frame. */
function vectors(face) {
  return new BufferAttribute(new Float32Array(3 * faceFrom(face).vertexCount), 3).setUsage(DynamicDrawUsage);
}

/** A face in a scene. Weights can be set at any time; `update` brings the geometry up to date. */
export class SweepfaceMesh extends FaceMesh {
  constructor(face, materials) {
    super(face, geometryOf(face, {position: vectors(face), normal: vectors(face)}), materials);
    this.update();
  }

  /** The positions that follow the face. */
  #position() {
    const {geometry: {attributes: {position}}, face} = this;
    if (position?.count === face.vertexCount) return position;
    throw otherGeometry(face);
  }

  [show]() {
    const {geometry, face} = this, {normal} = geometry.attributes, position = this.#position();
    face.evaluate(position.array, normal?.array);
    for (const attribute of [position, normal]) if (attribute) attribute.needsUpdate = true;
    if (this.frustumCulled) geometry.computeBoundingSphere();
    else geometry.boundingSphere = null;  // computed when it is needed
    if (geometry.boundingBox) geometry.computeBoundingBox();
  }

  [standing]() { return this.#position().array; }
}

/** The class of meshes that a loader makes. */
function meshFrom(mesh = SweepfaceMesh) {
  if (mesh?.prototype instanceof FaceMesh) return mesh;
  throw new TypeError("The option 'mesh' is a class: SweepfaceMesh, SweepfaceGpuMesh or SweepfaceNodeMesh.");
}

/** Loads a .sweep file as a mesh, as three.js's own loaders do. */
export class SweepfaceLoader extends Loader {
  #downloads = new Set();

  /** `options` are those of Sweepface.load, and `mesh`, the class to make instead of SweepfaceMesh. */
  constructor(manager, options) {
    if (manager && typeof manager.itemStart !== 'function')
      throw new TypeError('A loader takes a LoadingManager, or undefined, and its options after it.');
    super(manager);
    this.options = options ?? {};
  }

  load(url, onLoad, onProgress, onError) {
    const {manager} = this, usual = {...this.options}, loader = new FileLoader(manager);
    if (usual.regions) usual.regions = ownRegions(usual.regions);
    loader.setPath(this.path).setResponseType('arraybuffer');
    loader.setRequestHeader(this.requestHeader).setWithCredentials(this.withCredentials);
    const tell = onError ?? console.error, name = usual.name || url;
    const parse = (bytes) => this.parseAsync(bytes, {name}, usual).then(onLoad).catch((error) => {
      manager.itemError(url);
      tell(error);
    }).finally(() => manager.itemEnd(url));
    this.#downloads.add(loader);
    manager.itemStart(url);  // until the mesh is made; the file is an item of the FileLoader's own
    loader.load(url, (bytes) => {
      this.#downloads.delete(loader);
      parse(bytes);
    }, onProgress, (error) => {
      this.#downloads.delete(loader);
      manager.itemEnd(url);
      tell(error);
    });
  }

  /** Aborts the downloads under way, as far as three.js can. */
  abort() {
    for (const loader of this.#downloads) loader.abort?.();
    return this;
  }

  parse() {
    throw new Error('Bytes of a face are parsed by parseAsync, as its module has to be there.');
  }

  /** `usual` are the loader's options at the time when a load began. */
  async parseAsync(bytes, options = {}, usual = this.options) {
    const {mesh, ...others} = {...usual, ...options}, Made = meshFrom(mesh);
    return new Made(await Sweepface.load(bytes, others));
  }
}
