// Models become faces by the tool in WebAssembly, where that lies beside the page.
import {at, complain, tell} from './page_message.js';

const isModel = (name) => /\.(glb|vrm)$/i.test(name);

let compiled;
/** The tool's module, once it was had. */
async function theModule(name) {
  const response = compiled ? undefined : await fetch('tool/sweepface_tool.wasm').catch(() => undefined);
  if (!compiled && !response?.ok)
    throw new Error(`${name} is a model; to convert it the page needs tool/sweepface_tool.wasm, which make web-tool makes.`);
  return compiled ??= await WebAssembly.compile(await response.arrayBuffer());
}

let working;  // what ends the conversion under way

/** Ends the conversion under way, as a face is shown that was asked for later. */
export function stopConverting() {
  working?.abort();
}

/** The bytes of a face, given those of a file, which are converted if it is a model, or promises of them. */
export async function faceOf(source, name) {
  if (!isModel(name)) return source;
  stopConverting();
  const {signal} = working = new AbortController();
  const [model, {convert}, wasm] = await Promise.all([source, import('./tool/sweepface_tool.js'), theModule(name)]);
  if (!model) return;
  const onProgress = ({share, what}) => tell(`Converting ${name}… ${Math.round(100 * share)} % ${what}`);
  const {bytes, warnings} = await convert({[name]: model}, {pack: true, wasm, signal, onProgress});
  if (warnings.length > 0) complain(new Error(warnings.join(' ')));
  return bytes.buffer;
}

/** Offers to save a face that was converted. */
export function offerFile(bytes, name) {
  const link = at('save');
  URL.revokeObjectURL(link.href);
  link.hidden = !isModel(name);
  if (link.hidden) return link.removeAttribute('href');
  link.href = URL.createObjectURL(new Blob([bytes], {type: 'application/octet-stream'}));
  link.download = name.replace(/\.\w+$/, '.sweep');
}
