// Tests of the page in headless Chromium: node test_page.mjs FOLDER [CASE]
// FOLDER has the page; CASE is a part of the names of the cases to run.

import assert from 'node:assert/strict';
import {Browser, serve, sleep} from './browser.mjs';

const [folder, chosen = ''] = process.argv.slice(2);
const cases = new Map();
const test = (name, run) => cases.set(name, run);

// Of `clatter measure vibrated --until 20 --seed 1`.
const kHash = '5ca4f7af577a3f59';

let browser, server;

// Opens a scene by the fragment of a link, with the script log.
async function open(fragment, query = '') {
  await browser.open(`${server.address}?log${query}#${fragment}`);
  await browser.until(`log.some((line) => line.includes('"event":"status"'))`);
}

const events = (name) => browser.value(
    `log.map((line) => JSON.parse(line)).filter((event) => event.event === '${name}')`);
const last = async (name) => (await events(name)).pop();
const place_of = async (widget) =>
    (await events('widget')).filter((event) => event.name === widget).pop().place;

// Middle of a widget, in pixels of the page.
async function middle_of(widget) {
  const [x, y, width, height] = await place_of(widget);
  return [x + width / 2, y + height / 2];
}

async function drag(widget, share) {
  const [x, y, width, height] = await place_of(widget);
  const [from, at] = await middle_of(widget);
  await browser.mouse('mouseMoved', from, at);
  await browser.mouse('mousePressed', from, at, 1);
  await sleep(500);
  await browser.mouse('mouseMoved', x + share * width, y + height / 2, 1);
  await sleep(500);
  await browser.mouse('mouseReleased', x + share * width, y + height / 2);
}

// Scrolls the left panel until a widget is in the page.
async function scroll_to(widget) {
  for (let turn = 0; turn < 40 && (await middle_of(widget))[1] > 700; ++turn) {
    await browser.send('Input.dispatchMouseEvent',
                       {type: 'mouseWheel', x: 100, y: 400, deltaX: 0, deltaY: 300});
    await sleep(500);
  }
}

async function click(widget) {
  const [x, y] = await middle_of(widget);
  await browser.mouse('mouseMoved', x, y);
  await sleep(500);
  await browser.mouse('mousePressed', x, y, 1);
  await sleep(500);
  await browser.mouse('mouseReleased', x, y);
}

// Errors of the browser since the last call: exceptions, and what it logs, such as errors of WebGL
// and breaches of the Content-Security-Policy.
function complaints() {
  const found = browser.events.filter((event) =>
      event.method === 'Runtime.exceptionThrown' || event.method === 'Log.entryAdded');
  browser.events.length = 0;
  return found.map((event) => JSON.stringify(event.params));
}

test('the gas has the state of native builds at t = 20', async () => {
  await open('vibrated&view.speed=100', '&until=20');
  const status = await browser.until(
      `log.map((line) => JSON.parse(line)).filter((e) => e.event === 'status' && e.time === 20 && e.hash).pop()`);
  assert.equal(status.hash, kHash);
});

test('every scene of the gallery opens and moves', async () => {
  await open('');
  const names = process.env.CLATTER_SCENES.split(' ');
  assert.ok(names.length > 10);
  for (const name of names) {
    await open(name);
    const first = await last('status');
    await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"status"')).pop()).time > ${first.time}`);
    assert.deepEqual(complaints(), [], name);
  }
});

test('a drag of the slider of restitution cools the gas', async () => {
  await open('vibrated&view.speed=5');
  await sleep(2000);
  const before = await last('status');
  // A busy machine may draw the press and the motion in one picture, and then sees no drag.
  for (let turn = 0; turn < 5 && !(await events('set')).length; ++turn) {
    await drag('particles.restitution', 0.3);
  }
  await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"status"')).pop()).restitution < 0.8`);
  await sleep(3000);
  const after = await last('status');
  assert.ok(after.temperature < 0.8 * before.temperature,
            `T = ${before.temperature} became ${after.temperature}`);
});

test('a link sets keys, and a copied link opens the same scene', async () => {
  await open('vibrated&particles.restitution=0.6&particles.count=120&view.field=temperature&seed=5');
  assert.equal((await last('status')).restitution, 0.6);
  await browser.value('void (Module.page.copy = (text) => { copied = text; }), void (globalThis.copied = "")');
  await scroll_to('link');
  await click('link');
  const link = await browser.until('copied');
  assert.ok(link.startsWith(server.address));
  await browser.open(link.replace("/#", "/?log#"));
  await browser.until(`log.some((line) => line.includes('"event":"status"'))`);
  const status = await last('status');
  assert.equal(status.restitution, 0.6);
  assert.equal(status.particles, 120);
  assert.equal((await last('open')).seed, 5);
});

test('a mistake in a link is shown with a suggestion', async () => {
  await open('vibrated&particles.restitutoin=0.6');
  assert.match((await last('message')).text, /restitutoin.*restitution/s);
  await open('vibrate');
  assert.match((await last('message')).text, /try "vibrated"/);
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
    const began = Date.now();
    await browser.value(`void (text_of('clatter_open', ${JSON.stringify(fragment)}, 0), wake())`);
    await browser.value('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))');
    assert.ok(Date.now() - began < 20000, fragment.slice(0, 200));
  }
  assert.ok(await browser.value('ready'));
  assert.deepEqual(complaints(), []);
});

test('the picture of a halted gas stays when the panels are drawn again', async () => {
  await open('vibrated&view.field=density', '&until=1');
  await browser.until('log.some((line) => JSON.parse(line).time === 1)');
  await sleep(1000);
  const colours = async () => (await browser.value(`(() => {
    Module._clatter_draw();
    const gl = canvas.getContext('webgl2');
    const pixels = new Uint8Array(4 * 400 * 400);
    gl.readPixels(620, 100, 400, 400, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return new Set(new Uint32Array(pixels.buffer)).size;
  })()`));
  assert.ok(await colours() > 100);
  await browser.mouse('mouseMoved', 700, 300);
  await sleep(1000);
  assert.ok(await colours() > 100);
});

test('a halted gas uses no pictures', async () => {
  await open('vibrated', '&until=0');
  await sleep(1500);
  await browser.value('void (globalThis.pictures = 0)');
  await browser.value(`void (globalThis.requested = requestAnimationFrame,
      globalThis.requestAnimationFrame = (f) => { ++pictures; return requested(f); })`);
  await sleep(1000);
  assert.equal(await browser.value('pictures'), 0);
});

test('reduced motion starts a halted gas', async () => {
  await browser.send('Emulation.setEmulatedMedia',
                     {features: [{name: 'prefers-reduced-motion', value: 'reduce'}]});
  await open('vibrated');
  await sleep(500);
  const status = await last('status');
  assert.equal(status.plays, false);
  assert.equal(status.time, 0);
  await browser.send('Emulation.setEmulatedMedia', {features: []});
});

test('after loading the page uses no network', async () => {
  await open('vibrated');
  browser.events.length = 0;
  await click('plots');
  await sleep(1500);
  const requests = browser.events.filter((event) => event.method === 'Network.requestWillBeSent')
      .map((event) => event.params.request.url).filter((url) => url.startsWith('http'));
  assert.deepEqual(requests, []);
});

server = await serve(folder);
browser = await Browser.start();
let failed = 0;
try {
  await browser.resize(1280, 720);
  for (const [name, run] of cases) {
    if (!name.includes(chosen)) continue;
    try {
      complaints();
      await run();
      console.log(`ok: ${name}`);
    } catch (error) {
      ++failed;
      console.log(`FAILED: ${name}\n  ${error.stack}`);
    }
  }
} finally {
  await browser.stop();
  server.close();
}
process.exitCode = failed ? 1 : 0;
