import type {Material, MeshStandardMaterial} from 'three';
import type {Sweepface} from './sweepface.js';
import type {FaceMesh} from './sweepface_mesh.js';

/** A face in a scene whose vertices are evaluated by the vertex shader of its materials, which no other mesh can have, as
 * long as it has them; `update` sees to those that were put in since. Exporters see the neutral. */
export class CardMesh<Materials extends Material | Material[] = MeshStandardMaterial[]> extends FaceMesh<Materials> {
  protected constructor(face: Sweepface, materials: Materials | undefined, kind: object);
  /** Bytes of textures on the graphics card, and of them those that change every frame. */
  readonly textureBytes: number;
  readonly frameBytes: number;
}
