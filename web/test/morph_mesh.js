// The mesh that SweepfaceGpuMesh is compared with. Runs in pages, from the root of web/.
import * as THREE from 'three';

/** A face by three.js's own means: a mesh with a morph target, including normals, for each of its names. */
export function morphMesh(face, geometry, material) {
  const at = (weights) => {
    const positions = new Float32Array(3 * face.vertexCount), normals = new Float32Array(3 * face.vertexCount);
    face.reset();
    face.setWeights(weights);
    face.evaluate(positions, normals);
    return {positions, normals};
  };
  const neutral = at({}), targets = face.names.map((name) => at({[name]: 1})), made = geometry.clone();
  const minus = (a, b) => new THREE.BufferAttribute(a.map((x, k) => x - b[k]), 3);
  made.setAttribute('position', new THREE.BufferAttribute(neutral.positions, 3));
  made.setAttribute('normal', new THREE.BufferAttribute(neutral.normals, 3));
  made.morphTargetsRelative = true;
  made.morphAttributes.position = targets.map(({positions}) => minus(positions, neutral.positions));
  made.morphAttributes.normal = targets.map(({normals}) => minus(normals, neutral.normals));
  return new THREE.Mesh(made, material);
}
