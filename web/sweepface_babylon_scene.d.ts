import type {AssetContainer} from '@babylonjs/core/assetContainer.js';
import type {SceneLoaderPluginOptions} from '@babylonjs/core/Loading/sceneLoader.js';
import type {AbstractMesh} from '@babylonjs/core/Meshes/abstractMesh.js';
import type {Scene} from '@babylonjs/core/scene.js';
import type {Bytes, LoadOptions, Moved, Sweepface} from './sweepface.js';

export interface SceneFace extends Moved {}

/** The face of a scene of Babylon.js. Weights are set at any time; whenever the scene is rendered, the face moves on by the
 * time of its animations and its meshes follow. Weights are also the influences of the meshes' morph targets, to read and
 * to set. */
export class SceneFace {
  /** importScene makes it. */
  private constructor();
  /** For reading: what is set there does not show. */
  readonly face: Sweepface;
  /** The meshes that show the face, skinned ones included. */
  readonly meshes: AbstractMesh[];
  /** Whether time passes with the frames of the scene: true at first. Set it to false where something else advances the
   * face, such as a TimelinePlayer. */
  advancesWithScene: boolean;
  /** Lets time pass and shows it. The scene calls it before every frame. Returns whether there is something new to draw,
   * or will be in the next frame. */
  update(seconds?: number): boolean;
  /** Frees the face and all that it was loaded with. Disposing of its meshes does so, too. */
  dispose(): void;
}

/** What Babylon.js makes of a glTF file, with the face in it. */
export interface ImportedScene extends Pick<AssetContainer, 'transformNodes' | 'skeletons' | 'animationGroups' | 'lights' |
  'cameras'> {
  face: SceneFace;
  meshes: AbstractMesh[];
  /** All of it, in the scene already. */
  container: AssetContainer;
}

/** The options of a face, except those that ask for other vertices than the source's. */
export interface SceneOptions extends Omit<LoadOptions, 'lod' | 'edgeLength' | 'error' | 'vertices'> {
  /** Those of Babylon.js for its loaders, e.g. {gltf: {animationStartMode: 0}}. */
  pluginOptions?: SceneLoaderPluginOptions | undefined;
  /** Loads faces: Sweepface.load unless given, or loadInWorker of sweepface/worker. */
  load?: typeof Sweepface.load | undefined;
}

/** Loads a .sweep file from a URL, or from bytes, with the scene that its face came with, into a scene of Babylon.js: the
 * last one that was made unless given. */
export function importScene(source: string | URL | Bytes, scene?: Scene | null,
                            options?: SceneOptions): Promise<ImportedScene>;
