// Pins: objects in a three.js scene that follow a point of a face's skin and turn with it.
import {Matrix4, Object3D, Quaternion, Triangle, Vector3} from 'three';

/** The largest coordinate, so that squared distances stay finite. */
const MOST_COORDINATE = 1e100;

/** Sets a triangle to the positions of its corners. */
function placed(triangle, corners, positions) {
  ['a', 'b', 'c'].forEach((name, k) => triangle[name].fromArray(positions, 3 * corners[k]));
  return triangle;
}

/** The orientation of a triangle, or undefined if it is degenerate. */
function turnOf({a, b, c}) {
  const along = b.clone().sub(a), across = c.clone().sub(a), normal = along.clone().cross(across);
  if (!(normal.length() > 1e-5 * Math.max(along.lengthSq(), across.lengthSq()))) return undefined;
  along.normalize();
  normal.normalize();
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(along, normal.clone().cross(along), normal));
}

/** The non-degenerate triangle nearest to a point, and the nearest point on it. */
function nearestTo(point, triangles, positions) {
  const triangle = new Triangle(), place = new Vector3();
  let nearest = {distance: Infinity};
  for (let k = 0; k < triangles.length; k += 3) {
    const corners = triangles.subarray(k, k + 3);
    const distance = placed(triangle, corners, positions).closestPointToPoint(point, place).distanceToSquared(point);
    if (distance < nearest.distance && turnOf(triangle)) nearest = {distance, corners, place: place.clone()};
  }
  return nearest;
}

/** How a pin hangs on the skin, and the pose that it was last moved to. Not private, so that they work behind a Proxy, too. */
const anchor = Symbol('anchor'), shown = Symbol('shown');

/** An object fastened to the skin. When it is fastened, its axes are the face's own. */
export class Pin extends Object3D {
  /** Fastens it to the skin at the positions of a pose; `pose` is an object that identifies that pose. */
  fasten(point, triangles, positions, pose) {
    if (![point?.x, point?.y, point?.z].every((x) => Math.abs(x) <= MOST_COORDINATE))
      throw new TypeError('A pin takes a point: a Vector3 in the coordinates of the face.');
    const {corners, place} = nearestTo(point, triangles, positions);
    if (!corners) throw new Error('The face has no skin for a pin.');
    const triangle = placed(new Triangle(), corners, positions), {length: size} = positions;
    const shares = triangle.getBarycoord(place, new Vector3()).toArray();
    this[anchor] = {corners: Array.from(corners), shares, unturned: turnOf(triangle).invert(), size};
    return this.follow(positions, pose);
  }

  /** Whether it hangs on a skin of `size` position numbers and has not followed it to this pose yet. */
  isBehind(size, pose) { return this[anchor]?.size === size && this[shown] !== pose; }

  /** Moves it to where the skin stands in a pose. */
  follow(positions, pose) {
    const {corners, shares, unturned} = this[anchor], triangle = placed(new Triangle(), corners, positions);
    const {a, b, c} = triangle, turn = turnOf(triangle);
    if (turn) this.quaternion.copy(turn).multiply(unturned);
    this.position.copy(a).multiplyScalar(shares[0]).addScaledVector(b, shares[1]).addScaledVector(c, shares[2]);
    this[shown] = pose;
    return this;
  }

  copy(source, recursive) {
    this[anchor] = source[anchor];
    return super.copy(source, recursive);
  }
}
