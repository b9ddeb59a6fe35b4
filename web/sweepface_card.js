// Shared by the meshes of sweepface/gpu and sweepface/webgpu.
import {BufferAttribute} from 'three';
import {card, Followers, refreshShadow, sourceOf} from './sweepface_followers.js';
import {geometryOf} from './sweepface_geometry.js';
import {FaceMesh, materialsOfClone, meet, share} from './sweepface_mesh.js';
import {expression, follow, show} from './sweepface_moved.js';
import {attributesOf, tablesOf, texturesOf} from './sweepface_textures.js';

/** The point that each vertex is, or copies. */
const pointsOf = ({pointCount, vertexCount, copies}) =>
  Uint32Array.from({length: vertexCount}, (_, v) => (v < pointCount ? v : copies[v - pointCount]));

/** All materials that a mesh is drawn with. */
export const materialsOf = ({material, customDepthMaterial, customDistanceMaterial}) =>
  [material, customDepthMaterial, customDistanceMaterial].flat().filter(Boolean);

/**
 * Calls `act` while a geometry has the attributes of a pose, {position, normal, sphere}, instead of those of the neutral.
 * Trees of triangles, as of three-mesh-bvh, are of the neutral. Returns the bounding sphere of the pose, if it was asked for.
 */
export function whileStanding(geometry, {position, normal, sphere}, act) {
  const {attributes, boundingSphere, boundingBox, boundsTree} = geometry;
  const standing = {...attributes, position, ...(attributes.normal && normal && {normal})};
  Object.assign(geometry, {attributes: standing, boundingSphere: sphere, boundingBox: null});
  if (boundsTree) geometry.boundsTree = undefined;
  try {
    act();
    return geometry.boundingSphere;
  } finally {
    Object.assign(geometry, {attributes, boundingSphere, boundingBox}, boundsTree && {boundsTree});
  }
}

/** A face in a scene whose vertices are evaluated in the vertex shader. */
export class CardMesh extends FaceMesh {
  #textures;
  #followers;
  #met = {};  // the face as it stood when a ray came last: attributes, and their bounding sphere

  constructor(face, materials) {
    const tables = tablesOf(face), way = new.target[card];
    super(face, geometryOf(face, {}, attributesOf(tables, pointsOf(face))), materials);
    this.frustumCulled = false;  // bounds are those of the neutral
    this.#textures = texturesOf(tables, way.integers);
    const source = sourceOf(this.#textures);
    this.#followers = new Followers(way, source);
    Object.assign(this, way.shadows());
    for (const drawn of [this, this.geometry]) way.drawn(drawn, source);
    this.update();
  }

  onBeforeRender(renderer) { this.constructor[card].meet(renderer); }

  onBeforeShadow(...[, , , , , material]) { refreshShadow(this, material); }

  /** Makes the mesh's current materials, and no others, follow the face. */
  [follow]() { this.#followers.follow(materialsOf(this)); }

  /** Bytes of all textures on the graphics card, and of the part that changes every frame. */
  get textureBytes() { return this.#textures.basis.image.data.byteLength + this.frameBytes; }
  get frameBytes() { return this.#textures.modes.image.data.byteLength; }

  [show]() { this.#textures.update(this.face); }

  /** The attributes of the current pose, evaluated here because the geometry's own hold the neutral. */
  #stand({position, normal}) {
    const names = normal ? 'positions and normals' : 'positions', met = this.#met;
    if (met.at === this[expression] && met.names === names && met.position.array.length === position.array.length) return met;
    const made = () => new BufferAttribute(new Float32Array(position.array.length), 3);
    this.#met = {at: this[expression], names, position: made(), ...(normal && {normal: made()}), sphere: null};
    this.face.evaluate(this.#met.position.array, this.#met.normal?.array);
    return this.#met;
  }

  /** Intersects rays with the face in its current pose. */
  [meet](raycaster, hits) {
    const met = this.#stand(this.geometry.attributes);
    met.sphere = whileStanding(this.geometry, met, () => super[meet](raycaster, hits));
  }

  [share](original) {
    super[share](original);
    this.#textures.share(original.#textures);
  }

  /** Clones of the materials, each of which follows one face only. */
  [materialsOfClone]() {
    const clone = (material) => this.#followers.cloneOf(material);
    return Array.isArray(this.material) ? this.material.map(clone) : clone(this.material);
  }

  dispose() {
    this.#textures.dispose();
    super.dispose();
    this.#followers.dispose();
  }
}
