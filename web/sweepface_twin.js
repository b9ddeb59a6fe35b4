// Copies of faces.

/** Another face of the same file, in the same pose. */
export function twinOf(face) {
  const twin = face.clone(), regions = twin.regions.length > 0 ? twin.regions : [undefined];
  for (const region of regions) {
    const weights = region === undefined ? face.weights : face.weightsIn(region);
    const set = Object.entries(weights).filter(([, weight]) => weight !== 0);  // if none, no targets need to be read
    twin.setWeights(Object.fromEntries(set), region);
  }
  if (face.pose) twin.look(face.pose);
  return twin;
}
