// A page in headless Chromium without a network: the modules that pages load from jsDelivr come
// from node_modules, of exactly the version they name.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import path from 'node:path';
import zlib from 'node:zlib';
import { chromium } from 'playwright-core';

const types = { '.html': 'text/html', '.js': 'text/javascript', '.glb': 'model/gltf-binary',
                '.wasm': 'application/wasm', '.json': 'application/json' };

// With these a page may share memory between threads, but nothing may come from elsewhere.
const isolated = { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' };

function serve(folders, headers) {
  const server = createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url, 'http://localhost').pathname).slice(1) || 'index.html';
    for (const folder of folders) {
      try {
        const body = readFileSync(path.join(folder, path.normalize(name)));
        response.writeHead(200, { 'content-type': types[path.extname(name)] ?? 'application/octet-stream', ...headers });
        return response.end(body);
      } catch { /* in the next folder, perhaps */ }
    }
    response.writeHead(404).end();
  });
  return new Promise((done) => server.listen(0, '127.0.0.1', () => done(server)));
}

export const modules = new URL('node_modules/', import.meta.url);

async function fromModules(route) {
  const [, name, version, file] = route.request().url().match(/\/npm\/([^@/]+)@([^/]+)\/(.*)$/);
  const installed = JSON.parse(readFileSync(new URL(`${name}/package.json`, modules))).version;
  if (installed !== version) return route.fulfill({ status: 404, body: `version ${installed} is tested` });
  return route.fulfill({ body: readFileSync(new URL(`${name}/${file}`, modules)), contentType: 'text/javascript' });
}

/**
 * Opens `address` of a page served from `folders` and passes it to `use`, with its console output. An `alone` page may
 * start threads that share its memory, but gets nothing from elsewhere.
 */
export async function withPage(folders, address, use, { alone = false } = {}) {
  const server = await serve(folders, alone ? isolated : {});
  const browser = await chromium.launch({
    executablePath: process.env.SWEEPFACE_CHROMIUM,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  try {
    const page = await browser.newPage({ viewport: { width: 640, height: 480 } });
    page.setDefaultTimeout(120_000);  // the machine may be busy
    const said = [];
    page.on('console', (message) => said.push(`${message.type()}: ${message.text()}`));
    page.on('pageerror', (error) => said.push(`uncaught: ${error.message}`));
    page.on('requestfailed', (request) => said.push(`no ${request.url()}`));
    await page.route('https://cdn.jsdelivr.net/**', fromModules);
    await page.goto(`http://127.0.0.1:${server.address().port}/${address}`);
    return await use(page, said);
  } finally {
    await browser.close();
    server.close();
  }
}

/** The picture in a PNG of 8 bits a channel, as Playwright writes them. */
export function pixels(png) {
  const parts = [];
  let width, height, channels;
  for (let at = 8; at < png.length;) {
    const length = png.readUInt32BE(at), kind = png.toString('latin1', at + 4, at + 8);
    const body = png.subarray(at + 8, at + 8 + length);
    if (kind === 'IHDR') [width, height, channels] = [body.readUInt32BE(0), body.readUInt32BE(4), body[9] === 6 ? 4 : 3];
    if (kind === 'IDAT') parts.push(body);
    at += 12 + length;
  }
  const raw = zlib.inflateSync(Buffer.concat(parts)), row = width * channels;
  const data = new Uint8Array(row * height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < row; ++x) {
      const left = x < channels ? 0 : data[y * row + x - channels], up = y === 0 ? 0 : data[(y - 1) * row + x];
      const corner = x < channels || y === 0 ? 0 : data[(y - 1) * row + x - channels];
      const p = left + up - corner, [a, b, c] = [left, up, corner].map((v) => Math.abs(p - v));
      const paeth = a <= b && a <= c ? left : b <= c ? up : corner;
      const filter = [0, left, up, (left + up) >> 1, paeth][raw[y * (row + 1)]];
      data[y * row + x] = raw[y * (row + 1) + 1 + x] + filter;
    }
  return { width, height, channels, data };
}

/** The share of pixels that differ by more than `limit` in some channel. */
export function difference(a, b, limit = 8) {
  let count = 0;
  for (let k = 0; k < a.width * a.height; ++k) {
    let most = 0;
    for (let c = 0; c < 3; ++c)
      most = Math.max(most, Math.abs(a.data[k * a.channels + c] - b.data[k * b.channels + c]));
    count += most > limit;
  }
  return count / (a.width * a.height);
}
