// Cases of test_page.mjs: fingers on a small screen.

import assert from 'node:assert/strict';
import {test} from './cases.mjs';
import {browser, open, take_complaints, usual_size} from './in_chromium.mjs';

// A page on a small telephone with two pixels of the device per pixel.
async function as_telephone(run) {
  await browser.resize(360, 740, 2, true);
  await browser.send('Emulation.setTouchEmulationEnabled', {enabled: true, maxTouchPoints: 5});
  try {
    await run();
  } finally {
    await browser.send('Emulation.setTouchEmulationEnabled', {enabled: false});
    await usual_size();
  }
}

// Moves fingers along straight lines, each [from, to].
async function swipe(...lines) {
  const steps = 10;
  const at = (share) => lines.map(([from, to]) => from.map((x, k) => x + share * (to[k] - x)));
  await browser.touch('touchStart', ...at(0));
  for (let step = 1; step <= steps; ++step) {
    await browser.touch('touchMove', ...at(step / steps));
    await browser.pictures(1);
  }
  await browser.settle();
  await browser.touch('touchEnd');
  await browser.settle();
}

const focused = () => browser.value('document.activeElement.id');

test('a telephone has one sheet at a time, with areas for fingers', () => as_telephone(async () => {
  await open('vibrated', '&until=1');
  await browser.halted_where('e.time === 1');
  await browser.idle();
  const viewport = () => browser.place_of('viewport');
  const whole = await viewport();
  assert.ok(whole[2] === 360 && whole[3] > 600, `viewport ${whole}`);
  for (const name of ['run', 'gas', 'view', 'record', 'plots', 'lesson']) {
    const [x, y, width, height] = await browser.place_of(`sheet.${name}`);
    assert.ok(x >= 0 && x + width <= 360 && y + height <= 740 && width >= 40 && height >= 40,
              `${name}: ${width} x ${height} at ${x}, ${y}`);
  }
  await browser.tap('sheet.gas');
  const half = await viewport();
  assert.ok(half[3] < 0.6 * whole[3]);
  await browser.tap('sheet.plots');
  assert.deepEqual(await viewport(), half);
  await browser.tap('sheet.close');
  assert.deepEqual(await viewport(), whole);
  await browser.tap('sheet.gas');
  const [x, y] = await browser.middle_of('sheet.close');
  await swipe([[x, y], [x, y + 100]]);
  assert.deepEqual(await viewport(), whole);
  assert.deepEqual(take_complaints(), []);
}));

test('a finger drags a slider along x, and scrolls the sheet along y', () => as_telephone(async () => {
  await open('vibrated');
  await browser.tap('sheet.gas');
  const before = await browser.place_of('particles.restitution');
  const [x, y, width, height] = before;
  await swipe([[x + 0.9 * width, y + height / 2], [x + 0.4 * width, y + height / 2]]);
  await browser.until_last('status', 'e.restitution < 0.7');
  const sets = (await browser.events('set')).length;
  await swipe([[x + 0.9 * width, y + height / 2], [x + 0.9 * width, y + height / 2 - 60]]);
  const after = await browser.place_of('particles.restitution');
  assert.ok(Math.abs(after[1] - before[1] + 60) < 25, `moved by ${after[1] - before[1]}`);
  assert.equal((await browser.events('set')).length, sets);
}));

// The quick swipe has its press, its motion and its end before the next picture.
test('one finger turns spheres by its way, however quick', () => as_telephone(async () => {
  const way = [[180, 300], [240, 300]];
  const quick = () => Promise.all([browser.touch('touchStart', way[0]), browser.touch('touchMove', way[1]),
                                   browser.touch('touchEnd')]);
  for (const act of [() => swipe(way), quick]) {
    await open('spheres_vibrated', '&until=0');
    await browser.idle();
    await act();
    await browser.idle();
    const {azimuth} = await browser.last('turn');
    const expected = 20 - 0.4 * 60 * await browser.value('devicePixelRatio');
    assert.ok(Math.abs(azimuth - expected) < 0.5, `azimuth ${azimuth}, expected ${expected}`);
  }
}));

test('a touched field of text shows the keyboard of the screen', () => as_telephone(async () => {
  await open('cradle', '&until=0');
  await browser.tap('gallery');
  assert.equal(await focused(), 'canvas');
  const [x, y, , height] = await browser.place_of('gallery.close');
  await browser.tap_at(x - 100, y + height / 2);
  assert.equal(await focused(), 'keys');
  // Such keyboards insert words, replace them and delete characters, without codes of keys.
  await browser.send('Input.insertText', {text: 'Haff cook'});
  await browser.value(`document.execCommand('delete')`);
  await browser.send('Input.insertText', {text: 'l'});
  await browser.value(`(keys.setSelectionRange(100, 105), document.execCommand('delete'))`);
  await browser.settle();
  await browser.press('Enter', 'Enter');
  await browser.until_last('open', `JSON.stringify(e).includes('Haff')`);
}));

test('a touched number is typed on the keyboard of the screen', () => as_telephone(async () => {
  await open('vibrated', '&until=0');
  await browser.tap('sheet.gas');
  await browser.tap('particles.restitution.number');
  assert.equal(await focused(), 'keys');
  await browser.send('Input.insertText', {text: '0.55'});
  await browser.settle();
  await browser.press('Enter', 'Enter');
  await browser.until_last('status', 'e.restitution === 0.55');
}));

test('after many taps a gas that plays has one picture at a time', () => as_telephone(async () => {
  await open('vibrated');
  for (let k = 0; k < 5; ++k) await browser.tap_at(180, 300);
  const share = await browser.picture_share();
  assert.ok(share < 1.2, `${share} pictures of the page per picture of the browser`);
}));

test('after the graphics were lost a tap draws nothing, and the reason stays', () => as_telephone(async () => {
  await open('vibrated');
  await browser.value(`void canvas.getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()`);
  const reason = await browser.until('note.textContent');
  assert.match(reason, /graphics of this page were lost/);
  const drawn = (await browser.events('picture')).length;
  await browser.tap_at(180, 300);
  await browser.value(`tell('later')`);
  assert.equal((await browser.events('picture')).length, drawn);
  assert.equal(await browser.value('note.textContent'), reason);
}));

// The last test with fingers: after it, Chromium delivers no single touch to the next page.
test('two fingers move and zoom the view, and pick nothing', () => as_telephone(async () => {
  await open('vibrated', '&until=0');
  await browser.idle();
  const wall = () => browser.place_of('wall.left');
  const [left, , , tall] = await wall();
  await swipe([[160, 400], [200, 400]], [[200, 400], [240, 400]]);
  const moved = await wall();
  assert.ok(Math.abs(moved[0] - left - 40) < 3, `moved by ${moved[0] - left}`);
  assert.ok(Math.abs(moved[3] - tall) < 2, `height ${tall} became ${moved[3]}`);
  await swipe([[170, 350], [170, 330]], [[170, 370], [170, 390]]);
  const zoomed = await wall();
  const factor = zoomed[3] / moved[3];
  assert.ok(Math.abs(factor - 3) < 0.4, `zoomed by ${factor}`);
  assert.deepEqual(await browser.events('pick'), []);
}));
