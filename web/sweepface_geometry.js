// Geometries for three.js of which some attributes follow a face, and clones share the others.
import {BufferAttribute, BufferGeometry} from 'three';

/** A stand-in that is not on the graphics card: WebGPURenderer looks for every attribute that it has drawn. */
const NOTHING = new BufferAttribute(new Float32Array(0), 3);

/**
 * The geometry of a face. Clones share its fixed attributes: they are on the graphics card once, and are freed with the
 * last of the clones (but WebGPURenderer frees them with the first, and uploads them again to draw others).
 */
export class FaceGeometry extends BufferGeometry {
  #changing = [];  // names of attributes that follow the weights
  #fixed = {all: new Set(), users: 0};  // the other attributes, and how many geometries show them
  #isUser = false;
  #isOfFace = false;

  /** Fixes all attributes that are there, except those in `changing`, which follow the weights. */
  fix(changing) {
    const others = Object.keys(this.attributes).filter((name) => !changing.includes(name));
    this.#changing = changing;
    this.#isOfFace = true;
    this.#fixed.all = new Set(others.map((name) => this.attributes[name]));
    return this;
  }

  /** Moving the vertices would last until the next expression. All of three.js's methods that do so come through here. */
  applyMatrix4(matrix) {
    if (!this.#isOfFace) return super.applyMatrix4(matrix);
    throw new Error('The vertices follow the face; move, turn or scale the mesh, or a clone() of its geometry.');
  }

  /** Takes over another geometry of the same file: shares its fixed attributes, and copies what was added to it. */
  take(original) {
    const {name, userData, index, attributes, groups, drawRange} = original;
    if (#fixed in original) {
      if (this.#isUser) ++original.#fixed.users;
      this.#fixed = original.#fixed;
    }
    const own = (attribute) => (this.#fixed.all.has(attribute) ? attribute : attribute.clone());
    this.setIndex(index?.clone() ?? null);  // a copy, as some applications reorder it
    for (const key of Object.keys(this.attributes)) if (!attributes[key]) this.deleteAttribute(key);
    for (const [key, attribute] of Object.entries(attributes))
      if (!this.#changing.includes(key)) this.setAttribute(key, own(attribute));
    Object.assign(this, {name, userData, groups: groups.map((group) => ({...group})), drawRange: {...drawRange}});
  }

  /** Renderers listen to what they show: this geometry then counts as a user of the fixed attributes. */
  addEventListener(type, listener) {
    super.addEventListener(type, listener);
    if (type !== 'dispose' || this.#isUser) return;
    this.#isUser = true;
    ++this.#fixed.users;
  }

  /** Frees all but what other geometries show, which three.js would free as well. */
  dispose() {
    const {attributes} = this, {all} = this.#fixed;
    if (this.#isUser) --this.#fixed.users;
    this.#isUser = false;
    if (this.#fixed.users > 0) {
      const given = ([name, attribute]) => [name, all.has(attribute) ? NOTHING : attribute];
      this.attributes = Object.fromEntries(Object.entries(attributes).map(given));
    }
    super.dispose();
    this.attributes = attributes;
  }
}

/**
 * The geometry of a face with what another holds, its attributes replaced by those of `own` that it has or that are the
 * face's alone; `changing` ones are to follow the weights.
 */
export function faceGeometryOf({name, userData, index, attributes, groups, drawRange}, own, changing) {
  const geometry = Object.assign(new FaceGeometry(), {name, userData, groups, drawRange}).setIndex(index);
  const {normal, ...others} = own, all = {...attributes, ...others, ...(attributes.normal && {normal})};
  for (const [key, attribute] of Object.entries(all)) geometry.setAttribute(key, attribute);
  return geometry.fix(changing);
}

/** Another geometry like one that follows a face, for attributes of another in the place of `changing` ones. */
export function twinGeometry(original, own, changing) {
  const geometry = new FaceGeometry().fix(changing);
  geometry.take(original);
  for (const key of changing) if (original.attributes[key]) geometry.setAttribute(key, own[key]);
  return geometry;
}

/**
 * The triangles of a face, its texture coordinates and a group for each part, with attributes by name: `changing` ones,
 * which follow the weights, and `fixed` ones.
 */
export function geometryOf(face, changing, fixed = {}) {
  const geometry = new FaceGeometry(), {texcoords} = face;
  geometry.setIndex(new BufferAttribute(face.triangles, 1));
  for (const [name, attribute] of Object.entries({...changing, ...fixed})) geometry.setAttribute(name, attribute);
  if (texcoords) geometry.setAttribute('uv', new BufferAttribute(texcoords, 2));
  face.parts.forEach(({start, count}, k) => geometry.addGroup(start, count, k));
  return geometry.fix(Object.keys(changing));
}
