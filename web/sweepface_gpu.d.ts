import type {Material, Mesh} from 'three';
import type {Drive, DriveKind, Sweepface} from './sweepface.js';

/** GLSL ES 3: `vec3 sweepfaceRow(vec3 neutral, uvec2 place, int row, isampler2D basis, sampler2D modes)`. */
export const SWEEPFACE_GLSL: string;

/** A face in a scene whose vertices are evaluated by the vertex shader of its materials. */
export class SweepfaceGpuMesh extends Mesh {
  constructor(face: Sweepface, materials?: Material | Material[]);
  readonly face: Sweepface;
  /** Bytes of textures on the graphics card, and of them those that change every frame. */
  readonly textureBytes: number;
  readonly frameBytes: number;
  setWeights(weights: Record<string, number>): void;
  moveTo(goals: Record<string, number>, drive?: DriveKind | Drive): void;
  /** Call it once a frame with the seconds since the last; costs nothing where nothing moves. */
  update(seconds?: number): void;
  dispose(): void;
}
