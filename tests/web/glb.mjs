// Parses a GLB without any library.
import { readFileSync } from 'node:fs';

const componentTypes = { 5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array,
                         5125: Uint32Array, 5126: Float32Array };
const componentCounts = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };

export class Glb {
  constructor(file) {
    const bytes = readFileSync(file);
    const jsonEnd = 20 + bytes.readUInt32LE(12);
    this.json = JSON.parse(bytes.subarray(20, jsonEnd).toString('utf8'));
    this.binary = bytes.subarray(jsonEnd + 8);
  }

  view(index) {
    const { byteOffset = 0, byteLength } = this.json.bufferViews[index];
    return this.binary.subarray(byteOffset, byteOffset + byteLength);
  }

  image(index) {
    return this.view(this.json.images[index].bufferView);
  }

  /** The numbers of an accessor, one after another; normalized ones as fractions. */
  numbers(index) {
    const { bufferView, byteOffset, componentType, count, type, normalized, sparse } = this.json.accessors[index];
    const width = componentCounts[type], numbers = new Float64Array(count * width);
    const scale = normalized ? 1 / { 5120: 127, 5121: 255, 5122: 32767, 5123: 65535 }[componentType] : 1;
    const read = (view, offset, n, Type, rowWidth) => {
      const bytes = this.view(view), stride = this.json.bufferViews[view].byteStride ?? rowWidth * Type.BYTES_PER_ELEMENT;
      return Array.from({ length: n }, (_, row) => {
        const start = offset + row * stride;
        return [...new Type(Uint8Array.from(bytes.subarray(start, start + rowWidth * Type.BYTES_PER_ELEMENT)).buffer)];
      });
    };
    const Type = componentTypes[componentType];
    const put = (row, values) => values.forEach((v, k) => { numbers[row * width + k] = Math.max(v * scale, normalized ? -1 : -Infinity); });
    if (bufferView !== undefined) read(bufferView, byteOffset ?? 0, count, Type, width).forEach((v, row) => put(row, v));
    if (sparse) {
      const rows = read(sparse.indices.bufferView, sparse.indices.byteOffset ?? 0, sparse.count, componentTypes[sparse.indices.componentType], 1);
      const values = read(sparse.values.bufferView, sparse.values.byteOffset ?? 0, sparse.count, Type, width);
      rows.forEach(([row], k) => put(row, values[k]));
    }
    return numbers;
  }

  primitives() {
    return this.json.meshes.flatMap((mesh, m) => mesh.primitives.map((primitive, p) => ({ mesh, m, p, primitive })));
  }
}

/** The largest distance between corresponding points of two lists of coordinates. */
export function farthest(a, b) {
  if (a.length !== b.length) return Infinity;
  let most = 0;
  for (let k = 0; k < a.length; k += 3)
    most = Math.max(most, Math.hypot(a[k] - b[k], a[k + 1] - b[k + 1], a[k + 2] - b[k + 2]));
  return most;
}
