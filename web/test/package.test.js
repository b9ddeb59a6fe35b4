import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync, mkdirSync, readdirSync, readFileSync, symlinkSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';
import test from 'node:test';
import {brotliCompressSync, constants} from 'node:zlib';
import {newFolder, sample} from './native.js';

const folder = fileURLToPath(new URL('..', import.meta.url));
const run = (command, parameters, cwd = folder) =>
  execFileSync(command, parameters, {cwd, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe']});

test('the module is small', () => {
  const code = readFileSync(join(folder, 'sweepface.wasm'));
  const packed = brotliCompressSync(code, {params: {[constants.BROTLI_PARAM_QUALITY]: 11}});
  console.log(`sweepface.wasm: ${code.length} bytes, ${packed.length} with brotli`);
  assert.ok(code.length <= 168_000);
  assert.ok(packed.length <= 66_500);
});

test('bundlers have no scripts to split, which those for workers may not', () => {
  for (const name of readdirSync(folder).filter((name) => /^sweepface.*\.js$/.test(name)))
    assert.doesNotMatch(readFileSync(join(folder, name), 'utf8'), /import\('/, name);
});

test('what knows no exports finds the package, too', () => {
  const {main, types, typesVersions, exports} = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  assert.equal(main, exports['.'].default);
  assert.equal(types, exports['.'].types);
  const others = Object.entries(exports).filter(([name, it]) => name !== '.' && it.types);
  assert.deepEqual(typesVersions['*'], Object.fromEntries(others.map(([name, it]) => [name.slice(2), [it.types]])));
});

test('what was bundled as no module asks where the module is', async () => {
  const bundled = newFolder();
  for (const name of readdirSync(folder).filter((name) => /^sweepface.*\.js$/.test(name))) {
    const text = readFileSync(join(folder, name), 'utf8').replaceAll('import.meta.url', '({}).url');  // as bundlers do
    writeFileSync(join(bundled, name.replace(/js$/, 'mjs')), text.replace(/(from '\.\/\w+\.)js'/g, '$1mjs\''));
  }
  const {Sweepface} = await import(join(bundled, 'sweepface.mjs'));
  const bytes = readFileSync(sample), wasm = readFileSync(join(folder, 'sweepface_full.wasm'));
  await assert.rejects(Sweepface.load(bytes), {message: /does not know where sweepface\.wasm is; tell it by the option wasm/});
  assert.equal((await Sweepface.load(bytes, {wasm})).names.length, 42);
});

test('the module asks for nothing', () => {
  const module = new WebAssembly.Module(readFileSync(join(folder, 'sweepface.wasm')));
  assert.deepEqual(WebAssembly.Module.imports(module), []);
});

test('the package holds what is needed, and an application can use it', () => {
  const scratch = newFolder();
  const [packed] = JSON.parse(run('npm', ['pack', '--json', '--pack-destination', scratch]));
  assert.deepEqual(packed.files.map(({path}) => path).sort(),
                   ['LICENSE', 'README.md', 'package.json', 'sweepface.d.ts', 'sweepface.js', 'sweepface.wasm',
                    'sweepface_affine.js', 'sweepface_animation.js', 'sweepface_babylon.d.ts', 'sweepface_babylon.js',
                    'sweepface_babylon_bounds.js', 'sweepface_babylon_face.js', 'sweepface_babylon_frames.js',
                    'sweepface_babylon_scene.d.ts', 'sweepface_babylon_scene.js', 'sweepface_babylon_source.js',
                    'sweepface_captures.js', 'sweepface_card.d.ts', 'sweepface_card.js', 'sweepface_chunks.js',
                    'sweepface_clip.js', 'sweepface_clips.d.ts', 'sweepface_clips.js', 'sweepface_drives.js',
                    'sweepface_file.js', 'sweepface_followers.js', 'sweepface_full.wasm',
                    'sweepface_geometry.js', 'sweepface_glb.js', 'sweepface_gpu.d.ts', 'sweepface_gpu.js',
                    'sweepface_mesh.d.ts', 'sweepface_mesh.js', 'sweepface_moved.js', 'sweepface_names.js',
                    'sweepface_pin.js', 'sweepface_regions.js', 'sweepface_scene.d.ts', 'sweepface_scene.js',
                    'sweepface_scene_card.js', 'sweepface_scene_face.js', 'sweepface_scene_left.js',
                    'sweepface_scene_parts.js', 'sweepface_scene_processor.js', 'sweepface_scene_read.js', 'sweepface_text.js',
                    'sweepface_textures.js', 'sweepface_thread.js', 'sweepface_three.d.ts',
                    'sweepface_three.js', 'sweepface_timeline.js', 'sweepface_twin.js', 'sweepface_values.js',
                    'sweepface_wasm.js', 'sweepface_webgpu.d.ts', 'sweepface_webgpu.js',
                    'sweepface_worker.d.ts', 'sweepface_worker.js']);
  mkdirSync(join(scratch, 'node_modules'));
  run('tar', ['xf', join(scratch, packed.filename)], scratch);
  symlinkSync(join(scratch, 'package'), join(scratch, 'node_modules', 'sweepface'));
  writeFileSync(join(scratch, 'app.mjs'), `
    import {readFile} from 'node:fs/promises';
    import {createRequire} from 'node:module';
    import {Sweepface} from 'sweepface';
    const face = await Sweepface.load(await readFile(process.argv[2]));
    console.log(face.names.length, createRequire(import.meta.url)('sweepface/package.json').name);`);
  assert.equal(run(process.execPath, ['app.mjs', sample], scratch).trim(), '42 sweepface');
});

const tsc = join(folder, 'node_modules/.bin/tsc');
test('the types say what there is', {skip: existsSync(tsc) ? false : 'typescript is not installed; try npm ci'}, () => {
  run(tsc, ['--noEmit', '--strict', '--exactOptionalPropertyTypes', '--target', 'esnext', '--module', 'nodenext',
            '--lib', 'esnext,dom', '--skipLibCheck', 'test/types.ts']);
});

test('Node projects need no types of browsers', {skip: existsSync(tsc) ? false : 'typescript is not installed; try npm ci'}, () => {
  run(tsc, ['--noEmit', '--strict', '--target', 'esnext', '--module', 'nodenext', '--lib', 'esnext', '--types', '',
            'sweepface.d.ts', 'sweepface_clips.d.ts', 'sweepface_worker.d.ts']);
});

test('what the types declare is there', async () => {
  const {Sweepface} = await import('../sweepface.js');
  const text = readFileSync(join(folder, 'sweepface.d.ts'), 'utf8');
  const body = text.slice(text.indexOf('export class Sweepface'));
  const declared = [...body.matchAll(/^  (?:static |readonly )?(\w+)[(:]/gm)].map(([, name]) => name)
                       .filter((name) => name !== 'constructor');
  const there = [...Object.getOwnPropertyNames(Sweepface.prototype), ...Object.getOwnPropertyNames(Sweepface)]
                    .filter((name) => !['constructor', 'length', 'name', 'prototype'].includes(name));
  assert.deepEqual([...new Set(declared)].sort(), there.sort());
});
