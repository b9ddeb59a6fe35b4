import assert from 'node:assert/strict';
import {createHash} from 'node:crypto';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {Sweepface} from '../sweepface.js';
import {skip, withPage} from './browser.js';
import {packed, positionsOf, sample} from './native.js';
import {converted, model} from './scene_file.js';

const bytes = readFileSync(sample);
const visit = {files: {'sample.sweep': bytes}, viewport: {width: 1000, height: 700}};

const options = {skip, timeout: 480_000};
test('the page', options, (t) => withPage('index.html', visit, async (page, complaints) => {
  const until = (test, given) => page.waitForFunction(test, given, {timeout: 60_000});

  async function settle() {
    await until(() => globalThis.sweepface?.mesh);
    await page.addStyleTag({content: '#figures { opacity: 0 }'});  // its numbers change by themselves
    await page.waitForTimeout(800);                                // until nothing moves
  }

  const positions = () => page.evaluate(() => [...globalThis.sweepface.mesh.geometry.attributes.position.array]);
  const weight = (name) => page.evaluate((name) => globalThis.sweepface.mesh.face.weights[name], name);
  const open = (name, buffer) => page.locator('#file').setInputFiles({name, mimeType: 'application/octet-stream', buffer});
  const said = () => page.locator('#message').textContent();
  const picture = async () => (await page.locator('#view').screenshot()).toString('base64');

  /** The share of pixels in which two pictures differ. */
  const changed = (a, b) => page.evaluate(async (pictures) => {
    const [first, second] = await Promise.all(pictures.map(async (picture) => {
      const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${picture}`)).blob());
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
      context.drawImage(bitmap, 0, 0);
      return new Uint32Array(context.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer);
    }));
    return first.reduce((count, pixel, k) => count + (pixel !== second[k]), 0) / first.length;
  }, [a, b]);

  /** The position of the camera, the aspect ratio of its view, and whether the whole face is in it. */
  const view = () => page.evaluate(() => {
    const {mesh} = globalThis.sweepface, {array} = mesh.geometry.attributes.position;
    const camera = mesh.parent.children.find((child) => child.isCamera), point = mesh.position.clone();
    let isWhole = true;
    for (let k = 0; k < array.length; k += 3) {
      const {x, y} = point.fromArray(array, k).project(camera);
      isWhole &&= Math.abs(x) < 1 && Math.abs(y) < 1;
    }
    const [across, , , , , up] = camera.projectionMatrix.elements;
    return {eye: camera.position.toArray(), aspect: up / across, isWhole};
  });

  async function slide(name, value) {
    await page.locator(`input[name="${name}"]`).fill(String(value));
    await page.waitForTimeout(800);
  }

  await t.test('shows the sample face, and its picture changes when a slider moves', async () => {
    await settle();
    const neutral = await picture(), [told] = await page.locator('#figures').allInnerTexts();
    const size = (bytes.length / 1e6).toFixed(1), vertices = ((await positions()).length / 3).toLocaleString('en');
    assert.match(told, new RegExp(`^file\\s+${size} MB\\s+vertices\\s+${vertices}\\s+loaded in\\s+[1-9]\\d* ms\\s`));
    await until(() => {
      const memory = globalThis.sweepface.mesh.face.memoryBytes / 1e6;
      return document.getElementById('figures').textContent.endsWith(`memory${memory.toFixed(1)} MB`);
    });
    assert.equal(await page.title(), 'sample.sweep · Sweepface');
    const {names, colours, hasInside} = await page.evaluate(() => {
      const {material: materials, children, geometry} = globalThis.sweepface.mesh;
      return {names: materials.map(({name}) => name), colours: materials.map(({color}) => color.getHex()),
              hasInside: children.some((child) => child.isMesh && child.geometry === geometry)};
    });
    const alike = [...new Set(colours)].map((colour) => names.filter((_, k) => colours[k] === colour).sort());
    assert.deepEqual(alike.filter(({length}) => length > 1), [['gums', 'lips']]);
    assert.ok(hasInside);
    await page.evaluate(() => {
      const {requestAnimationFrame} = globalThis;
      globalThis.frames = 0;
      globalThis.requestAnimationFrame = (callback) => {
        ++globalThis.frames;
        return requestAnimationFrame(callback);
      };
    });
    assert.equal(await changed(neutral, await picture()), 0);
    // While nothing moves, nothing is drawn.
    assert.ok(await page.evaluate(async () => {
      for (let tries = 0; tries < 20; ++tries) {
        const before = globalThis.frames;
        await new Promise((done) => { setTimeout(done, 300); });
        if (globalThis.frames === before) return true;
      }
    }));
    await slide('jawOpen', 1);
    assert.equal(await weight('jawOpen'), 1);
    assert.ok(await changed(neutral, await picture()) > 0.01);
    await slide('jawOpen', 0);
    assert.ok(await changed(neutral, await picture()) < 0.001);
  });

  await t.test('has the positions that Node has', async () => {
    await slide('jawOpen', 0.6);
    await slide('mouthSmileLeft', 1);
    const face = await Sweepface.load(bytes);
    face.setWeights({jawOpen: 0.6, mouthSmileLeft: 1});
    assert.deepEqual(await positions(), [...positionsOf(face)]);
  });

  await t.test('draws lines that follow the face', async () => {
    const shared = () => {
      const {mesh} = globalThis.sweepface, lines = mesh.children.find((child) => child.isLineSegments);
      return lines && [lines.geometry.attributes.position === mesh.geometry.attributes.position,
                       lines.geometry.index.count / mesh.geometry.index.count];
    };
    const check = async (isDrawn) => {
      await page.locator('#lines').setChecked(isDrawn);
      await page.waitForTimeout(800);
      return picture();
    };
    const open = await check(true), [follows, share] = await page.evaluate(shared);
    assert.ok(follows && share > 0.9 && share < 1.1, `${share}`);  // two vertices per edge, three per triangle
    await slide('jawOpen', 0);
    const followed = await picture();
    assert.ok(await changed(open, followed) > 0.005);
    const plain = await check(false);
    assert.equal(await page.evaluate(shared), undefined);
    assert.ok(await changed(plain, followed) > 0.01);
    assert.equal(await changed(followed, await check(true)), 0);  // newly made lines look the same
    await check(false);
    await slide('jawOpen', 0.6);  // the face without the lines still moves
    assert.ok(await changed(plain, await picture()) > 0.005);
  });

  await t.test('turns by arrow keys', async () => {
    const ahead = await picture();
    await page.locator('#view').focus();
    const after = async (key) => {
      for (let k = 0; k < 3; ++k) await page.keyboard.press(key);
      await page.waitForTimeout(800);
      await page.locator('#view').blur();  // which removes the outline
      const turned = await picture();
      await page.locator('#view').focus();
      return changed(ahead, turned);
    };
    assert.ok(await after('ArrowLeft') > 0.05);
    assert.ok(await after('ArrowRight') < 0.01);
    assert.ok(await after('ArrowUp') > 0.05);
    assert.ok(await after('ArrowDown') < 0.01);
  });

  await t.test('turns when it is dragged', async () => {
    const neutral = await picture();
    await page.mouse.move(50, 650);  // where the figures are
    await page.mouse.down();
    await page.mouse.move(170, 670, {steps: 4});
    await page.mouse.up();
    await page.waitForTimeout(1000);
    assert.ok(await changed(neutral, await picture()) > 0.05);
  });

  await t.test('relaxes by a spring, and sliders follow', async () => {
    await page.locator('#rest').click();
    await page.locator('input[name="jawOpen"]').focus();  // a focused slider follows as well
    await until(() => globalThis.sweepface.mesh.face.weights.jawOpen < 0.001);
    assert.ok(await page.locator('input[name="jawOpen"]').inputValue() < 0.05);
  });

  await t.test('surprises', async () => {
    await page.evaluate(() => {
      Math.random = () => 0.9;  // chooses no expression, so that the first is taken
      globalThis.sweepface.mesh.setWeights({mouthSmileRight: 1});
    });
    await page.locator('#surprise').click();
    await until(() => {
      const [first, ...others] = Object.values(globalThis.sweepface.mesh.face.weights);
      return first > 0.9 && others.every((weight) => Math.abs(weight) < 0.1);
    });
  });

  await t.test('shows finer levels with the same weights', async () => {
    await page.locator('#rest').click();
    await slide('jawOpen', 0.5);
    const vertices = (await positions()).length / 3, {eye} = await view();
    await page.evaluate(async () => {
      globalThis.coarse = globalThis.sweepface.mesh.face;
      const {Sweepface: {prototype}} = await import('./sweepface.js'), {prepare} = prototype;
      prototype.prepare = function() {
        globalThis.prepared = this;
        prepare.call(this);
      };
    });
    await page.locator('#lod').selectOption('2');
    await until((vertices) => globalThis.sweepface.mesh.face.vertexCount > 3 * vertices, vertices);
    assert.equal(await weight('jawOpen'), 0.5);
    await until(() => globalThis.prepared === globalThis.sweepface.mesh.face);
    const {eye: now} = await view();
    // The camera may still swing out, but does not return to the front.
    assert.ok(eye.every((x, k) => Math.abs(x - now[k]) < 10), `${eye} and ${now}`);
    await assert.rejects(page.evaluate(() => globalThis.coarse.names), /disposed of/);  // its memory is free
    await page.locator('#lines').check();
    await page.waitForTimeout(300);
    await page.locator('#lines').uncheck();
  });

  await t.test('finds expressions by a part of their name', async () => {
    await page.locator('#filter').fill(' SMILE ');
    const found = await page.locator('.slider:visible span:first-child').allTextContents();
    assert.deepEqual(found, ['mouthSmileLeft', 'mouthSmileRight']);
  });

  await t.test('takes files that are dragged over it, and no text', async () => {
    const dragged = await page.evaluate(() => {
      const files = new DataTransfer(), text = new DataTransfer();
      files.items.add(new File([], 'face.sweep'));
      text.setData('text/plain', 'face');
      return [['dragover', files], ['dragleave', files], ['dragover', text]].map(([type, dataTransfer]) => {
        const isTaken = !dispatchEvent(new DragEvent(type, {dataTransfer, cancelable: true}));
        return [isTaken, getComputedStyle(document.body, '::after').content !== 'none'];
      });
    });
    assert.deepEqual(dragged, [[true, true], [true, false], [false, false]]);
  });

  await t.test('opens of several dropped files the one that is named as a face', async () => {
    await page.locator('input[name="mouthSmileRight"]').focus();
    const dropped = await page.evaluate(async () => {
      const dataTransfer = new DataTransfer(), bytes = await (await fetch('sample.sweep')).arrayBuffer();
      dataTransfer.items.add(new File(['read me'], 'readme.txt'));
      dataTransfer.items.add(new File([bytes], 'DROPPED.SWEEP'));
      dispatchEvent(new DragEvent('dragover', {dataTransfer}));
      const isTaken = !dispatchEvent(new DragEvent('drop', {dataTransfer, cancelable: true}));
      dispatchEvent(new PointerEvent('pointerdown'));  // which does not dismiss the message
      return [isTaken, document.getElementById('message').textContent];
    });
    assert.deepEqual(dropped, [true, 'Loading…']);
    await until(() => document.title.startsWith('DROPPED.SWEEP'));
    assert.equal(await said(), '');
    assert.equal(await page.evaluate(() => document.body.className), '');
    // The view is reset; the panel stays as it was left.
    const {eye: [x, y, z], isWhole} = await view();
    assert.ok(isWhole && Math.abs(x) < z / 2 && Math.abs(y) < z / 2, `${x}, ${y}, ${z}`);
    assert.equal(await page.evaluate(() => document.activeElement.name), 'mouthSmileRight');
    assert.equal(await page.locator('.slider:visible').count(), 2);
    await page.locator('#filter').fill('');
  });

  await t.test('opens a file, and says why another is none', async () => {
    await open('holiday.sweep', Buffer.from('GIF89a'));
    await page.waitForSelector('#message.error');
    assert.equal(await said(), 'holiday.sweep does not begin with SWEEPFC; check that it is a .sweep file.');
    await page.locator('#filter').click();  // using the previous face dismisses the error
    assert.equal(await said(), '');
    await open(`${'B'.repeat(400)}.sweep`, Buffer.from('GIF89a'));
    await page.waitForSelector('#message.error');
    const {x, width} = await page.locator('#message').boundingBox();
    assert.ok(x >= 0 && x + width <= 660);
    // Files that are gone, or too large.
    const moved = 'it may have been moved; choose it again', large = 'it is too large for this browser';
    for (const [size, advice] of [[1000, moved], [2e9, large]]) {
      await page.evaluate((size) => {
        const gone = {name: 'gone.sweep', size, arrayBuffer: () => Promise.reject(new DOMException('It is gone.'))};
        Object.defineProperty(document.getElementById('file'), 'files', {value: [gone], configurable: true});
        document.getElementById('file').dispatchEvent(new Event('change'));
        delete document.getElementById('file').files;
      }, size);
      await until(() => document.getElementById('message').className === 'error');
      assert.equal(await said(), `gone.sweep cannot be read; ${advice}.`);
    }
    await open('again.sweep', bytes);
    await until(() => document.title.startsWith('again.sweep'));
    assert.equal(await said(), '');
    assert.equal(await page.locator('#file').inputValue(), '');  // so that the same one can be chosen again
  });

  await t.test('shows a face with all that it came with, or alone', async () => {
    const shown = (isScene) => until((isScene) => !globalThis.sweepface.mesh.isMesh === isScene, isScene);
    const choices = () => page.evaluate(() => ['choice', 'lod', 'lines'].map((id) => {
      const {hidden, disabled} = document.getElementById(id);
      return hidden || disabled || false;
    }));
    assert.deepEqual(await choices(), [true, false, false]);
    await page.locator('#lines').check();
    await open('model.sweep', readFileSync(converted(model())));
    await shown(true);
    await page.waitForTimeout(800);
    assert.deepEqual(await choices(), [false, true, true]);
    assert.equal(await page.locator('#lod').inputValue(), '0');  // the level of the face before does not count
    assert.equal(await weight('jawOpen'), 0.25);
    assert.equal(await page.locator('#takes').isVisible(), true);
    await page.locator('#take').selectOption('take');
    await until(() => globalThis.sweepface.mesh.face.weights.jawOpen > 0.5);
    await until(() => document.querySelector('input[name="jawOpen"]').value > 0.5);
    await page.locator('#take').selectOption('nothing');
    await until(() => globalThis.sweepface.mesh.face.weights.jawOpen === 0.25);
    const before = await picture();
    await slide('jawOpen', 1);
    assert.ok(await changed(before, await picture()) > 0.01);
    await page.locator('#scene').uncheck();
    await shown(false);
    assert.deepEqual(await choices(), [false, false, false]);
    assert.equal(await page.locator('#takes').isVisible(), false);
    assert.equal(await weight('jawOpen'), 1);
    await page.locator('#lines').uncheck();
    await page.locator('#scene').check();
    await shown(true);
    const {json, binary} = model();
    json.extensionsUsed = json.extensionsRequired = ['KHR_texture_basisu'];  // for which the page has no decoder
    json.textures[0] = {extensions: {KHR_texture_basisu: {source: 0}}};
    await open('basis.sweep', readFileSync(converted({json, binary})));
    await shown(false);
    assert.match(await said(), /^basis\.sweep: its scene cannot be shown: .*setKTX2Loader/);
    await page.locator('#scene').click();  // which does not last
    await until(() => !document.getElementById('scene').checked);
    await open('again.sweep', bytes);
    await until(() => document.title.startsWith('again.sweep'));
    assert.deepEqual(await choices(), [true, false, false]);
    await page.locator('#scene').evaluate((choice) => { choice.checked = true; });
    await page.locator('#lod').selectOption('2');
    await until(() => globalThis.sweepface.mesh.face.lod === 2);
  });

  await t.test('names its sliders, and what else there is to use', async () => {
    assert.ok(await page.evaluate(() => [...document.querySelectorAll('.slider')].every((row) => {
      const [input] = row.getElementsByTagName('input');
      return row.control === input && row.querySelector('span:not([aria-hidden])').textContent === input.name;
    })));
    for (const [role, name] of [['img', /^The face: drag it or press arrow keys/], ['button', 'Surprise me'],
                                ['button', 'Relax'], ['combobox', 'Detail'], ['checkbox', 'Lines'],
                                ['searchbox', 'Filter expressions']])
      assert.equal(await page.getByRole(role, {name}).count(), 1, role);
    await page.getByLabel('Open', {exact: true}).focus();  // as keyboard users do
    assert.equal(await page.evaluate(() => document.activeElement.id), 'file');
    await page.locator('#message[role="status"]:not(.error)').waitFor({state: 'attached'});
    assert.equal(await page.locator('#message').evaluate((message) => getComputedStyle(message).display), 'block');
  });

  await t.test('keeps the face where another cannot be shown', async () => {
    const broken = Buffer.from(bytes);
    broken.fill(0, bytes.length / 2);
    await open('broken.sweep', broken);
    await page.waitForSelector('#message.error');
    // The level requested for a file that fails to load does not count for the one on show.
    assert.deepEqual(await page.evaluate(async () => {
      let fail;
      const lod = document.getElementById('lod'), coming = new Promise((_, reject) => { fail = reject; });
      const asked = globalThis.sweepface.show(coming, 'gone.sweep');
      lod.value = '4';
      lod.dispatchEvent(new Event('change'));
      fail(new Error('It is gone.'));
      await asked;
      await new Promise((done) => { setTimeout(done, 50); });
      return [document.getElementById('message').textContent, lod.value];
    }), ['It is gone.', '2']);
    await slide('jawOpen', 0.3);
    assert.equal(await weight('jawOpen'), 0.3);
    assert.ok((await page.title()).startsWith('again.sweep'));
  });

  await t.test('shows the file that was asked for last', async () => {
    await page.route('**/sample.sweep', async (route) => {
      await page.waitForTimeout(2000);
      await route.continue();
    });
    const begun = page.waitForRequest('**/sample.sweep'), late = page.waitForResponse('**/sample.sweep');
    await page.reload({waitUntil: 'commit'});
    await begun;
    await open('mine.sweep', bytes);
    await until(() => document.title.startsWith('mine.sweep'));
    await late;
    await page.waitForTimeout(800);
    assert.ok((await page.title()).startsWith('mine.sweep'));
    assert.equal(await said(), '');
    await page.unroute('**/sample.sweep');
  });

  await t.test('shows the file that was asked for last in a level that is chosen before it is there', async () => {
    await page.reload();
    await settle();
    await page.evaluate(() => {
      const late = new File([], 'late.sweep'), {arrayBuffer} = Blob.prototype;
      globalThis.come = new Promise((resolve) => globalThis.arrive = resolve);
      late.arrayBuffer = async () => {
        await globalThis.come;
        return arrayBuffer.call(globalThis.mine);
      };
      Object.defineProperty(document.getElementById('file'), 'files', {value: [late], configurable: true});
    });
    const meanwhile = await page.evaluate(async () => {
      globalThis.mine = await (await fetch('sample.sweep')).blob();
      globalThis.sweepface.show(Promise.reject(new Error('Nobody asks for it any more.')), 'early.sweep');
      document.getElementById('file').dispatchEvent(new Event('change'));
      return new Promise((done) => { setTimeout(() => done(document.getElementById('message').textContent), 50); });
    });
    assert.equal(meanwhile, 'Loading…');
    await page.locator('#lod').selectOption('2');
    await page.evaluate(() => globalThis.arrive());
    await until(() => globalThis.sweepface.mesh.face.lod === 2);
    await page.waitForTimeout(800);
    assert.ok((await page.title()).startsWith('late.sweep'));
    assert.equal(await said(), '');
    await page.reload();
    await settle();
  });

  await t.test('shows a sound file although a broken one was opened after it', async () => {
    await page.route('**/sample.sweep', async (route) => {
      await page.waitForTimeout(1000);
      await route.continue();
    });
    const begun = page.waitForRequest('**/sample.sweep');
    await page.reload({waitUntil: 'commit'});
    await begun;
    await open('bad.sweep', Buffer.from('GIF89a'));
    await page.waitForSelector('#message.error');
    await until(() => document.title.startsWith('sample.sweep'));
    assert.match(await said(), /^bad\.sweep /);  // the error outlasts the loading
    await page.keyboard.press('Shift');
    assert.match(await said(), /^bad\.sweep /);
    await page.keyboard.press('Escape');
    assert.equal(await said(), '');
    await page.unroute('**/sample.sweep');
    // Levels are those of the sample face again.
    await page.locator('#lod').selectOption('2');
    await until(() => globalThis.sweepface.mesh.face.lod === 2);
    assert.ok((await page.title()).startsWith('sample.sweep'));
    await page.locator('#lod').selectOption('0');
    await until(() => globalThis.sweepface.mesh.face.lod === 0);
  });

  await t.test('goes on moving in another level of detail', async () => {
    await page.reload();
    await settle();
    await page.evaluate(() => { Math.random = () => 0; });  // every expression
    await page.locator('#surprise').click();
    await page.locator('#lod').selectOption('2');
    await until(() => globalThis.sweepface.mesh.face.lod === 2);
    await until(() => Object.values(globalThis.sweepface.mesh.face.weights).every((weight) => weight > 0.49));
    await page.locator('#lod').selectOption('0');
    await page.locator('#rest').click();
    await until(() => globalThis.sweepface.mesh.face.lod === 0);
    await until(() => Object.values(globalThis.sweepface.mesh.face.weights).every((weight) => weight < 0.001));
  });

  await t.test('keeps the weights where one level is chosen soon after another', async () => {
    await slide('jawOpen', 0.7);
    for (const level of ['2', '4']) await page.locator('#lod').selectOption(level);
    await until(() => globalThis.sweepface.mesh.face.lod === 4);
    await page.waitForTimeout(800);
    assert.ok(Math.abs(await weight('jawOpen') - 0.7) < 1e-6);
    await page.locator('#lod').selectOption('0');
    await until(() => globalThis.sweepface.mesh.face.lod === 0);
    await slide('jawOpen', 0);
  });

  await t.test('moves at once for who would rather see nothing move', async () => {
    await page.emulateMedia({reducedMotion: 'reduce'});
    assert.ok(await page.evaluate(async () => {
      Math.random = () => 0;
      document.getElementById('surprise').click();
      for (let frames = 0; frames < 3; ++frames) await new Promise(requestAnimationFrame);
      return Object.values(globalThis.sweepface.mesh.face.weights).every((weight) => weight === 0.5);
    }));
    await page.emulateMedia({reducedMotion: null});
    await page.locator('#rest').click();
  });

  await t.test('comes nearer by a key, and neither into the face nor out of sight', async () => {
    /** Presses a key; returns the camera's distance, and whether the key is kept from the browser. */
    const press = (init, times = 1) => page.evaluate(([init, times]) => {
      const canvas = document.getElementById('view');
      let isTaken;
      for (let k = 0; k < times; ++k)
        isTaken = !canvas.dispatchEvent(new KeyboardEvent('keydown', {...init, cancelable: true}));
      const {children} = globalThis.sweepface.mesh.parent, {position} = children.find((child) => child.isCamera);
      return [Math.hypot(position.x, position.y, position.z), isTaken];
    }, [init, times]);
    const [before] = await press({key: 'a'}), [after, isTaken] = await press({key: '+'});
    assert.ok(after < before && isTaken);
    for (const which of ['ctrlKey', 'metaKey', 'altKey'])
      assert.deepEqual(await press({key: '+', [which]: true}), [after, false]);
    const [nearest] = await press({key: '+'}, 50), [farthest] = await press({key: '-'}, 50);
    assert.ok(nearest > before / 10 && farthest < 5 * before, `${nearest}, ${before}, ${farthest}`);
    await press({key: '+'}, 10);
  });

  await t.test('says what goes wrong while the face moves, and goes on', async () => {
    await page.evaluate(() => {
      globalThis.sweepface.mesh.update = () => {
        delete globalThis.sweepface.mesh.update;
        throw new Error('There is no memory left.');
      };
      document.getElementById('view').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft'}));
    });
    await page.waitForSelector('#message.error');
    assert.equal(await said(), 'There is no memory left.');
    const version = await page.evaluate(() => {
      const {mesh} = globalThis.sweepface;
      mesh.setWeights({jawOpen: 0.4});
      document.getElementById('view').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight'}));
      return mesh.geometry.attributes.position.version;
    });
    await until((version) => globalThis.sweepface.mesh.geometry.attributes.position.version > version, version);
    await page.keyboard.press('Escape');
  });

  await t.test('moves nothing when a finger scrolls the expressions', async () => {
    await slide('jawOpen', 0.2);
    await page.locator('input[name="jawOpen"]').evaluate((input) => {
      input.dispatchEvent(new PointerEvent('pointerdown', {bubbles: true}));
      input.value = 0.9;  // where the finger came down
      input.dispatchEvent(new Event('input', {bubbles: true}));
      input.dispatchEvent(new PointerEvent('pointercancel', {bubbles: true}));
    });
    assert.equal(await weight('jawOpen'), 0.2);
    assert.equal(await page.locator('input[name="jawOpen"]').inputValue(), '0.2');
    // Nor does it undo what was set by other means.
    await page.evaluate(() => globalThis.sweepface.mesh.setWeights({jawOpen: 0.3}));
    await page.locator('input[name="jawOpen"]').evaluate((input) => {
      for (const what of ['pointerdown', 'pointercancel']) input.dispatchEvent(new PointerEvent(what, {bubbles: true}));
    });
    assert.ok(Math.abs(await weight('jawOpen') - 0.3) < 1e-6);
  });

  await t.test('plays a packed file by the module that is there where there is no network', async () => {
    const told = complaints.length;
    await page.route('**/sweepface.wasm', (route) => route.abort());
    await page.locator('#file').setInputFiles(packed());
    await until(() => document.title.startsWith('packed'));
    await page.locator('#lod').selectOption('2');  // in which it keeps its own pose, not the goals of the last face
    await until(() => globalThis.sweepface.mesh.face.lod === 2);
    assert.equal(await said(), '');
    await page.unroute('**/sweepface.wasm');
    complaints.splice(told);  // about the missing network
  });

  await t.test('says where no expression has a name', async () => {
    await page.locator('#filter').fill('trunk');
    assert.ok(await page.locator('#unfound').isVisible());
    await page.locator('#filter').fill('');
    assert.ok(!await page.locator('#unfound').isVisible());
  });

  await t.test('draws again when the graphics card comes back', async () => {
    await page.reload();
    await settle();
    const before = await picture(), told = complaints.length;
    const said = await page.evaluate(async () => {
      const card = document.getElementById('view').getContext('webgl2').getExtension('WEBGL_lose_context');
      card.loseContext();
      await new Promise((done) => setTimeout(done, 500));
      dispatchEvent(new PointerEvent('pointerdown'));  // which does not dismiss the error
      const said = [document.getElementById('message').textContent], {show} = globalThis.sweepface;
      await show(fetch('sample.sweep').then((response) => response.arrayBuffer()), 'sample.sweep', true);
      said.push(document.getElementById('message').textContent);
      card.restoreContext();
      await new Promise((done) => setTimeout(done, 1000));
      return [...said, document.getElementById('message').textContent];
    });
    const lost = 'The graphics card is not available to this page; if it does not come back, reload the page.';
    assert.deepEqual(said, [lost, lost, '']);
    const after = await changed(before, await picture());
    assert.ok(after < 0.01, `${after} of the pixels differ`);
    complaints.splice(told);  // about the lost context
  });

  await t.test('shows a face that came while there was no room for it', async () => {
    await page.addInitScript(() => {
      if (sessionStorage.getItem('room') !== 'none') return;
      addEventListener('DOMContentLoaded', () => { document.getElementById('stage').style.maxWidth = '0'; });
    });
    await page.evaluate(() => sessionStorage.setItem('room', 'none'));
    await page.reload();
    await settle();
    await page.evaluate(() => {
      sessionStorage.clear();
      document.getElementById('stage').style.maxWidth = '';
    });
    await page.waitForTimeout(800);
    const shown = await picture();
    await page.evaluate(() => { globalThis.sweepface.mesh.visible = false; });
    await page.locator('#lines').check();  // draws again
    await page.waitForTimeout(800);
    assert.ok(await changed(shown, await picture()) > 0.1);
    await page.locator('#lines').uncheck();
  });

  await t.test('fits a phone on its side', async () => {
    await page.setViewportSize({width: 667, height: 375});
    const heightOf = (id) => document.getElementById(id).clientHeight;
    const heights = [await page.evaluate(heightOf, 'view'), await page.evaluate(heightOf, 'sliders')];
    assert.equal(heights[0], 375);
    assert.ok(await page.evaluate(() => document.documentElement.scrollHeight <= 375), 'the sliders are what scrolls');
    assert.ok(heights[1] > 120, `sliders have ${heights[1]} pixels`);
  });

  await t.test('is as sharp as the screen, and not stretched', async () => {
    const session = await page.context().newCDPSession(page);
    const sizes = [[660, 1.5, 1.5], [650, 3, 2], [640, 1, 1]];  // the pixel ratio is capped at 2
    for (const [width, deviceScaleFactor, points] of sizes) {
      await session.send('Emulation.setDeviceMetricsOverride', {width, height: 375, deviceScaleFactor, mobile: false});
      await until((points) => {
        const {width, clientWidth} = document.getElementById('view');
        return width === Math.floor(points * clientWidth);
      }, points);
    }
    const {width, height} = await page.locator('#view').boundingBox();
    assert.ok(Math.abs((await view()).aspect - width / height) < 0.01);
    await session.detach();
  });

  await t.test('fits a phone', async () => {
    await page.setViewportSize({width: 390, height: 844});
    await page.reload();
    await settle();
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= 390);
    assert.ok((await view()).isWhole);
    await page.setViewportSize({width: 320, height: 1400});  // as when the page shares the screen
    await page.waitForTimeout(800);
    const narrow = await view(), {width, height} = await page.locator('#view').boundingBox();
    assert.ok(narrow.isWhole);
    assert.ok(Math.abs(narrow.aspect - width / height) < 1e-3 && width === 320);
    await page.setViewportSize({width: 390, height: 844});
    await page.waitForTimeout(800);
    for (const id of ['#view', '#surprise', 'input[name="jawOpen"]']) assert.ok(await page.locator(id).isVisible());
    const neutral = await picture();
    await slide('mouthPucker', 1);
    assert.ok(await changed(neutral, await picture()) > 0.001);
  });

  await t.test('can be used where a screen is small or much enlarged', async () => {
    await page.setViewportSize({width: 320, height: 256});
    await page.locator('input[name="mouthPucker"]').evaluate((input) => input.scrollIntoView({block: 'center'}));
    const {y, height} = await page.locator('input[name="mouthPucker"]').boundingBox();
    const below = await page.locator('#stage').evaluate((stage) => stage.getBoundingClientRect().bottom);
    assert.ok(below > 100 && below < 130, 'the face stays where it is seen');
    assert.ok(height > 16 && y > below && y + height <= 256, `${y}, ${height}`);
  });

  await t.test('has complained about nothing', () => {
    assert.deepEqual(complaints, []);
  });
}));

/** The page's error message. */
function told(name, visit) {
  return withPage(name, visit, async (page) => {
    await page.waitForFunction(() => document.getElementById('message').textContent !== 'Loading…');
    return page.locator('#message.error').textContent();
  });
}

test('the page says which file is missing, and without any asks for one', options, () => {
  return withPage('index.html?face=typo.sweep', {...visit, files: {}}, async (page, complaints) => {
    const message = page.locator('#message'), done = () => page.waitForFunction(() => globalThis.sweepface);
    const missing = 'typo.sweep cannot be had: the server answers 404.';
    await done();
    assert.equal(await message.textContent(), missing);
    // Controls for faces do nothing without one, and do not dismiss the error.
    for (const id of ['surprise', 'rest', 'lines', 'lines']) await page.locator(`#${id}`).click();
    await page.locator('#filter').fill('jaw');
    await page.keyboard.press('a');
    assert.equal(await message.textContent(), missing);
    assert.equal(await message.getAttribute('class'), 'error');
    assert.ok(!await page.locator('#unfound').isVisible());
    await page.goto(page.url().replace(/\?.*/, ''));
    await done();
    assert.equal(await message.textContent(), 'Drop a .sweep, .glb or .vrm file here, or open one.');
    assert.equal(await message.getAttribute('class'), '');
    await page.locator('#lod').selectOption('2');
    // The message is about the file that was requested last.
    await page.evaluate(async () => {
      const {show} = globalThis.sweepface;
      const late = show(new Promise((done) => { setTimeout(done, 500); }), 'sample.sweep');
      await show(new ArrayBuffer(6), 'bad.sweep');
      await late;
    });
    assert.match(await message.textContent(), /^bad\.sweep /);
    assert.deepEqual(complaints.filter((complaint) => !complaint.includes('404')), []);
  });
});

test('the page says what it needs to convert a model', options, () => {
  const files = {'tool/sweepface_tool.wasm': (response) => response.writeHead(404).end()};
  return withPage('index.html', {...visit, files}, async (page) => {
    await page.waitForFunction(() => globalThis.sweepface);
    await page.locator('#file').setInputFiles({name: 'head.VRM', mimeType: 'model/gltf-binary', buffer: Buffer.from('glTF')});
    await page.waitForFunction(() => document.getElementById('message').className === 'error');
    assert.equal(await page.locator('#message').textContent(),
                 'head.VRM is a model; to convert it the page needs tool/sweepface_tool.wasm, which make web-tool makes.');
    assert.ok(!await page.locator('#save').isVisible());
  });
});

test('the page says when a download breaks off', options, async () => {
  const breakOff = (response) => {
    response.writeHead(200, {'content-length': bytes.length});
    response.write(bytes.subarray(0, bytes.length / 2), () => response.destroy());
  };
  assert.equal(await told('index.html?face=half.sweep', {files: {'half.sweep': breakOff}}),
               'half.sweep cannot be had: the server breaks off.');
});

test('the page says when three.js is missing', options, async () => {
  const html = readFileSync(new URL('../index.html', import.meta.url), 'utf8').replace('three.module.js', 'nothing.js');
  const hashes = [...html.matchAll(/<script(?: type="importmap")?>(.+?)<\/script>/gs)]
    .map(([, text]) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`);
  assert.equal(hashes.length, 2);
  const guarded = html.replace('<meta', `<meta http-equiv="Content-Security-Policy" content="default-src 'self'; ` +
    `img-src data:; script-src 'self' 'wasm-unsafe-eval' ${hashes.join(' ')}"><meta`);
  for (const page of [html, guarded])
    assert.match(await told('other.html', {files: {'other.html': page}}), /npm ci/);
});

test('the page says when there is no WebGL', options, async () => {
  const html = readFileSync(new URL('../index.html', import.meta.url), 'utf8').replace('<script>',
    '<script>HTMLCanvasElement.prototype.getContext = () => null;</script><script>');
  assert.match(await told('other.html', {files: {'other.html': html}}), /WebGL 2/);
});

test('the page says what its Content-Security-Policy lacks', options, async () => {
  const html = readFileSync(new URL('../index.html', import.meta.url), 'utf8').replace('<meta',
    `<meta http-equiv="Content-Security-Policy" content="script-src 'self' 'unsafe-inline'"><meta`);
  assert.match(await told('other.html', {files: {...visit.files, 'other.html': html}}),
               /forbids it; add 'wasm-unsafe-eval' to its script-src\.$/);
});
