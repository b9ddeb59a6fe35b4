import type {Loader, LoadingManager, Material, MeshStandardMaterial} from 'three';
import type {Bytes, LoadOptions, Sweepface} from './sweepface.js';
import type {FaceMesh} from './sweepface_mesh.js';

/** A face in a scene whose geometry follows its weights. */
export class SweepfaceMesh<Materials extends Material | Material[] = MeshStandardMaterial[]> extends FaceMesh<Materials> {
  constructor(face: Sweepface, materials?: Materials);
}

/** Loads .sweep files, as three.js's own loaders do. */
export class SweepfaceLoader extends Loader<SweepfaceMesh> {
  constructor(manager?: LoadingManager, options?: LoadOptions);
  options: LoadOptions;
  /** Ends the downloads that are under way. */
  abort(): this;
  parseAsync(bytes: Bytes, options?: LoadOptions): Promise<SweepfaceMesh>;
}
