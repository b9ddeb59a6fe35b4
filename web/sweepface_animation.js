// Makes clips for faces from animations of glTF files, as three.js's own loader reads them.
import {AnimationClip, NumberKeyframeTrack, PropertyBinding} from 'three';

/**
 * Extracts one target's track from a track of `count` targets: a value per key, or three if it is a cubic spline. `node`
 * is the name of the mesh, or '' for that which the mixer is of.
 */
function trackFor(name, track, place, count, node = '') {
  const {times, values} = track, stride = track.getValueSize(), rows = stride / count;
  const own = Float32Array.from({length: rows * times.length}, (_, k) => {
    return values[Math.floor(k / rows) * stride + (k % rows) * count + place];
  });
  const made = new NumberKeyframeTrack(`${node}.morphTargetInfluences[${name}]`, times, own);
  made.createInterpolant = track.createInterpolant;  // steps, straight lines or splines
  return made;
}

const moves = ({values}) => values.some((value) => value !== 0);

/** The targets that a track moves, as [name, place], how many targets it holds, and the name of their mesh. */
function targetsOf(track, scene) {
  const {nodeName, propertyName, propertyIndex: one} = PropertyBinding.parseTrackName(track.name);
  const mesh = propertyName === 'morphTargetInfluences' ? PropertyBinding.findNode(scene, nodeName) : undefined;
  const places = mesh?.morphTargetDictionary ?? {};
  if (one === undefined) return {targets: Object.entries(places), count: mesh?.morphTargetInfluences?.length, nodeName};
  const name = one in places ? one : Object.keys(places).find((key) => String(places[key]) === one);
  return {targets: name === undefined ? [] : [[name, 0]], count: 1, nodeName};
}

/** Tracks for the targets of a face, or undefined if the animation has none for them. */
function tracksFor(face, scene, animation) {
  const unmoved = new Set(face.names), tracks = [];
  for (const track of animation.tracks) {
    const {targets, count} = targetsOf(track, scene);
    for (const [name, place] of targets)
      if (unmoved.delete(name)) tracks.push(trackFor(name, track, place, count));
  }
  return tracks.length > 0 ? tracks.filter(moves) : undefined;
}

/**
 * Makes a clip for a face from an animation of a glTF file, by default the first that has tracks for any of its targets. It
 * has a track for each target of the face that ever leaves 0. Of several tracks for a target the first counts.
 */
export function animationFor(face, gltf, animation) {
  if (!Array.isArray(face?.names) || !Array.isArray(gltf?.animations))
    throw new TypeError('animationFor takes a face and what GLTFLoader read.');
  for (const each of animation ? [animation] : gltf.animations) {
    const tracks = gltf.scene && tracksFor(face, gltf.scene, each);
    if (tracks) return new AnimationClip(each.name, each.duration, tracks);
  }
  throw new Error('The file has no animation of targets that the face has; they are matched by name.');
}

/**
 * An animation in which every track of all targets of a mesh in the scene has made room for tracks of those that ever leave
 * 0, so that the others can be moved meanwhile.
 */
export function apart(animation, scene) {
  const tracks = animation.tracks.flatMap((track) => {
    const {targets, count, nodeName} = targetsOf(track, scene);
    if (targets.length === 0) return track;
    return targets.map(([name, place]) => trackFor(name, track, place, count, nodeName)).filter(moves);
  });
  return new AnimationClip(animation.name, animation.duration, tracks);
}
