// Opens pages of this package in headless Chromium.
import {existsSync, readFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {extname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const folder = fileURLToPath(new URL('..', import.meta.url));
const executablePath = process.env.SWEEPFACE_CHROMIUM ?? '/usr/bin/chromium';
const {chromium} = await import('playwright-core').catch(() => ({}));
const inSoftware = '--use-angle=swiftshader --enable-unsafe-swiftshader --enable-unsafe-webgpu --use-webgpu-adapter=swiftshader';
const launchOptions = {
  executablePath, args: ['--no-sandbox', ...(process.env.SWEEPFACE_CHROMIUM_ARGS ?? inSoftware).split(' ')]
};
const types = {
  '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm'
};

/** Why there is no browser, or false. */
export const skip = !chromium ? 'playwright-core is not installed; try npm ci'
                  : !existsSync(executablePath) && `there is no ${executablePath}`;

/** An empty page, for scripts that import three.js and the package. */
export const blank = `<!doctype html><link rel="icon" href="data:,"><script type="importmap">
  {"imports": {"three": "./node_modules/three/build/three.module.js",
               "three/addons/": "./node_modules/three/examples/jsm/",
               "three/webgpu": "./node_modules/three/build/three.webgpu.js",
               "three/tsl": "./node_modules/three/build/three.tsl.js",
               "sweepface/three": "./sweepface_three.js"}}</script>`;

/** Serves web/ and `files` by name; a function instead of a file answers the request itself. */
function serve(files) {
  const server = createServer((request, response) => {
    const name = new URL(request.url, 'http://localhost').pathname.slice(1);
    const path = join(folder, name);
    if (files[name] instanceof Function) return files[name](response);
    if (!(name in files) && !existsSync(path)) return response.writeHead(404).end();
    response.setHeader('content-type', types[extname(name)] ?? 'application/octet-stream');
    response.end(files[name] ?? readFileSync(path));
  });
  return new Promise((ready) => server.listen(0, 'localhost', () => ready(server)));
}

/**
 * Opens a page of web/ or of `files`, texts and bytes by name, in a new browser. Calls `use` with the
 * page and the list of its errors and warnings.
 */
export async function withPage(name, {files, viewport}, use) {
  if (skip) throw new Error(skip);
  const browser = await chromium.launch(launchOptions), server = await serve(files);
  try {
    const page = await browser.newPage({viewport}), complaints = [];
    page.on('console', (message) => {
      const isAdvice = message.text().includes('GL Driver Message (OpenGL, Performance');  // on reading pixels, as tests do
      if (['error', 'warning'].includes(message.type()) && !isAdvice) complaints.push(message.text());
    });
    page.on('pageerror', (error) => complaints.push(error.message));
    await page.goto(`http://localhost:${server.address().port}/${name}`);
    return await use(page, complaints);
  } finally {
    await browser.close();
    server.close();
  }
}
