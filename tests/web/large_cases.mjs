// Cases of test_page.mjs: large gases and the gallery. Long work is done in slices, and the page
// draws pictures between them. measure_tasks.mjs measures how long the slices are.

import assert from 'node:assert/strict';
import {test} from './cases.mjs';
import {browser, open} from './in_chromium.mjs';

// Waits until a status after the last event `command` fulfils a condition. Expects pictures between
// them. Work at one go has one at most.
async function need_pictures(command, condition) {
  const {pictures} = await browser.until(`(() => {
    const events = log.map((line) => JSON.parse(line));
    const begin = events.findLastIndex((e) => e.event === '${command}');
    const end = events.findIndex((e, at) => at > begin && e.event === 'status' && ${condition});
    return begin >= 0 && end >= 0 &&
        {pictures: events.slice(begin, end).filter((e) => e.event === 'picture').length};
  })()`);
  assert.ok(pictures > 1, `${command}: ${pictures} pictures`);
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
  await go(dense + '&seed=2');
  await need_pictures('open', 'e.particles === 100000 && e.time > 0');
});

test('a large gas goes to other times, and looks ahead, in slices', async () => {
  const shift = 8;
  await open('vibrated&particles.count=100000&box.size=[340.0,400.0]&view.speed=5');
  const status = (condition) => browser.until_last('status', condition);
  await status('e.collisions > 1000000');
  await browser.press('Space', ' ');
  const head = await status('e.hash');
  await browser.press('Home', 'Home');
  await need_pictures('jump', 'e.hash && e.time === 0');
  await browser.press('End', 'End');
  await need_pictures('jump', `e.hash === '${head.hash}'`);
  await browser.press('Comma', ';', shift);
  await need_pictures('step_collision_back', `e.hash && e.time < ${head.time}`);
  await browser.idle();
  const [x, y, width, height] = await browser.place_of('viewport');
  for (let k = 0; k < 10 && ((await browser.last('pick'))?.particle ?? null) === null; ++k) {
    await browser.click_at(x + width / 2 + 7 * k, y + height / 2);
    await browser.idle();
  }
  assert.ok((await browser.last('pick')).particle !== null);
});

// Notes at each picture how many scenes of the open gallery have a picture. These have more colours
// than a card without.
const watch_gallery = () => browser.value(`void (() => {
  const draw = Module._clatter_draw, gl = canvas.getContext('webgl2');
  const wide = 60 * devicePixelRatio, pixels = new Uint32Array(wide * canvas.height);
  const has_picture = ([, top]) => {
    const row = canvas.height - Math.round(top + wide);
    return new Set(pixels.subarray(wide * row, wide * (row + 20))).size > 5;
  };
  window.counts = new Set();
  Module._clatter_draw = () => {
    const more = draw();
    const cards = log.filter((line) => /"name":"gallery\\.(?!close)/.test(line))
        .map((line) => JSON.parse(line).place).filter((place) => place[1] < canvas.height - 2 * wide);
    if (cards.length) {
      gl.readPixels(cards[0][0] + wide / 3, 0, wide, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(pixels.buffer));
    }
    counts.add(cards.filter(has_picture).length);
    return more;
  };
})()`);

test('the gallery opens, and its pictures appear one after the other', async () => {
  await open('cradle', '&until=0');
  await watch_gallery();
  await browser.click('gallery');
  await browser.place_of('gallery.vibrated');
  await browser.idle();
  const counts = await browser.value('[...counts]');
  assert.ok(counts.length > 3, `${counts}`);
  await browser.click('gallery.close');
  await browser.until_last('gallery', 'e.open === false');
});
