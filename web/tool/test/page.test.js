// The page converts models that are dropped on it.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';
import test from 'node:test';
import {skip, withPage} from '../../test/browser.js';
import {newFolder, tool as native} from '../../test/native.js';

const models = process.env.SWEEPFACE_MODELS ?? fileURLToPath(new URL('../../../build/release/sample', import.meta.url));
const glb = fs.readFileSync(join(models, 'sample.glb'));
const noSample = {'sample.sweep': (response) => response.writeHead(404).end()};
const visit = {files: noSample, viewport: {width: 1000, height: 700}};

test('a model becomes a face that can be played and saved', {skip, timeout: 300_000}, () =>
  withPage('index.html', visit, async (page, complaints) => {
    await page.waitForFunction(() => globalThis.sweepface);
    const open = (name, buffer) => page.locator('#file').setInputFiles({name, mimeType: 'model/gltf-binary', buffer});
    const says = (start, patience = 60_000) => page.waitForFunction(
      (start) => document.getElementById('message').textContent.startsWith(start), start, {timeout: patience});

    await open('broken.glb', Buffer.from('glTF, but not really'));
    await says('broken.glb: ');
    await open('sample.glb', glb);
    await says('Converting sample.glb… ');
    await open('other.glb', glb);  // ends the first
    await page.waitForFunction(() => globalThis.sweepface.mesh, undefined, {timeout: 200_000});
    assert.match(await page.title(), /^other\.glb/);
    assert.equal(await page.locator('#message').textContent(), '');
    assert.equal(await page.locator('#sliders input').count(), 42);

    const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#save').click()]);
    assert.equal(download.suggestedFilename(), 'other.sweep');
    const path = join(newFolder(), 'other.sweep');
    await download.saveAs(path);
    assert.match(execFileSync(native, ['info', path], {encoding: 'utf8'}), /targets\s+42/);
    assert.ok(fs.statSync(path).size < 0.1 * glb.length);
    if (process.env.SWEEPFACE_SHOT) await page.screenshot({path: process.env.SWEEPFACE_SHOT});

    await open('saved.sweep', fs.readFileSync(path));
    await page.waitForFunction(() => document.title.startsWith('saved.sweep'));
    assert.ok(!await page.locator('#save').isVisible(), 'it is saved already');
    assert.deepEqual(complaints.filter((complaint) => !complaint.includes('404')), [], 'but that there is no sample.sweep');
  }));

test('a model goes on being converted while a file that was asked for before appears', {skip, timeout: 300_000}, () => {
  const folder = newFolder(), small = join(folder, 'small.sweep');
  execFileSync(native, ['convert', join(models, 'sample.glb'), '-o', small, '--tolerance', '1', '-q']);
  let answer;
  const files = {'sample.sweep': (response) => answer = () => response.end(fs.readFileSync(small))};
  return withPage('index.html', {...visit, files}, async (page, complaints) => {
    await page.waitForSelector('#file', {state: 'attached'});
    await page.waitForFunction(() => document.getElementById('message').textContent.startsWith('Loading'));
    await page.waitForTimeout(1000);  // until the page listens
    await page.locator('#file').setInputFiles({name: 'late.glb', mimeType: 'model/gltf-binary', buffer: glb});
    await page.waitForFunction(() => document.getElementById('message').textContent.startsWith('Converting'));
    answer();
    for (const name of ['sample.sweep', 'late.glb'])
      await page.waitForFunction((name) => document.title.startsWith(name), name, {timeout: 200_000});
    assert.deepEqual(complaints, []);
  });
});
