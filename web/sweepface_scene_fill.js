// What a scene leaves to its face (docs/glb.md, "The scene"): triangles and texture coordinates, which do not change.
import {BufferAttribute} from 'three';

/** What is wrong with a scene that belongs to another face. */
export const unfit = (name) => new Error(`${name}: the face and its scene do not fit; convert the source again.`);

const repainted = (name) =>
  new Error(`${name}: the face has other materials than its scene; export it as a .glb and convert that.`);

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

/** How many triangles of three different vertices a geometry has. */
function countTriangles({index, attributes: {position}}) {
  if (!index) return Math.floor(position.count / 3);
  let count = 0;
  for (let k = 0; k + 2 < index.count; k += 3) {
    const a = index.getX(k), b = index.getX(k + 1), c = index.getX(k + 2);
    count += a !== b && b !== c && c !== a;
  }
  return count;
}

/** The names of a scene's materials in the face: a number tells those of one name apart. */
function materialNames({materials = []}) {
  const taken = new Set(), again = new Map();
  return materials.map(({name: own}, k) => {
    const wanted = typeof own === 'string' && own !== '' ? own : `material_${k}`;
    let name = wanted;
    while (taken.has(name)) {
      again.set(wanted, (again.get(wanted) ?? 1) + 1);
      name = `${wanted} ${again.get(wanted)}`;
    }
    taken.add(name);
    return name;
  });
}

/**
 * The parts in the order in which the face lists its triangles: by material, in the order of their first use, those
 * without one first. `counts` are the triangles of the parts. Returns undefined if the face has other materials.
 */
function inOrder(json, parts, counts, face) {
  const listed = face.parts, names = materialNames(json);
  if (listed.length === 1) return parts;
  const groups = new Map([[undefined, []]]);
  for (const part of parts) {
    const {material} = primitiveOf(json, part);
    groups.set(material, [...groups.get(material) ?? [], part]);
  }
  const sum = (group) => group.reduce((total, part) => total + 3 * counts.get(part), 0);
  const own = [...groups].filter(([, group]) => sum(group) > 0);
  const isSame = own.length === listed.length && own.every(([material, group], k) => {
    return listed[k].count === sum(group) && listed[k].material === (names[material] ?? '');
  });
  return isSame ? own.flatMap(([, group]) => group) : undefined;
}

/** Gives the geometries of the parts, a map from these, what the scene leaves to the face. */
export function fill(json, geometries, face, name) {
  const {triangles, texcoords, copies, pointCount} = face, parts = [...geometries.keys()];
  const isLeft = (part) => isEmpty(json, primitiveOf(json, part).indices);
  const counts = new Map(parts.map((part) => {
    const geometry = geometries.get(part);
    return [part, isLeft(part) ? geometry.index.count / 3 : countTriangles(geometry)];
  }));
  if (3 * parts.reduce((sum, part) => sum + counts.get(part), 0) !== triangles.length) throw unfit(name);
  const ordered = inOrder(json, parts, counts, face), uvs = new Map();
  if (!ordered) throw repainted(name);
  let at = 0;
  for (const part of ordered) {
    const {run: {first, count, mirrors}} = part, geometry = geometries.get(part), end = at + 3 * counts.get(part);
    const hasUv = texcoords && isEmpty(json, primitiveOf(json, part).attributes.TEXCOORD_0);
    if (!isLeft(part)) at = end;
    else geometry.setIndex(new BufferAttribute(count < 65536 ? new Uint16Array(end - at) : new Uint32Array(end - at), 1));
    if (hasUv && !uvs.has(part.run)) uvs.set(part.run, new BufferAttribute(new Float32Array(2 * count), 2));
    if (hasUv) geometry.setAttribute('uv', uvs.get(part.run));
    for (let k = 0; at < end; ++at, ++k) {
      const vertex = triangles[at], own = (vertex < pointCount ? vertex : copies[vertex - pointCount]) - first;
      if (!(own >= 0 && own < count)) throw unfit(name);
      geometry.index.array[mirrors && k % 3 > 0 ? k + 3 - 2 * (k % 3) : k] = own;
      if (hasUv) uvs.get(part.run).setXY(own, texcoords[2 * vertex], 1 - texcoords[2 * vertex + 1]);
    }
  }
}
