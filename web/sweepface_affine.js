// Affine transforms as glTF has them: 16 numbers, column by column.

export const IDENTITY = Object.freeze([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);

/** How a node is placed in its parent. */
export function affineOf({matrix, translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1]}) {
  if (matrix) return matrix;
  const [x, y, z, w] = rotation, [a, b, c] = scale;
  return [
    a * (1 - 2 * (y * y + z * z)), a * 2 * (x * y + z * w), a * 2 * (x * z - y * w), 0,
    b * 2 * (x * y - z * w), b * (1 - 2 * (x * x + z * z)), b * 2 * (y * z + x * w), 0,
    c * 2 * (x * z + y * w), c * 2 * (y * z - x * w), c * (1 - 2 * (x * x + y * y)), 0,
    ...translation, 1
  ];
}

/** `inner`, followed by `outer`. */
export const product = (outer, inner) => IDENTITY.map((_, k) => {
  const row = k % 4, column = k - row;
  return [0, 1, 2, 3].reduce((sum, j) => sum + outer[4 * j + row] * inner[column + j], 0);
});

const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
const dot = ([a, b, c], [x, y, z]) => a * x + b * y + c * z;
const columnsOf = (m) => [0, 4, 8, 12].map((k) => [m[k], m[k + 1], m[k + 2]]);

/** Of the linear part; below 0 if it mirrors. */
export function determinant(m) {
  const [x, y, z] = columnsOf(m);
  return dot(x, cross(y, z));
}

export function inverse(m) {
  const [x, y, z, place] = columnsOf(m), d = determinant(m);
  const rows = [cross(y, z), cross(z, x), cross(x, y)].map((row) => row.map((value) => value / d));
  const [a, b, c] = rows;
  return [a[0], b[0], c[0], 0, a[1], b[1], c[1], 0, a[2], b[2], c[2], 0, ...rows.map((row) => -dot(row, place)), 1];
}

/** Transforms points [n x 3] in their place. */
export function transform(m, points) {
  for (let k = 0; k < points.length; k += 3) {
    const x = points[k], y = points[k + 1], z = points[k + 2];
    for (let row = 0; row < 3; ++row) points[k + row] = m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row];
  }
}

/** Brings normals [n x 3] back to where `m` places things from. */
export function transformNormalsBack(m, normals) {
  for (let k = 0; k < normals.length; k += 3) {
    const x = normals[k], y = normals[k + 1], z = normals[k + 2];
    const a = m[0] * x + m[1] * y + m[2] * z, b = m[4] * x + m[5] * y + m[6] * z, c = m[8] * x + m[9] * y + m[10] * z;
    const length = Math.hypot(a, b, c) || 1;
    normals[k] = a / length;
    normals[k + 1] = b / length;
    normals[k + 2] = c / length;
  }
}
