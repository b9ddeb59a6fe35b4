// What a scene leaves to its face (docs/glb.md, "The scene"): triangles and texture coordinates, which do not change.
import {BufferAttribute} from 'three';

/** What is wrong with a scene that belongs to another face. */
export const unfit = (name) => new Error(`${name}: the face and its scene do not fit; convert the source again.`);

const primitiveOf = (json, {mesh, primitive}) => json.meshes[mesh].primitives[primitive];

function isEmpty({accessors}, index) {
  return index !== undefined && accessors[index].bufferView === undefined && accessors[index].sparse === undefined;
}

/**
 * A copy of the scene's JSON in which targets have names but no shapes of their own: three.js then makes influences for
 * them, which cost nothing.
 */
export function withoutShapes(given, parts) {
  const json = structuredClone(given);
  for (const part of parts.filter(({names}) => names.length > 0)) {
    const primitive = primitiveOf(json, part), mesh = json.meshes[part.mesh], {POSITION} = primitive.attributes;
    primitive.targets = part.names.map(() => ({POSITION}));
    mesh.extras = {...mesh.extras, targetNames: part.names};
  }
  return json;
}

/** The face's triangles in the runs where they lie, as indices into these. In a mirrored mesh they are the other way round. */
function trianglesOf(face, runs) {
  const {triangles, pointCount, copies} = face, runOf = new Uint32Array(pointCount), found = runs.map(() => []);
  runs.forEach(({first, count}, r) => runOf.fill(r, first, first + count));
  const point = (vertex) => (vertex < pointCount ? vertex : copies[vertex - pointCount]);
  for (let k = 0; k < triangles.length; k += 3) {
    const r = runOf[point(triangles[k])], {first, mirrors} = runs[r];
    const [a, b, c] = [0, 1, 2].map((corner) => point(triangles[k + corner]) - first);
    found[r].push(a, mirrors ? c : b, mirrors ? b : c);
  }
  return new Map(runs.map((run, r) => [run, Uint32Array.from(found[r])]));
}

/** How many triangles of three different vertices a geometry has. */
function countTriangles({index, attributes: {position}}) {
  if (!index) return Math.floor(position.count / 3);
  let count = 0;
  for (let k = 0; k + 2 < index.count; k += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => index.getX(k + corner));
    count += a !== b && b !== c && c !== a;
  }
  return count;
}

/** Parts in the order in which the face lists its triangles: by material, in the order of their first use. */
function byMaterial(json, parts) {
  const materialOf = (part) => primitiveOf(json, part).material ?? -1;
  const materials = [...new Set(parts.map(materialOf))].filter((material) => material >= 0);
  const rank = (part) => materials.indexOf(materialOf(part));  // -1 if it has none, as the face has it
  return [...parts].sort((a, b) => rank(a) - rank(b));
}

/** The face's texture coordinates of a run, with v downwards. */
function texcoordsOf({texcoords}, {first, count}) {
  const own = new Float32Array(2 * count);
  for (let k = 0; texcoords && k < own.length; k += 2)
    own.set([texcoords[2 * first + k], 1 - texcoords[2 * first + k + 1]], k);
  return new BufferAttribute(own, 2);
}

/** Gives the geometries of the parts, a map from these, what the scene leaves to the face. */
export function fill(json, geometries, face, name) {
  const parts = [...geometries.keys()], runs = [...new Set(parts.map(({run}) => run))];
  const triangles = trianglesOf(face, runs), taken = new Map(runs.map((run) => [run, 0]));
  const texcoords = new Map(runs.map((run) => [run, texcoordsOf(face, run)]));
  for (const part of byMaterial(json, parts)) {
    const {run} = part, geometry = geometries.get(part), {indices, attributes} = primitiveOf(json, part);
    const isLeft = isEmpty(json, indices), all = triangles.get(run), begin = taken.get(run);
    const end = begin + (isLeft ? geometry.index.count : 3 * countTriangles(geometry));
    if (end > all.length) throw unfit(name);
    taken.set(run, end);
    if (isLeft) geometry.setIndex(new BufferAttribute(all.subarray(begin, end), 1));
    if (isEmpty(json, attributes.TEXCOORD_0)) geometry.setAttribute('uv', texcoords.get(run));
    geometry.morphAttributes = {};
  }
}
