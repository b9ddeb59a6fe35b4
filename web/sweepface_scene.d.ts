import type {AnimationClip, Group, Loader, LoadingManager, Mesh} from 'three';
import type {GLTF, GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import type {Bytes, LoadOptions, Moved, Sweepface} from './sweepface.js';
import type {FaceMesh} from './sweepface_mesh.js';

export interface SceneFace extends Moved {}

/** The face of a scene. Weights are set at any time; `update` brings them to its meshes. They are also in the meshes'
 * `morphTargetInfluences`, to read and to set, so that whatever moves morph targets moves the face. */
export class SceneFace {
  /** Loaders make it. */
  private constructor();
  /** For reading: what is set there does not show. */
  readonly face: Sweepface;
  /** The meshes that show the face, skinned ones included. */
  readonly meshes: Mesh[];
  /** Call it once a frame with the seconds since the last, as for `advance`. It costs nothing while nothing moves, and
   * does nothing once the face is disposed of. Returns whether there is something new to draw, or will be in the next
   * frame. */
  update(seconds?: number): boolean;
  /** Frees the face and the geometries of its meshes, and with the last of the clones the geometries, materials and
   * textures of the scene. */
  dispose(): void;
}

/** What GLTFLoader makes of a glTF file, with the face in it. */
export interface SweepfaceScene extends GLTF {
  face: SceneFace;
}

/** The options of a face, except those that ask for other vertices than the source's. */
export interface SceneOptions extends Omit<LoadOptions, 'lod' | 'edgeLength' | 'error' | 'vertices'> {
  /** A loader of your own, with the decoders and plugins that the scene needs. */
  gltfLoader?: GLTFLoader | undefined;
  /** Where vertices are evaluated: as those of a SweepfaceMesh unless given, or of a SweepfaceGpuMesh, SweepfaceNodeMesh. */
  mesh?: (new (face: Sweepface) => FaceMesh) | undefined;
  /** Loads faces: Sweepface.load unless given, or loadInWorker of sweepface/worker. */
  load?: typeof Sweepface.load | undefined;
}

/** Loads .sweep files with the scenes that their faces came with. */
export class SweepfaceSceneLoader extends Loader<SweepfaceScene> {
  constructor(manager?: LoadingManager, options?: SceneOptions);
  options: SceneOptions;
  /** Aborts the downloads under way. */
  abort(): this;
  parseAsync(bytes: Bytes, options?: SceneOptions): Promise<SweepfaceScene>;
}

/** Another model like one that was loaded (or cloned), in the same pose, that moves by itself. It shares materials (of a
 * face on the graphics card their colours and other objects), textures and what does not move. */
export function cloneScene(model: {scene: Group; face: SceneFace; animations: AnimationClip[]}): {
  scene: Group; face: SceneFace; animations: AnimationClip[];
};

/** The JSON of the glTF file that a face came with, without what the face itself holds; null if there is no scene in the
 * .sweep file. Rejects if it is damaged. */
export function sceneJson(bytes: Bytes, name?: string): Promise<GLTF['parser']['json'] | null>;
