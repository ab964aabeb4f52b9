// Cases of test_page.mjs: large gases and the gallery. Long work is done in slices, and the page
// draws pictures between them. measure_tasks.mjs measures how long the slices are.

import assert from 'node:assert/strict';
import {test} from './cases.mjs';
import {browser, open, press} from './in_chromium.mjs';

// Runs a function, and expects pictures meanwhile.
async function need_pictures(run) {
  const drawn = async () => (await browser.events('picture')).length;
  const before = await drawn();
  await run();
  const pictures = await drawn() - before;
  assert.ok(pictures > 5, `${pictures} pictures`);
}

test('a large scene opens in slices, and can be cancelled', async () => {
  await open('cradle');
  const dense = 'vibrated&particles.count=100000&box.size=[340.0,400.0]';
  const go = (fragment) => browser.value(`void (location.hash = '${fragment}')`);
  await go(dense);
  await browser.click('opening.cancel');
  await browser.until_last('cancel', 'true');
  const {time} = await browser.last('status');
  await browser.until_last('status', `e.time > ${time} && e.run === 1`);
  await need_pictures(async () => {
    await go(dense + '&seed=2');
    await browser.until_last('status', 'e.particles === 100000 && e.time > 0');
  });
});

test('a large gas goes to other times, and looks ahead, in slices', async () => {
  const shift = 8;
  await open('vibrated&particles.count=100000&box.size=[340.0,400.0]&view.speed=5');
  const status = (condition) => browser.until_last('status', condition);
  await status('e.collisions > 1000000');
  await press('Space', ' ');
  const head = await status('e.hash');
  await need_pictures(async () => {
    await press('Home', 'Home');
    await status('e.hash && e.time === 0');
  });
  await need_pictures(async () => {
    await press('End', 'End');
    await status(`e.hash === '${head.hash}'`);
  });
  await need_pictures(async () => {
    await press('Comma', ';', shift);
    await status(`e.hash && e.time < ${head.time}`);
  });
  await browser.idle();
  const [x, y, width, height] = await browser.place_of('viewport');
  for (let k = 0; k < 10 && ((await browser.last('pick'))?.particle ?? null) === null; ++k) {
    await browser.click_at(x + width / 2 + 7 * k, y + height / 2);
    await browser.idle();
  }
  assert.ok((await browser.last('pick')).particle !== null);
});

test('the gallery opens, and its pictures appear one after the other', async () => {
  await open('cradle', '&until=0');
  await need_pictures(async () => {
    await browser.click('gallery');
    await browser.place_of('gallery.vibrated');
    await browser.idle();
  });
  // Pictures of scenes have more colours than the list without them.
  const [x, y, , height] = await browser.place_of('gallery.vibrated');
  const colours = await browser.value(`(() => {
    Module._clatter_draw();
    const gl = canvas.getContext('webgl2');
    const pixels = new Uint8Array(4 * 90 * 60);
    gl.readPixels(${Math.round(x)} + 5, canvas.height - ${Math.round(y + height)} + 5, 90, 60, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return new Set(new Uint32Array(pixels.buffer)).size;
  })()`);
  assert.ok(colours > 100, `${colours} colours`);
  await browser.click('gallery.close');
  await browser.until_last('gallery', 'e.open === false');
});
