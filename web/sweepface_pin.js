// What is attached to a face in a scene of three.js: an object that follows a point of the skin and turns with it.
import {Matrix4, Object3D, Quaternion, Triangle, Vector3} from 'three';

/** Beyond, squares of distances are no numbers. */
const MOST_COORDINATE = 1e100;

/** Brings the corners of a triangle to where they stand. */
function placed(triangle, corners, positions) {
  ['a', 'b', 'c'].forEach((name, k) => triangle[name].fromArray(positions, 3 * corners[k]));
  return triangle;
}

/** The way a triangle is turned, or nothing where it is a line. */
function turnOf({a, b, c}) {
  const along = b.clone().sub(a), across = c.clone().sub(a), normal = along.clone().cross(across);
  if (!(normal.length() > 1e-5 * Math.max(along.lengthSq(), across.lengthSq()))) return undefined;
  along.normalize();
  normal.normalize();
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(along, normal.clone().cross(along), normal));
}

/** Of the triangles that are no lines the one nearest to a point, and its point that is. */
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

/** How a pin hangs on the skin; not private, so that it is there behind a Proxy, too. */
const anchor = Symbol('anchor');

/** Stands on the skin as the face stands when it is fastened: its axes are then the face's own. */
export class Pin extends Object3D {
  /** To the skin at these positions, which are those of a pose: an object that is no other pose's. */
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

  /** Whether it hangs on this many numbers of positions and was not brought to this pose. */
  isBehind(size, pose) { return this[anchor]?.size === size && this[anchor].pose !== pose; }

  /** To where the skin stands in a pose. */
  follow(positions, pose) {
    const {corners, shares, unturned} = this[anchor], triangle = placed(new Triangle(), corners, positions);
    const {a, b, c} = triangle, turn = turnOf(triangle);
    if (turn) this.quaternion.copy(turn).multiply(unturned);
    this.position.copy(a).multiplyScalar(shares[0]).addScaledVector(b, shares[1]).addScaledVector(c, shares[2]);
    this[anchor] = {...this[anchor], pose};
    return this;
  }

  copy(source, recursive) {
    this[anchor] = source[anchor];
    return super.copy(source, recursive);
  }
}
