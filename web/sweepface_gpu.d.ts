import type {Material, MeshStandardMaterial} from 'three';
import type {Sweepface} from './sweepface.js';
import type {FaceMesh} from './sweepface_mesh.js';

/**
 * GLSL ES 3, for textures of 1024 texels a row:
 *   vec3 sweepfacePosition(vec3 neutral, uvec3 place, isampler2D basis, isampler2D modes, float factor)
 *   vec3 sweepfaceNormal(vec3 along, vec3 across, uvec3 place, isampler2D basis, isampler2D modes, float factor)
 */
export const SWEEPFACE_GLSL: string;

/** A face in a scene whose vertices are evaluated by the vertex shader of its materials, which no other mesh can have, as
 * long as it has them; `update` sees to those that were put in since. For `WebGLRenderer`; exporters see the neutral. */
export class SweepfaceGpuMesh<Materials extends Material | Material[] = MeshStandardMaterial[]>
    extends FaceMesh<Materials> {
  constructor(face: Sweepface, materials?: Materials);
  /** Bytes of textures on the graphics card, and of them those that change every frame. */
  readonly textureBytes: number;
  readonly frameBytes: number;
}
