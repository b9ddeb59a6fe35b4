// What of a scene is the face, by the rules of docs/glb.md ("What is the face").
import {affineOf, determinant, IDENTITY, product} from './sweepface_affine.js';

const listOf = (holder, name) => holder?.[name] ?? [];
const LIST = 4, FAN = 6;
const isTriangles = ({mode = LIST}) => mode >= LIST && mode <= FAN;
const morphs = (primitive) => listOf(primitive, 'targets').length > 0;

/** The matrices that place the nodes in the scene; throws if nodes are children of several others or of each other. */
function worldMatrices(nodes) {
  const isChild = new Set(nodes.flatMap((node) => listOf(node, 'children'))), world = [];
  const order = [...nodes.keys()].filter((n) => !isChild.has(n));
  for (const n of order) world[n] = affineOf(nodes[n]);
  for (const n of order)  // which grows
    for (const child of listOf(nodes[n], 'children')) {
      if (world[child]) throw new RangeError();
      world[child] = product(world[n], affineOf(nodes[child]));
      order.push(child);
    }
  if (order.length !== nodes.length) throw new RangeError();
  return world;
}

/** Whether each node is in a scene. */
function areShown({scenes, nodes}) {
  if (!scenes?.length) return nodes.map(() => true);
  const shown = new Set(scenes.flatMap((scene) => listOf(scene, 'nodes')));
  for (const node of shown)  // which grows
    for (const child of listOf(nodes[node], 'children')) shown.add(child);
  return nodes.map((_, n) => shown.has(n));
}

/** How the first node that shows each mesh places it, preferably one in a scene: {world, mirrors}, or undefined. */
function placements(json) {
  const nodes = listOf(json, 'nodes'), world = worldMatrices(nodes), shown = areShown({...json, nodes}), placed = [];
  for (const isShown of [true, false])
    nodes.forEach(({mesh, skin}, n) => {
      if (mesh === undefined || shown[n] !== isShown || placed[mesh]) return;
      const isSkinned = skin !== undefined;  // by which alone the mesh is placed then
      placed[mesh] = {world: isSkinned ? IDENTITY : world[n], mirrors: determinant(world[n]) < 0};
    });
  return placed;
}

/** The names of a mesh's targets; those without one are called by their numbers. */
function targetNames(mesh, primitive) {
  const isBlank = (name) => typeof name !== 'string' || !/[^ \t-\r]/.test(name);
  const given = [mesh, primitive].map(({extras}) => extras?.targetNames).find(Array.isArray) ?? [];
  const names = primitive.targets.map((_, t) => given[t]), taken = new Set(names);
  let free = 0;  // the numbers from t up to it are taken
  return names.map((name, t) => {
    if (!isBlank(name)) return name;
    free = Math.max(free, t);
    while (taken.has(`target_${free}`)) ++free;
    taken.add(`target_${free}`);
    return `target_${free++}`;
  });
}

/** The numbers of the meshes that were chosen as the face, or undefined. */
function choiceIn({extensions, meshes = []}) {
  const choice = extensions?.SWEEPFACE_face;
  if (!choice) return undefined;
  const isMesh = (m) => Number.isInteger(m) && m >= 0 && m < meshes.length;
  if (!Array.isArray(choice.meshes) || !choice.meshes.every(isMesh)) throw new RangeError();
  return new Set(choice.meshes);
}

/** How many vertices an attribute has. */
const countOf = (json, {attributes}) => json.accessors[attributes.POSITION].count;

/**
 * The primitives that are the face, in the order of its faces. Those of a mesh that have all POSITION accessors in
 * common share a run: the vertices from `first` on. `names` are those of the targets, `world` and `mirrors` say how the
 * mesh stands in the scene.
 */
export function partsOf(json) {
  const meshes = listOf(json, 'meshes'), placed = placements(json), chosen = choiceIn(json);
  const isMorphing = ({primitives}) => primitives.some((each) => isTriangles(each) && morphs(each));
  const isAnyMorphing = meshes.some(isMorphing);
  let vertices = 0;
  const parts = meshes.flatMap((mesh, m) => {
    if (chosen && !chosen.has(m)) return [];
    const isFaced = chosen ? isMorphing(mesh) : isAnyMorphing;
    const runs = new Map(), {world = IDENTITY, mirrors = false} = placed[m] ?? {};
    let names;
    return mesh.primitives.flatMap((primitive, p) => {
      if (!isTriangles(primitive) || (isFaced && !morphs(primitive))) return [];
      names ??= morphs(primitive) ? targetNames(mesh, primitive) : [];
      const key = JSON.stringify([primitive.attributes, ...listOf(primitive, 'targets')].map(({POSITION}) => POSITION ?? null));
      if (!runs.has(key)) {
        runs.set(key, {first: vertices, count: countOf(json, primitive), world, mirrors});
        vertices += countOf(json, primitive);
      }
      return [{mesh: m, primitive: p, run: runs.get(key), names}];
    });
  });
  return {parts, vertices};
}
