import type {Material} from 'three';
import type {Sweepface} from './sweepface.js';
import type {FaceMesh} from './sweepface_mesh.js';

/** GLSL ES 3: `vec3 sweepfaceRow(vec3 neutral, uvec2 place, int row, isampler2D basis, sampler2D modes)`. */
export const SWEEPFACE_GLSL: string;

/** A face in a scene whose vertices are evaluated by the vertex shader of its materials. */
export class SweepfaceGpuMesh extends FaceMesh {
  constructor(face: Sweepface, materials?: Material | Material[]);
  /** Bytes of textures on the graphics card, and of them those that change every frame. */
  readonly textureBytes: number;
  readonly frameBytes: number;
}
