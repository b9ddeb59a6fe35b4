import type {Material, Mesh} from 'three';
import type {Drive, DriveKind, Look, Sweepface, Weights} from './sweepface.js';

/** GLSL ES 3: `vec3 sweepfaceRow(vec3 neutral, uvec2 place, int row, isampler2D basis, sampler2D modes)`. */
export const SWEEPFACE_GLSL: string;

/** A face in a scene whose vertices are evaluated by the vertex shader of its materials. */
export class SweepfaceGpuMesh extends Mesh {
  constructor(face: Sweepface, materials?: Material | Material[]);
  readonly face: Sweepface;
  readonly names: string[];
  readonly eyeCount: number;
  /** How the eyes stand; null: by the weights of eyeLook targets. */
  look(pose: {leftEye?: Look; rightEye?: Look} | null): void;
  /** Bytes of textures on the graphics card, and of them those that change every frame. */
  readonly textureBytes: number;
  readonly frameBytes: number;
  setWeights(weights: Weights, region?: string): void;
  moveTo(goals: Weights, drive?: DriveKind | Drive, region?: string): void;
  push(name: string, velocityChange: number, drag?: number): void;
  /** Lets seconds pass without showing it; says whether anything goes on moving. */
  advance(seconds: number): boolean;
  /** Call it once a frame with the seconds since the last; costs nothing where nothing moves. */
  update(seconds?: number): void;
  dispose(): void;
}
