import type {AnimationClip, Loader, LoadingManager, Material, MeshStandardMaterial, Object3D} from 'three';
import type {Bytes, LoadOptions, Sweepface} from './sweepface.js';
import type {FaceMesh} from './sweepface_mesh.js';

/** A face in a scene whose geometry follows its weights. */
export class SweepfaceMesh<Materials extends Material | Material[] = MeshStandardMaterial[]> extends FaceMesh<Materials> {
  constructor(face: Sweepface, materials?: Materials);
}

/** Loads .sweep files, as three.js's own loaders do. */
export class SweepfaceLoader extends Loader<SweepfaceMesh> {
  constructor(manager?: LoadingManager, options?: LoadOptions);
  options: LoadOptions;
  /** Ends the downloads that are under way. */
  abort(): this;
  parseAsync(bytes: Bytes, options?: LoadOptions): Promise<SweepfaceMesh>;
}

/** An animation that GLTFLoader read, the first of targets that the face has unless given, as a clip for an AnimationMixer
 * of the face: a track for each target that it has and that ever leaves 0, by its name. Throws where there is none. */
export function animationFor(
  face: {readonly names: readonly string[]}, gltf: {scene: Object3D; animations: AnimationClip[]}, animation?: AnimationClip):
  AnimationClip;
