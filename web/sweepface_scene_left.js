// What a scene leaves to its face (docs/glb.md, "The scene"): triangles and texture coordinates, which do not change.

/** What is wrong with a scene that belongs to another face. */
export const unfit = (name) => new Error(`${name}: the face and its scene do not fit; convert the source again.`);

const repainted = (name) =>
  new Error(`${name}: the face has other materials than its scene; export it as a .glb and convert that.`);

const LIST = 4, FAN = 6;  // modes of primitives

const primitiveOf = (json, {mesh, primitive}) => json.meshes[mesh].primitives[primitive];

/** Whether an accessor holds no data of its own. */
export function isEmpty({accessors}, index) {
  return index !== undefined && accessors[index].bufferView === undefined && accessors[index].sparse === undefined;
}

/**
 * A copy of the scene's JSON in which targets have names but no shapes of their own, which cost nothing: `hollow` makes one
 * for a primitive. Loaders then make influences for them.
 */
export function withoutShapes(given, parts, hollow) {
  const json = structuredClone(given);
  for (const part of parts.filter(({names}) => names.length > 0)) {
    const primitive = primitiveOf(json, part), mesh = json.meshes[part.mesh];
    primitive.targets = part.names.map(() => hollow(primitive));
    mesh.extras = {...mesh.extras, targetNames: part.names};
  }
  return json;
}

/** How many triangles of three different vertices a shape has: a list of corners, a strip or a fan. */
function countTriangles({indices, vertexCount, mode = LIST}) {
  const vertex = (k) => (indices ? indices[k] : k), length = indices?.length ?? vertexCount;
  const step = mode === LIST ? 3 : 1, last = mode === LIST ? length - 2 : length - 1;
  let count = 0;
  for (let k = mode === LIST ? 0 : 1; k < last; k += step) {
    const [a, b, c] = mode === LIST ? [k, k + 1, k + 2] : mode === FAN ? [0, k, k + 1] : [k - 1, k, k + 1];
    count += vertex(a) !== vertex(b) && vertex(b) !== vertex(c) && vertex(c) !== vertex(a);
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

/**
 * What the scene leaves to the face, for each part: {indices, texcoords}; what the scene has itself is undefined. Parts of a
 * run have their texture coordinates in common. `shapeOf` says what was made of a part: {indices, vertexCount, mode}.
 */
export function leftOf(json, parts, shapeOf, face, name) {
  const {triangles, texcoords, copies, pointCount} = face, left = new Map();
  const isLeft = (part) => isEmpty(json, primitiveOf(json, part).indices);
  const counts = new Map(parts.map((part) => {
    return [part, isLeft(part) ? json.accessors[primitiveOf(json, part).indices].count / 3 : countTriangles(shapeOf(part))];
  }));
  if (3 * parts.reduce((sum, part) => sum + counts.get(part), 0) !== triangles.length) throw unfit(name);
  const ordered = inOrder(json, parts, counts, face), uvs = new Map();
  if (!ordered) throw repainted(name);
  let at = 0;
  for (const part of ordered) {
    const {run: {first, count, mirrors}} = part, end = at + 3 * counts.get(part), own = {};
    const hasUv = texcoords && isEmpty(json, primitiveOf(json, part).attributes.TEXCOORD_0);
    if (isLeft(part)) own.indices = count < 65536 ? new Uint16Array(end - at) : new Uint32Array(end - at);
    if (hasUv && !uvs.has(part.run)) uvs.set(part.run, new Float32Array(2 * count));
    if (hasUv) own.texcoords = uvs.get(part.run);
    left.set(part, own);
    for (let k = 0; at < end; ++at, ++k) {
      const corner = triangles[at], vertex = (corner < pointCount ? corner : copies[corner - pointCount]) - first;
      if (!(vertex >= 0 && vertex < count)) throw unfit(name);
      if (own.indices) own.indices[mirrors && k % 3 > 0 ? k + 3 - 2 * (k % 3) : k] = vertex;
      if (hasUv) own.texcoords.set([texcoords[2 * corner], 1 - texcoords[2 * corner + 1]], 2 * vertex);
    }
  }
  return left;
}
