import type {Material, MeshStandardMaterial} from 'three';
import type {Sweepface} from './sweepface.js';
import type {CardMesh} from './sweepface_card.js';

/** A face that the graphics card evaluates, for `WebGPURenderer`. */
export class SweepfaceNodeMesh<Materials extends Material | Material[] = MeshStandardMaterial[]>
    extends CardMesh<Materials> {
  constructor(face: Sweepface, materials?: Materials);
}
