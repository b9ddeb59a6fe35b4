// .sweep faces for three.js: a loader, and a mesh whose geometry follows the weights.
import {BufferAttribute, DynamicDrawUsage, FileLoader, Loader, LoaderUtils} from 'three';
import {Sweepface} from './sweepface.js';
import {withOptions} from './sweepface_file.js';
import {geometryOf} from './sweepface_geometry.js';
import {FaceMesh, standing} from './sweepface_mesh.js';
import {show} from './sweepface_moved.js';
import {ownOptions} from './sweepface_regions.js';
import {boxOf, faceFrom, nameOf, otherGeometry} from './sweepface_values.js';

export {animationFor} from './sweepface_animation.js';

/** An attribute of three numbers per vertex that change every frame. */
function vectors(face) {
  return new BufferAttribute(new Float32Array(3 * faceFrom(face).vertexCount), 3).setUsage(DynamicDrawUsage);
}

/** Makes the sphere what geometry.computeBoundingSphere() would, in a fraction of the time. */
export function bound({array}, sphere) {
  const [low, high] = boxOf(array), {x, y, z} = sphere.center.fromArray(low.map((least, axis) => (least + high[axis]) / 2));
  let most = 0;
  for (let k = 0; k < array.length; k += 3)
    most = Math.max(most, (array[k] - x) ** 2 + (array[k + 1] - y) ** 2 + (array[k + 2] - z) ** 2);
  sphere.radius = Math.sqrt(most);
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
    const {boundingSphere: sphere} = geometry;
    if (!this.frustumCulled) geometry.boundingSphere = null;  // computed when it is needed
    else if (sphere) bound(position, sphere);
    else geometry.computeBoundingSphere();
    if (geometry.boundingBox) geometry.computeBoundingBox();
  }

  [standing]() { return this.#position().array; }
}

/** The class of meshes that a loader is to make. */
export function meshFrom(mesh = SweepfaceMesh) {
  if (mesh?.prototype instanceof FaceMesh) return mesh;
  throw new TypeError("The option 'mesh' is a class: SweepfaceMesh, SweepfaceGpuMesh or SweepfaceNodeMesh.");
}

/** What loads faces, and the other options: usual ones and those that replace them. */
export function settings(usual, options) {
  if (typeof options === 'string') throw new TypeError('parseAsync takes bytes and options, no path; faces name no other files.');
  const {load, ...others} = withOptions(usual, options);
  if (!['undefined', 'function'].includes(typeof load))
    throw new TypeError("The option 'load' is a function: Sweepface.load or loadInWorker.");
  return {load: load ?? Sweepface.load, others};
}

/** Loads a .sweep file as a mesh, as three.js's own loaders do. */
export class SweepfaceLoader extends Loader {
  #downloads = new Set();
  #aborts = 0;

  /** `options` are those of Sweepface.load, `mesh`, the class to make instead of SweepfaceMesh, and `load`, loadInWorker. */
  constructor(manager, options) {
    if (manager && typeof manager.itemStart !== 'function')
      throw new TypeError('A loader takes a LoadingManager, or undefined, and its options after it.');
    super(manager);
    this.options = options ?? {};
  }

  load(url, onLoad, onProgress, onError) {
    const {manager} = this, usual = ownOptions(this.options), loader = new FileLoader(manager);
    loader.setPath(this.path).setResponseType('arraybuffer');
    loader.setRequestHeader(this.requestHeader).setWithCredentials(this.withCredentials);
    const tell = onError ?? console.error, name = usual.name || nameOf(url), aborts = this.#aborts;
    const folder = LoaderUtils.extractUrlBase(this.path + url);
    const deliver = (mesh) => {
      if (aborts === this.#aborts) return onLoad(mesh);
      (mesh.dispose ? mesh : mesh.face).dispose();  // of a scene
      throw new DOMException('The load was aborted.', 'AbortError');
    };
    const parse = (bytes) => this.parseAsync(bytes, {name}, usual, folder).then(deliver).catch((error) => {
      manager.itemError(url);
      tell(error);
    }).finally(() => manager.itemEnd(url));
    const giveUp = (error) => {
      this.#downloads.delete(loader);
      manager.itemEnd(url);
      tell(error);
    };
    this.#downloads.add(loader);
    manager.itemStart(url);  // until the mesh is made; the file is an item of the FileLoader's own
    try {
      new Request(manager.resolveURL(this.path + url));  // a FileLoader would wait for what is no URL the second time
      loader.load(url, (bytes) => {
        this.#downloads.delete(loader);
        parse(bytes);
      }, onProgress, giveUp);
    } catch (error) {  // the URL is none
      manager.itemError(url);
      giveUp(error);
    }
  }

  /** Aborts the loads under way: downloads as far as three.js can, and faces that are not there yet. */
  abort() {
    ++this.#aborts;
    for (const loader of this.#downloads) loader.abort?.();
    return this;
  }

  parse() {
    throw new Error('Bytes of a face are parsed by parseAsync, as its module has to be there.');
  }

  /** `usual` are the loader's options at the time when a load began. */
  async parseAsync(bytes, options, usual = this.options) {
    const {load, others: {mesh, ...others}} = settings(usual, options), Made = meshFrom(mesh);
    return new Made(await load(bytes, others));
  }
}
