// Animations of glTF files, as three.js's own loader reads them, for faces.
import {AnimationClip, NumberKeyframeTrack, PropertyBinding} from 'three';

/** The rows that a track has for each key: a value, or three where it is a cubic spline, [rows][targets]. */
function column(track, target, count) {
  const stride = track.getValueSize(), rows = stride / count, {times, values} = track;
  return Float32Array.from({length: rows * times.length}, (_, k) => {
    return values[Math.floor(k / rows) * stride + (k % rows) * count + target];
  });
}

/** Of all targets together a track for one. */
function trackFor(name, track, values) {
  const own = new NumberKeyframeTrack(`.morphTargetInfluences[${name}]`, track.times, values, track.getInterpolation());
  if (Object.hasOwn(track, 'createInterpolant')) own.createInterpolant = track.createInterpolant;
  return own;
}

/**
 * An animation of a glTF file as a clip for a face: a track for each target that the face has and that ever leaves 0.
 * Where several meshes have a target, the first counts.
 */
export function animationFor(face, gltf, animation = gltf?.animations?.[0]) {
  if (!Array.isArray(face?.names) || !gltf?.scene || !Array.isArray(animation?.tracks))
    throw new TypeError('animationFor takes a face and what GLTFLoader read, and which of its animations.');
  const known = new Set(face.names), tracks = [];
  for (const track of animation.tracks) {
    const {nodeName, propertyName} = PropertyBinding.parseTrackName(track.name);
    const places = PropertyBinding.findNode(gltf.scene, nodeName)?.morphTargetDictionary;
    if (propertyName !== 'morphTargetInfluences' || !places) continue;
    for (const [name, place] of Object.entries(places)) {
      const values = column(track, place, Object.keys(places).length);
      if (!known.delete(name) || !values.some((value) => value !== 0)) continue;
      tracks.push(trackFor(name, track, values));
    }
  }
  return new AnimationClip(animation.name, animation.duration, tracks);
}
