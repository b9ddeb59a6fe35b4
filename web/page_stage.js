// The page's view of a face: renderer, lights, orbiting camera and colours.
import {
  BackSide, Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, HemisphereLight, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, MeshStandardMaterial, PerspectiveCamera, Scene, Spherical, Vector3,
  WebGLRenderer
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {sceneJson, SweepfaceSceneLoader} from 'sweepface/scene';
import {SweepfaceLoader, SweepfaceMesh} from 'sweepface/three';
import {at, complain} from './page_message.js';

export const stage = at('stage'), view = at('view');

const renderer = makeRenderer();
export const scene = new Scene();
const FIELD = 26;  // vertical field of view in degrees, for the picture in which a face was placed
const camera = new PerspectiveCamera(FIELD, 1, 0.1, 1000);
export const controls = new OrbitControls(camera, view);
controls.enableDamping = true;
controls.enablePan = false;

// A large soft light; a key light from the upper left and a rim light from behind, both attached to the camera.
const key = new DirectionalLight(0xfff1e2, 2.4), rim = new DirectionalLight(0xbfd4ff, 1.6);
key.position.set(-1, 1.2, 1.6);
rim.position.set(1.4, 0.6, -1.5);
scene.add(new HemisphereLight(0xffffff, 0x8a7668, 1.3), camera);
camera.add(key, key.target, rim, rim.target);

function makeRenderer() {
  try {
    return new WebGLRenderer({canvas: view, antialias: true, alpha: true});
  } catch (error) {
    complain(new Error('Drawing faces needs WebGL 2, which this browser or its settings do not offer.'));
    throw error;
  }
}

/** The materials of a head's inside, seen through eyes and mouth, and of its edges. */
const inside = new MeshBasicMaterial({color: 0x2b1a14, side: BackSide});
const ink = new LineBasicMaterial({color: 0x5a2c14, transparent: true, opacity: 0.35});

/** A colour for a material, guessed from its name. */
function colourOf(name) {
  const known = [[/lip|mouth|tongue|gum/i, 0xb8675c], [/teeth|tooth/i, 0xf0e8d8], [/lash|brow|hair|beard/i, 0x3a2a22],
                 [/iris/i, 0x61757f], [/pupil/i, 0x1f1c1c], [/nostril/i, 0x734539], [/eye|sclera|cornea/i, 0xf4f1ee]];
  return new Color(known.find(([pattern]) => pattern.test(name))?.[1] ?? 0xd9a688);
}

/** A face in the colours of its materials, with its inside. */
class FaceInColours extends SweepfaceMesh {
  constructor(face) {
    super(face, face.parts.map(({material}) => {
      return new MeshStandardMaterial({name: material, color: colourOf(material), roughness: 0.62});
    }));
    this.add(new Mesh(this.geometry, inside));
  }
}

/** Whether a face came with more to see than a mesh in plain colours. */
export async function hasScene(bytes, name) {
  const json = await sceneJson(bytes, name).catch(() => null);  // the face can be shown without
  const {scenes = [], textures = [], skins = [], meshes = []} = json ?? {};
  const morphs = meshes.flatMap(({primitives}) => primitives).map(({targets = []}) => targets.length > 0);
  return scenes.length > 0 && (textures.length + skins.length > 0 || new Set(morphs).size > 1);
}

/** A face to show, as `object` and what moves it, in plain colours. */
export async function loadAlone(bytes, options) {
  const mover = await new SweepfaceLoader().parseAsync(bytes, {...options, mesh: FaceInColours});
  return {mover, object: mover, meshes: [mover]};
}

/** The same with all that it came with. */
export async function loadScene(bytes, options) {
  const {scene: object, face: mover, animations, parser} = await new SweepfaceSceneLoader().parseAsync(bytes, options);
  if (parser.json.extensions?.VRM) object.rotation.y = Math.PI;  // avatars of VRM 0 look along -z
  object.traverse((each) => each.isLight && (each.visible = false));  // as the page has its own
  return {mover, object, animations, meshes: mover.meshes};
}

let unplaced;         // meshes that were loaded while the view had no area
let size, placedFor;  // size of the face on show, and height in its units of the picture the camera was placed for

const radians = (degrees) => degrees * Math.PI / 180;

/** The height that a picture of this aspect ratio must have to show the whole face. */
const heightFor = (aspect) => Math.max(size.y, size.x / aspect);

/** Places the camera in front of the meshes of a face, far enough away to see all of it. */
export function placeCamera(meshes) {
  unplaced = camera.aspect > 0 ? undefined : meshes;
  if (unplaced) return;
  scene.updateMatrixWorld();
  const box = meshes.reduce((box, mesh) => box.expandByObject(mesh, true), new Box3());
  const middle = box.getCenter(new Vector3());
  size = box.getSize(new Vector3());
  placedFor = heightFor(camera.aspect);
  const distance = 1.15 * placedFor / 2 / Math.tan(radians(FIELD / 2)) + size.z / 2;
  controls.target.copy(middle);
  camera.position.copy(middle).add(new Vector3(0.25, 0.06, 1).setLength(distance));
  camera.near = distance / 100;
  camera.far = 10 * distance;
  widen();
  controls.minDistance = distance / 6;
  controls.maxDistance = 3 * distance;
  controls.update();
}

/** Adapts the field of view to the picture's shape, so that as much of the face is seen as when it was placed. */
function widen() {
  const share = camera.aspect > 0 && placedFor > 0 ? heightFor(camera.aspect) / placedFor : 1;
  camera.fov = 2 * Math.atan(share * Math.tan(radians(FIELD / 2))) / radians(1);
  camera.updateProjectionMatrix();
}

/** The edges of triangles over `count` vertices, each once, as pairs of vertices. */
function edgesOf(triangles, count) {
  const edges = new Set();
  for (let first = 0; first < triangles.length; first += 3)
    for (let k = 0; k < 3; ++k) {
      const a = triangles[first + k], b = triangles[first + (k + 1) % 3];
      edges.add(Math.min(a, b) * count + Math.max(a, b));
    }
  const ends = new Uint32Array(2 * edges.size);
  let end = 0;
  for (const edge of edges) {
    ends[end++] = Math.floor(edge / count);
    ends[end++] = edge % count;
  }
  return ends;
}

/** Lines along the edges of a mesh; they share its positions and so follow them. */
export function linesOver(mesh) {
  const edges = new BufferGeometry(), {index, attributes: {position}} = mesh.geometry;
  edges.setIndex(new BufferAttribute(edgesOf(index.array, position.count), 1));
  edges.setAttribute('position', position);
  const lines = new LineSegments(edges, ink);
  lines.frustumCulled = false;  // bounds would be those of the current pose
  mesh.add(lines);
  return lines;
}

/** Removes lines, but not the positions, which belong to the face. */
export function removeLines(lines) {
  lines.removeFromParent();
  lines.geometry.deleteAttribute('position').dispose();
}

/** Fits the picture to the page. */
export function resize() {
  const {clientWidth, clientHeight} = stage;
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setSize(clientWidth, clientHeight, false);
  camera.aspect = clientWidth / Math.max(clientHeight, 1);
  widen();
  if (unplaced) placeCamera(unplaced);
}

/** How keys move the camera: radians to the right, radians down, and a factor on its distance. */
const MOVES = {
  ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, -0.1, 1], ArrowDown: [0, 0.1, 1],
  '+': [0, 0, 0.9], '=': [0, 0, 0.9], '-': [0, 0, 1 / 0.9], '_': [0, 0, 1 / 0.9]
};

/** Orbits and zooms by keys, as the pointer does. */
view.addEventListener('keydown', (event) => {
  const move = MOVES[event.key];
  if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  const from = new Spherical().setFromVector3(camera.position.clone().sub(controls.target));
  from.theta += move[0];
  from.phi += move[1];
  from.radius *= move[2];
  camera.position.setFromSpherical(from.makeSafe()).add(controls.target);
  controls.update();
});

/** Whether the WebGL context is lost for now. */
export const isLost = () => renderer.getContext().isContextLost();

export function render() {
  renderer.render(scene, camera);
}
