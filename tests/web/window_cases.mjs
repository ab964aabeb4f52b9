// Cases of test_page.mjs: the window with mouse and keys, links, and what browsers ask of a page.

import assert from 'node:assert/strict';
import {readdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {gzipSync} from 'node:zlib';
import {serve} from './browser.mjs';
import {program, program_hash, test} from './cases.mjs';
import {browser, drag, folder, open, scroll_to, server, take_complaints} from './in_chromium.mjs';

// More keys, and the state at t = 3 by `clatter measure vibrated --until 3 --seed 1 --set KEY=VALUE`.
const kHeated = {
  'change': '[{time=1.0,nudge={centre=[10.0,12.0],radius=4.0,scale=3.0}}]',
  'view.captions': '[{text="A nudge heats T_x",from=1.0}]',
  'measure.observables': '["radial_distribution"]',
};
const kHeatedHash = 'd87fe25e87821d81';

test('the files of the page are small', async () => {
  const sizes = readdirSync(folder).map((file) => gzipSync(readFileSync(join(folder, file)), {level: 9}).length);
  const all = sizes.reduce((sum, size) => sum + size, 0);
  console.log(`  ${all} bytes with gzip`);
  assert.ok(all <= 1.38e6, `${all} bytes`);
});

// ---- steps, picking and keys ----

test('the gas steps forth and back, by frames and by collisions', async () => {
  const shift = 8;
  await open('vibrated', '&until=1');
  const first = await browser.halted_where('e.time === 1');
  await browser.click('collision');
  const second = await browser.halted_where(`e.collisions === ${first.collisions + 1}`);
  await browser.press('Period', ':', shift);
  const third = await browser.halted_where(`e.collisions === ${first.collisions + 2}`);
  assert.notEqual(third.hash, second.hash);
  await browser.press('Comma', ';', shift);
  await browser.halted_where(`e.collisions === ${second.collisions} && e.hash === '${second.hash}'`);
  await browser.click('frame');
  const framed = await browser.halted_where(`e.time > ${third.time}`);
  await browser.press('Comma', ',');
  const back = await browser.halted_where(`e.time < ${framed.time}`);
  // Other keyboard layouts have the period, and the letter V, at other places.
  await browser.press('KeyE', '.');
  const again = await browser.halted_where(`e.time > ${back.time}`);
  await browser.press('Period', 'v');
  await browser.press('KeyE', '.');
  await browser.halted_where(`e.time > ${again.time}`);
  assert.equal((await browser.events('step_frame')).length, 3);
});

test('a click picks the particle under it, and a click beside it none', async () => {
  await open('cradle', '&until=0');
  const [x, , width, height] = await browser.place_of('viewport');
  const [, row_at] = await browser.middle_of('wall.left');
  const click = (right, up) => browser.click_at(x + right * width, row_at - up * height);
  // The numbers of the disks in the row rise from left to right.
  const row = [];
  for (const right of [0.3, 0.4, 0.5, 0.6]) {
    await click(right, 0);
    row.push((await browser.until_last('pick', `e.particle !== null && e.particle > ${row.at(-1) ?? -1}`)).particle);
    await click(right, -0.3);
    await browser.until_last('pick', 'e.particle === null');
  }
});

test('the key T hides the lesson of a scene, and shows it again', async () => {
  await open('vibrated', '&until=0');
  const height = async () => (await browser.place_of('viewport'))[3];
  const before = await height();
  await browser.press('KeyT', 't');
  const without = await height();
  assert.ok(without > before + 20, `${before} became ${without}`);
  await browser.press('KeyT', 't');
  assert.equal(await height(), before);
});

test('lecture mode has a large plot, a timeline and tools, and Esc ends it', async () => {
  await open('vibrated');
  await browser.press('KeyL', 'l');
  for (const widget of ['lecture.close', 'lecture.stopwatch', 'lecture.pen', 'timeline']) {
    await browser.place_of(widget);
  }
  const [, , narrow] = await browser.place_of('viewport');
  await browser.press('Escape', 'Escape');
  const [, , wide] = await browser.place_of('viewport');
  assert.notEqual(narrow, wide);
});

test('a drag of the slider of restitution cools the gas', async () => {
  // Without a contact time this restitution ends in inelastic collapse, after some ten time units.
  await open('vibrated&view.speed=20&collapse.contact_time=0.01');
  const before = await browser.until_last('status', 'e.time > 5');
  await drag('particles.restitution', 0.3);
  const {time} = await browser.until_last('status', 'e.restitution < 0.8');
  const after = await browser.until_last('status', `e.time > ${time} + 10`);
  assert.ok(after.temperature < 0.8 * before.temperature,
            `T = ${before.temperature} became ${after.temperature}`);
});

// ---- the same bits ----

test('a link with a nudge, a caption and an observable has the state of native builds', async () => {
  const set = Object.entries(kHeated).map(([key, value]) => `&${key}=${encodeURIComponent(value)}`).join('');
  await open('vibrated&view.speed=20' + set, '&until=3');
  assert.equal((await browser.halted_where('e.time === 3')).hash, kHeatedHash);
  assert.deepEqual(await browser.events('message'), []);
  assert.deepEqual(take_complaints(), []);
});

test('every scene of the gallery has the state of native builds at t = 1', async () => {
  const names = process.env.CLATTER_SCENES.split(' ');
  assert.ok(names.length > 10);
  for (const name of names) {
    await open(`${name}&view.speed=100`, '&until=1');
    const {hash} = await browser.halted_where('e.time === 1');
    assert.deepEqual(take_complaints(), [], name);
    if (program) assert.equal(hash, program_hash(name, 1), name);
  }
  return program ? '' : ' (hashes skipped: needs a build of the program)';
});

// ---- links ----

test('a link sets keys, and a copied link opens the same scene', async () => {
  await open('vibrated&particles.restitution=0.6&particles.count=120&view.field=temperature&seed=5');
  assert.equal((await browser.last('status')).restitution, 0.6);
  await browser.value('void (Module.page.copy = (text) => { copied = text; }), void (globalThis.copied = "")');
  await scroll_to('link');
  await browser.click('link');
  const link = await browser.until('copied');
  assert.ok(link.startsWith(server.address));
  await browser.open(link.replace('/#', '/?log#'));
  const status = await browser.until_last('status', 'true');
  assert.equal(status.restitution, 0.6);
  assert.equal(status.particles, 120);
  assert.equal((await browser.last('open')).seed, 5);
});

test('a mistake in a link is shown with a suggestion', async () => {
  await open('vibrated&particles.restitutoin=0.6');
  assert.match((await browser.last('message')).text, /restitutoin.*restitution/s);
  await open('vibrate');
  assert.match((await browser.last('message')).text, /try "vibrated"/);
});

test('hostile fragments give a message or a scene, and the page stays alive', async () => {
  await open('', '&until=0');
  let random = 12345;
  const next = (count) => (random = (1103515245 * random + 12345) % 2147483648) % count;
  const seeds = ['vibrated', 'particles.count=1000000000', 'box.size=[1e300,1e300]', 'scene=AAAA',
                 'scene=' + 'A'.repeat(1000000), 'seed=-1', 'view.trails=1e308', '%00%ff%', '=&=&',
                 'particles.start.file=/dev/random', 'particles.start.layout=file', 'measure.cells=[1000000,1000000]',
                 '<script>alert(1)</script>', '../../etc/passwd', 'particles={count=1e9}', '"', "'", '\n\n[x]'];
  for (let turn = 0; turn < 200; ++turn) {
    let fragment = next(3) ? 'vibrated' : seeds[next(seeds.length)];
    for (let part = next(4); part > 0; --part) {
      const piece = seeds[next(seeds.length)];
      const at = next(piece.length + 1);
      fragment += '&' + piece.slice(0, at) + String.fromCharCode(32 + next(95)) + piece.slice(at + next(2));
    }
    await browser.value(`void (text_of('clatter_open', ${JSON.stringify(fragment)}, 0), wake())`);
    await browser.pictures(2);
  }
  assert.ok(await browser.value('ready'));
  assert.deepEqual(take_complaints(), []);
});

// ---- pictures ----

test('the picture of a halted gas stays when the panels are drawn again', async () => {
  await open('vibrated&view.field=density', '&until=1');
  await browser.halted_where('e.time === 1');
  await browser.idle();
  const middle = [620, 220, 400, 400];
  assert.ok(await browser.colours_in(middle) > 100);
  await browser.mouse('mouseMoved', 700, 300);
  await browser.idle();
  assert.ok(await browser.colours_in(middle) > 100);
});

// Pictures that the page asks for while the browser shows `shown`.
const asked_pictures = (shown) => browser.value(`new Promise((done) => {
  const ask = requestAnimationFrame;
  let pictures = 0, left = ${shown};
  window.requestAnimationFrame = (draw) => { ++pictures; return ask(draw); };
  ask(function next() {
    if (left--) return ask(next);
    window.requestAnimationFrame = ask;
    done(pictures);
  });
})`);

test('a halted gas uses no pictures, and a gas that plays one at a time', async () => {
  await open('vibrated', '&until=0');
  await browser.idle();
  assert.equal(await asked_pictures(30), 0);
  await open('vibrated');
  const pictures = await asked_pictures(30);
  assert.ok(pictures > 15 && pictures < 33, `${pictures}`);
});

test('reduced motion starts a halted gas', async () => {
  await browser.send('Emulation.setEmulatedMedia',
                     {features: [{name: 'prefers-reduced-motion', value: 'reduce'}]});
  try {
    await open('vibrated');
    await browser.idle();
    const status = await browser.last('status');
    assert.equal(status.plays, false);
    assert.equal(status.time, 0);
  } finally {
    await browser.send('Emulation.setEmulatedMedia', {features: []});
  }
});

// ---- browsers ----

// Leaves the page. Returns the kinds of the questions that it asked before.
async function leave() {
  const questions = () => browser.told.filter((event) => event.method === 'Page.javascriptDialogOpening')
      .map((event) => event.params.type);
  let gone = false;
  const going = browser.send('Page.navigate', {url: 'about:blank'}).then(() => { gone = true; });
  await browser.found(() => gone || questions().length, 'the page is left, or asks');
  const asked = questions();
  if (asked.length) await browser.send('Page.handleJavaScriptDialog', {accept: true});
  await going;
  return asked;
}

test('a page with unsaved changes asks before it is left, and an unchanged one does not', async () => {
  await open('cradle', '&until=0');
  await browser.click('viewport');  // browsers ask only after a click or a key
  assert.deepEqual(await leave(), []);
  await open('vibrated');
  await drag('particles.count', 0.3);
  await browser.until('Module._clatter_unsaved()');
  assert.deepEqual(await leave(), ['beforeunload']);
});

test('after loading the page uses no network', async () => {
  await open('vibrated');
  browser.told.length = 0;
  await browser.click('plots');
  await browser.pictures(60);
  const requests = browser.told.filter((event) => event.method === 'Network.requestWillBeSent')
      .map((event) => event.params.request.url).filter((url) => url.startsWith('http'));
  assert.deepEqual(requests, []);
});

test('the button and F11 enter and leave full screen', async () => {
  await open('vibrated', '&until=0');
  await scroll_to('full_screen');
  await browser.click('full_screen');
  await browser.until(`document.fullscreenElement === document.documentElement`);
  await browser.press('F11', 'F11');
  await browser.until(`document.fullscreenElement === null`);
});

// A browser whose pages run a script first shows a message in place of a gas.
async function refused_with(script, message) {
  const {identifier} = await browser.send('Page.addScriptToEvaluateOnNewDocument', {source: script});
  try {
    await browser.open(`${server.address}#vibrated`, `document.getElementById('note').textContent.match(${message})`);
    assert.equal(await browser.value('ready'), false);
  } finally {
    await browser.send('Page.removeScriptToEvaluateOnNewDocument', {identifier});
  }
}

test('a browser without vectors of WebAssembly, or without WebGL 2, gives a message', async () => {
  await refused_with('WebAssembly.validate = () => false', /no vectors of WebAssembly/);
  await refused_with('HTMLCanvasElement.prototype.getContext = () => null', /no WebGL 2/);
});

test('a page without one of its parts names it', async () => {
  for (const part of readdirSync(folder).filter((file) => file !== 'index.html')) {
    const {address, close} = await serve(folder, {[`/${part}`]: null});
    try {
      await browser.open(address, `document.readyState === 'complete' && note.textContent.includes('could not be loaded')`);
      assert.ok((await browser.value('note.textContent')).includes(part), part);
      assert.ok(!await browser.value('window.ready'), part);
    } finally {
      close();
    }
  }
});

test('a program that stops says why, and later messages do not hide it', async () => {
  await open('vibrated');
  await browser.value(`void (Module._clatter_draw = () => { throw new Error('a mistake'); })`);
  const reason = await browser.until('note.textContent');
  assert.equal(reason, 'The program stopped: Error: a mistake. Reload the page to start again.');
  await browser.value(`void (Module.onAbort('later'), tell('later'))`);
  assert.equal(await browser.value('note.textContent'), reason);
});

test('a hidden page does not run', async () => {
  await open('vibrated');
  const {windowId} = await browser.send('Browser.getWindowForTarget');
  const show = (windowState) => browser.send('Browser.setWindowBounds', {windowId, bounds: {windowState}});
  await show('minimized');
  try {
    await browser.until(`document.visibilityState === 'hidden'`);
    // Timers of the page go on, at one per second.
    const [drawn, before, after] = await browser.value(`(async () => {
      const round = () => new Promise((done) => setTimeout(done, 100));
      await round();
      let drawn = false;
      requestAnimationFrame(() => { drawn = true; });
      const before = log.length;
      for (let rounds = 4; rounds > 0; --rounds) await round();
      return [drawn, before, log.length];
    })()`);
    assert.equal(drawn, false);
    assert.equal(after, before);
  } finally {
    await show('normal');
  }
  const {collisions} = await browser.last('status');
  await browser.until_last('status', `e.collisions > ${collisions}`);
});
