// What is attached to a face in a scene of three.js: an object that follows a point of the skin and turns with it.
import {Matrix4, Object3D, Quaternion, Triangle, Vector3} from 'three';

const vectorAt = (positions, vertex) => new Vector3().fromArray(positions, 3 * vertex);

/** Three corners as they stand. */
const triangleOf = (corners, positions) => new Triangle(...corners.map((vertex) => vectorAt(positions, vertex)));

/** The way a triangle is turned, or nothing where it is none. */
function turnOf({a, b, c}) {
  const along = b.clone().sub(a).normalize(), normal = along.clone().cross(c.clone().sub(a)).normalize();
  if (!(normal.lengthSq() > 0.5)) return undefined;
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(along, normal.clone().cross(along), normal));
}

/** The triangle that is nearest to a point, by its corners, and the point of it that is. */
function nearestTo(point, triangles, positions) {
  const found = {distance: Infinity, corners: undefined, place: new Vector3()}, place = new Vector3();
  for (let k = 0; k < triangles.length; k += 3) {
    const corners = Array.from(triangles.subarray(k, k + 3)), triangle = triangleOf(corners, positions);
    if (!(triangle.getArea() > 0)) continue;
    const distance = triangle.closestPointToPoint(point, place).distanceToSquared(point);
    if (distance < found.distance) Object.assign(found, {distance, corners, place: place.clone()});
  }
  return found;
}

/** Stands on the skin as the face stands when it is fastened: its axes are then the face's own. */
export class Pin extends Object3D {
  #corners;  // of a triangle
  #shares;  // of each in the place of the pin
  #rest;  // how the triangle was turned, inverted

  fasten(point, triangles, positions) {
    if (![point?.x, point?.y, point?.z].every(Number.isFinite))
      throw new TypeError('A pin takes a point: a Vector3 in the coordinates of the face.');
    const {corners, place} = nearestTo(point, triangles, positions);
    if (!corners) throw new Error('The face has no skin for a pin.');
    const triangle = triangleOf(corners, positions);
    this.#corners = corners;
    this.#shares = triangle.getBarycoord(place, new Vector3()).toArray();
    this.#rest = turnOf(triangle).invert();
    return this.follow(positions);
  }

  /** Where the skin stands now. */
  follow(positions) {
    const {a, b, c} = triangleOf(this.#corners, positions), [s, t, u] = this.#shares;
    this.position.copy(a).multiplyScalar(s).addScaledVector(b, t).addScaledVector(c, u);
    const turn = turnOf({a, b, c});
    if (turn) this.quaternion.copy(turn).multiply(this.#rest);
    return this;
  }

  copy(source, recursive) {
    this.#corners = source.#corners, this.#shares = source.#shares, this.#rest = source.#rest;
    return super.copy(source, recursive);
  }
}
