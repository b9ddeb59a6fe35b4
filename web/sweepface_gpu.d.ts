import type {Material, MeshStandardMaterial} from 'three';
import type {Sweepface} from './sweepface.js';
import type {CardMesh} from './sweepface_card.js';

/**
 * GLSL ES 3, for textures of 1024 texels a row:
 *   vec3 sweepfacePosition(vec3 neutral, uvec3 place, isampler2D basis, isampler2D modes, float factor)
 *   vec3 sweepfaceNormal(vec3 along, vec3 across, uvec3 place, isampler2D basis, isampler2D modes, float factor)
 */
export const SWEEPFACE_GLSL: string;

/** A face that the graphics card evaluates, for `WebGLRenderer`. */
export class SweepfaceGpuMesh<Materials extends Material | Material[] = MeshStandardMaterial[]>
    extends CardMesh<Materials> {
  constructor(face: Sweepface, materials?: Materials);
}
