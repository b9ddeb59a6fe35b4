// The scene that a face came with: a GLB without what the face itself holds (docs/glb.md).
const JSON_CHUNK = 0x4e4f534a, BINARY_CHUNK = 0x004e4942;
const isGlb = (bytes) => String.fromCharCode(...bytes.subarray(0, 4)) === 'glTF';
const viewOf = (bytes) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

/** Inflates a zlib stream; what holds far more than its size can mean is refused, as by the tool. */
async function inflated(stream) {
  const most = 2 ** 16 + 256 * stream.length, parts = [];
  const reader = new Blob([stream]).stream().pipeThrough(new DecompressionStream('deflate')).getReader();
  let length = 0;
  for (let {value, done} = await reader.read(); !done; {value, done} = await reader.read()) {
    parts.push(value);
    length += value.length;
    if (length > most) {
      await reader.cancel();
      throw new RangeError();
    }
  }
  const all = new Uint8Array(length);
  parts.reduce((at, part) => (all.set(part, at), at + part.length), 0);
  return all;
}

/** Undoes the planes of tables of numbers: the format is described in docs/file-format.md. */
function fromPlanes(planes) {
  const view = viewOf(planes), tables = [];
  let at = 4, end = 0;
  for (let left = view.getUint32(0, true); left > 0; --left) {
    const [begin, width, rows] = [0, 4, 8].map((field) => view.getUint32(at + field, true));
    const steps = planes.subarray(at + 12, at + 12 + width), size = width * rows;
    const isSound = begin >= end && size > 0 && steps.length === width && steps.every((step) => step < 2);
    if (!isSound || begin + size > planes.length) throw new RangeError();
    tables.push({begin, width, rows, steps});
    at += 12 + width;
    end = begin + size;
  }
  const turned = planes.subarray(at), bytes = turned.slice();
  if (end > bytes.length) throw new RangeError();
  for (const {begin, width, rows, steps} of tables)
    for (let plane = 0; plane < width; ++plane)
      for (let row = 0, before = 0; row < rows; ++row) {
        const byte = turned[begin + plane * rows + row];
        bytes[begin + row * width + plane] = before = steps[plane] ? before + byte & 255 : byte;
      }
  return bytes;
}

async function glbFrom(text) {
  if (isGlb(text)) return text;
  return text[0] === 1 ? fromPlanes(await inflated(text.subarray(1))) : inflated(text);
}

/** The JSON and the binary part of a GLB. */
function parse(glb) {
  const view = viewOf(glb), read = {binary: new Uint8Array()};
  if (!isGlb(glb)) throw new RangeError();
  for (let at = 12; at < glb.length; at += 8 + view.getUint32(at, true)) {
    const bytes = glb.subarray(at + 8, at + 8 + view.getUint32(at, true)), kind = view.getUint32(at + 4, true);
    if (kind === JSON_CHUNK) read.json = JSON.parse(new TextDecoder().decode(bytes));
    if (kind === BINARY_CHUNK) read.binary = bytes;
  }
  return read;
}

/** A GLB, as an ArrayBuffer. */
export function formatGlb({json, binary}) {
  const text = new TextEncoder().encode(JSON.stringify(json)), padded = (length) => Math.ceil(length / 4) * 4;
  const first = padded(text.length), second = padded(binary.length), hasBinary = binary.length > 0;
  const glb = new Uint8Array(20 + first + (hasBinary ? 8 + second : 0)), view = viewOf(glb);
  [0x46546c67, 2, glb.length, first, JSON_CHUNK].forEach((number, k) => view.setUint32(4 * k, number, true));
  glb.fill(0x20, 20, 20 + first).set(text, 20);
  if (!hasBinary) return glb.buffer;
  view.setUint32(20 + first, second, true);
  view.setUint32(24 + first, BINARY_CHUNK, true);
  glb.set(binary, 28 + first);
  return glb.buffer;
}

/** What to throw about a scene that cannot be read. */
export const damaged = (name, cause) => new Error(`${name}: its scene is damaged; convert the source again.`, {cause});

/** A scene as {json, binary}, from the text of a file's chunk. */
export async function sceneFrom(text, name) {
  if (!globalThis.DecompressionStream)
    throw new Error(`${name}: its scene cannot be read here, where there is no DecompressionStream; use a newer browser.`);
  try {
    return parse(await glbFrom(text));
  } catch (cause) {
    throw damaged(name, cause);
  }
}
