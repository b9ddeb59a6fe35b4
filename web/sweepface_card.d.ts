import type {Material, MeshStandardMaterial} from 'three';
import type {Sweepface} from './sweepface.js';
import type {FaceMesh} from './sweepface_mesh.js';

/** A face in a scene whose vertices are evaluated by the vertex shader of its materials. While it has them, no other
 * mesh can use these materials; `update` takes care of materials that were put in since. Exporters see the neutral. */
export class CardMesh<Materials extends Material | Material[] = MeshStandardMaterial[]> extends FaceMesh<Materials> {
  protected constructor(face: Sweepface, materials?: Materials);
  /** Bytes of textures on the graphics card, and how many of them change every frame. */
  readonly textureBytes: number;
  readonly frameBytes: number;
}
