// Bounds of meshes of Babylon.js: refreshBoundingInfo() takes longer than to evaluate the face.
import {Vector3} from '@babylonjs/core/Maths/math.vector.js';
import {boxOf} from './sweepface_values.js';

/** The lowest and the highest place of points [n x 3]. */
export const endsOf = (points) => boxOf(points).map((place) => Vector3.FromArray(place));

/** Gives a mesh and its parts the box of all vertices. */
export function bound(mesh, ends) {
  for (const info of [mesh, ...mesh.subMeshes ?? []].map((part) => part.getBoundingInfo()))
    if (!info.isLocked) info.reConstruct(...ends, mesh.getWorldMatrix());
  if (mesh.hasThinInstances && !mesh.getBoundingInfo().isLocked) mesh.thinInstanceRefreshBoundingInfo(true);
}
