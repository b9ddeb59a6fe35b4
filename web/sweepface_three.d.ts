import type {AnimationClip, Loader, LoadingManager, Material, MeshStandardMaterial, Object3D} from 'three';
import type {Bytes, LoadOptions, Sweepface} from './sweepface.js';
import type {FaceMesh} from './sweepface_mesh.js';

/** A face in a scene whose geometry follows its weights. */
export class SweepfaceMesh<Materials extends Material | Material[] = MeshStandardMaterial[]> extends FaceMesh<Materials> {
  constructor(face: Sweepface, materials?: Materials);
}

export interface LoaderOptions<M> extends LoadOptions {
  /** The class of the mesh to make: SweepfaceMesh unless given, or SweepfaceGpuMesh, SweepfaceNodeMesh. */
  mesh?: (new (face: Sweepface) => M) | undefined;
  /** Loads faces: Sweepface.load unless given, or loadInWorker of sweepface/worker. */
  load?: typeof Sweepface.load | undefined;
}

/** Loads .sweep files, as three.js's own loaders do. */
export class SweepfaceLoader<M extends FaceMesh = SweepfaceMesh> extends Loader<M> {
  constructor(manager?: LoadingManager, options?: LoaderOptions<M>);
  options: LoaderOptions<M>;
  /** Aborts the downloads under way. */
  abort(): this;
  parseAsync(bytes: Bytes, options?: LoaderOptions<M>): Promise<M>;
}

/** An animation read by GLTFLoader as a clip for an AnimationMixer of the face; unless given, the first with targets
 * that the face has. It has a track, by name, for each of the face's targets that ever leaves 0. Throws if there is
 * none. */
export function animationFor(
  face: {readonly names: readonly string[]}, gltf: {scene: Object3D; animations: AnimationClip[]}, animation?: AnimationClip):
  AnimationClip;
