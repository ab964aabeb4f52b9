// Tests of the page in headless Chromium: node test_page.mjs FOLDER [CASE]
// FOLDER has the page; CASE is a part of the names of the cases to run.

import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {gzipSync} from 'node:zlib';
import {Browser, serve, sleep} from './browser.mjs';

const [folder, chosen = ''] = process.argv.slice(2);
const cases = new Map();
const test = (name, run) => cases.set(name, run);

// Of `clatter measure vibrated --until 20 --seed 1`.
const kHash = '5ca4f7af577a3f59';

// More keys, and the state at t = 3 by `clatter measure vibrated --until 3 --seed 1 --set KEY=VALUE`.
const kHeated = {
  'change': '[{time=1.0,nudge={centre=[10.0,12.0],radius=4.0,scale=3.0}}]',
  'view.captions': '[{text="A nudge heats T_x",from=1.0}]',
  'measure.observables': '["radial_distribution"]',
};
const kHeatedHash = 'd87fe25e87821d81';

let browser, server, host;  // host serves pages of another origin

const scratch_folder = mkdtempSync(join(tmpdir(), 'clatter-page-'));
const scratch = (name) => join(scratch_folder, name);

// The program, if it was built.
const program = ['release', 'ci'].map((build) => join(process.env.CLATTER_BUILD || '', build, 'clatter'))
    .find(existsSync);
const has_ffmpeg = spawnSync('ffprobe', ['-version']).status === 0;

// Runs a program, which must succeed.
function execute(program, ...words) {
  const outcome = spawnSync(program, words, {encoding: 'utf8'});
  assert.equal(outcome.status, 0, `${program} ${words.join(' ')}: ${outcome.error || outcome.stderr}`);
  return outcome;
}

// Opens a scene by the fragment of a link, with the script log.
async function open(fragment, query = '') {
  await browser.open(`${server.address}?log${query}#${fragment}`);
  await browser.until(`log.some((line) => line.includes('"event":"status"'))`);
}

const events = (name) => browser.value(
    `log.map((line) => JSON.parse(line)).filter((event) => event.event === '${name}')`);
const last = async (name) => (await events(name)).pop();

// The first pictures have no walls yet.
async function place_of(widget) {
  await browser.until(`log.some((line) => line.includes('"name":"${widget}"'))`);
  return (await events('widget')).filter((event) => event.name === widget).pop().place;
}

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

// Presses a key of the keyboard.
async function press(code, key, shift = false) {
  const modifiers = shift ? 8 : 0;
  await browser.send('Input.dispatchKeyEvent', {type: 'keyDown', code, key, text: key.length === 1 ? key : '', modifiers});
  await sleep(100);
  await browser.send('Input.dispatchKeyEvent', {type: 'keyUp', code, key, modifiers});
}

// The last status, once the gas is halted and a condition holds. It has the hash of the state.
const halted_where = (condition) => browser.until(
    `log.map((line) => JSON.parse(line)).filter((e) => e.event === 'status').slice(-1).find((e) => e.hash && (${condition}))`);

// Scrolls the left panel until a widget is in the page.
async function scroll_to(widget) {
  for (let turn = 0; turn < 40 && (await middle_of(widget))[1] > 700; ++turn) {
    await browser.send('Input.dispatchMouseEvent',
                       {type: 'mouseWheel', x: 100, y: 400, deltaX: 0, deltaY: 300});
    await sleep(500);
  }
}

async function click(widget) {
  await click_at(...await middle_of(widget));
}

async function click_at(x, y) {
  await browser.mouse('mouseMoved', x, y);
  await sleep(500);
  await browser.mouse('mousePressed', x, y, 1);
  await sleep(500);
  await browser.mouse('mouseReleased', x, y);
}

test('the files of the page are small', async () => {
  const sizes = readdirSync(folder).map((file) => gzipSync(readFileSync(join(folder, file)), {level: 9}).length);
  const all = sizes.reduce((sum, size) => sum + size, 0);
  console.log(`  ${all} bytes with gzip`);
  assert.ok(all <= 1.3e6, `${all} bytes`);
});

test('the gas steps forth and back, by frames and by collisions', async () => {
  await open('vibrated', '&until=1');
  const first = await halted_where('e.time === 1');
  await click('collision');
  const second = await halted_where(`e.collisions === ${first.collisions + 1}`);
  await press('Period', ':', true);
  const third = await halted_where(`e.collisions === ${first.collisions + 2}`);
  assert.notEqual(third.hash, second.hash);
  await press('Comma', ';', true);
  await halted_where(`e.collisions === ${second.collisions} && e.hash === '${second.hash}'`);
  await click('frame');
  const framed = await halted_where(`e.time > ${third.time}`);
  await press('Comma', ',');
  const back = await halted_where(`e.time < ${framed.time}`);
  // Other keyboard layouts have the period, and the letter V, at other places.
  await press('KeyE', '.');
  const again = await halted_where(`e.time > ${back.time}`);
  await press('Period', 'v');
  await press('KeyE', '.');
  await halted_where(`e.time > ${again.time}`);
  assert.equal(await browser.value(`log.filter((line) => line.includes('"event":"step_frame"')).length`), 3);
});

test('a click picks the particle under it, and a click beside it none', async () => {
  await open('cradle', '&until=0');
  const [x, y, width, height] = await place_of('viewport');
  const picked = async (right, up) => {
    await click_at(x + right * width, y + (0.5 - up) * height);
    await sleep(300);
    return (await last('pick'))?.particle ?? null;
  };
  // The row is in the middle of the box. Its disks have rising numbers from left to right.
  const row = [];
  for (const right of [0.3, 0.4, 0.5, 0.6]) {
    row.push(await picked(right, 0));
    assert.equal(await picked(right, -0.3), null);
  }
  assert.ok(row.every((disk, k) => disk !== null && (k === 0 || disk > row[k - 1])), row.join());
});

test('the key T hides the lesson of a scene, and shows it again', async () => {
  await open('vibrated', '&until=0');
  const height = async () => (await place_of('viewport'))[3];
  const before = await height();
  await press('KeyT', 't');
  await sleep(1000);
  const without = await height();
  assert.ok(without > before + 20, `${before} became ${without}`);
  await press('KeyT', 't');
  await sleep(1000);
  assert.equal(await height(), before);
});

test('lecture mode has a large plot, a timeline and tools, and Esc ends it', async () => {
  await open('vibrated');
  await press('KeyL', 'l');
  for (const widget of ['lecture.close', 'lecture.stopwatch', 'lecture.pen', 'timeline']) {
    await browser.until(`log.some((line) => line.includes('"name":"${widget}"'))`);
  }
  const [, , narrow] = await place_of('viewport');
  await press('Escape', 'Escape');
  await sleep(1000);
  const [, , wide] = await place_of('viewport');
  assert.notEqual(narrow, wide);
});

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

test('a link with a nudge, a caption and an observable has the state of native builds', async () => {
  const set = Object.entries(kHeated).map(([key, value]) => `&${key}=${encodeURIComponent(value)}`).join('');
  await open('vibrated&view.speed=20' + set, '&until=3');
  const status = await browser.until(
      `log.map((line) => JSON.parse(line)).filter((e) => e.event === 'status' && e.time === 3 && e.hash).pop()`);
  assert.equal(status.hash, kHeatedHash);
  assert.deepEqual(await events('message'), []);
  assert.deepEqual(complaints(), []);
});

test('every scene of the gallery has the state of native builds at t = 1', async () => {
  const names = process.env.CLATTER_SCENES.split(' ');
  assert.ok(names.length > 10);
  for (const name of names) {
    await open(`${name}&view.speed=100`, '&until=1');
    const {hash} = await halted_where('e.time === 1');
    assert.deepEqual(complaints(), [], name);
    if (!program) continue;
    const {stdout} = execute(program, 'measure', name, '--until', '1', '--seed', '1', '--set', 'measure.burn_in=0.0');
    assert.equal(hash, JSON.parse(stdout).state_hash, name);
  }
  return program ? '' : ' (hashes skipped: needs a build of the program)';
});

test('a drag of the slider of restitution cools the gas', async () => {
  await open('vibrated&view.speed=5');
  await sleep(2000);
  const before = await last('status');
  await drag('particles.restitution', 0.3);
  await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"status"')).pop()).restitution < 0.8`);
  await sleep(3000);
  const after = await last('status');
  assert.ok(after.temperature < 0.8 * before.temperature,
            `T = ${before.temperature} became ${after.temperature}`);
});

// Leaves the page. Returns the kinds of the questions that it asked before.
async function leave() {
  const questions = () => browser.events.filter((event) => event.method === 'Page.javascriptDialogOpening')
      .map((event) => event.params.type);
  let gone = false;
  const going = browser.send('Page.navigate', {url: 'about:blank'}).then(() => { gone = true; });
  while (!gone && !questions().length) await sleep(100);
  const asked = questions();
  if (asked.length) await browser.send('Page.handleJavaScriptDialog', {accept: true});
  await going;
  return asked;
}

test('a page with unsaved changes asks before it is left, and an unchanged one does not', async () => {
  await open('cradle', '&until=0');
  await click('viewport');  // browsers ask only after a click or a key
  assert.deepEqual(await leave(), []);
  await open('vibrated');
  await drag('particles.restitution', 0.3);
  await sleep(1000);
  assert.deepEqual(await leave(), ['beforeunload']);
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

// ---- fingers ----

const touch = (type, ...points) =>
    browser.send('Input.dispatchTouchEvent',
                 {type, touchPoints: points.map(([x, y], id) => ({x, y, id}))});

// A page on a small telephone with two pixels of the device per pixel.
async function as_telephone(run) {
  await browser.resize(360, 740, 2, true);
  await browser.send('Emulation.setTouchEmulationEnabled', {enabled: true, maxTouchPoints: 5});
  try {
    await run();
  } finally {
    await browser.send('Emulation.setTouchEmulationEnabled', {enabled: false});
    await browser.resize(1280, 720);
  }
}

async function finger_place(widget) {
  const scale = await browser.value('devicePixelRatio');
  return (await place_of(widget)).map((length) => length / scale);
}

// The place must stay for the time of a few pictures.
async function settled_place(widget) {
  for (let place = null;;) {
    const next = await finger_place(widget);
    if (place && place.join() === next.join()) return place;
    place = next;
    await sleep(300);
  }
}

async function tap(widget) {
  const [x, y, width, height] = await settled_place(widget);
  const middle = [x + width / 2, y + height / 2];
  await touch('touchStart', middle);
  await sleep(100);
  await touch('touchEnd');
  await sleep(500);
}

// Moves fingers along straight lines, each [from, to].
async function swipe(...lines) {
  const steps = 10;
  const at = (share) => lines.map(([from, to]) => from.map((x, k) => x + share * (to[k] - x)));
  await touch('touchStart', ...at(0));
  for (let step = 1; step <= steps; ++step) {
    await sleep(60);
    await touch('touchMove', ...at(step / steps));
  }
  await sleep(300);
  await touch('touchEnd');
  await sleep(500);
}

test('a telephone has one sheet at a time, with areas for fingers', () => as_telephone(async () => {
  await open('vibrated', '&until=1');
  const whole = await settled_place('viewport');
  assert.ok(whole[2] === 360 && whole[3] > 600, `viewport ${whole}`);
  for (const name of ['run', 'gas', 'view', 'record', 'plots', 'lesson']) {
    const [x, y, width, height] = await finger_place(`sheet.${name}`);
    assert.ok(x >= 0 && x + width <= 360 && y + height <= 740 && width >= 40 && height >= 40,
              `${name}: ${width} x ${height} at ${x}, ${y}`);
  }
  await tap('sheet.gas');
  const half = await settled_place('viewport');
  assert.ok(half[3] < 0.6 * whole[3]);
  await tap('sheet.plots');
  assert.deepEqual(await settled_place('viewport'), half);
  await tap('sheet.close');
  assert.deepEqual(await settled_place('viewport'), whole);
  await tap('sheet.gas');
  const [x, y, width, height] = await settled_place('sheet.close');
  await swipe([[x + width / 2, y + height / 2], [x + width / 2, y + height / 2 + 100]]);
  assert.deepEqual(await settled_place('viewport'), whole);
  assert.deepEqual(complaints(), []);
}));

test('a finger drags a slider along x, and scrolls the sheet along y', () => as_telephone(async () => {
  await open('vibrated');
  await tap('sheet.gas');
  const before = await settled_place('particles.restitution');
  const [x, y, width, height] = before;
  await swipe([[x + 0.9 * width, y + height / 2], [x + 0.4 * width, y + height / 2]]);
  await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"status"')).pop()).restitution < 0.7`);
  const sets = (await events('set')).length;
  await swipe([[x + 0.9 * width, y + height / 2], [x + 0.9 * width, y + height / 2 - 60]]);
  const after = await settled_place('particles.restitution');
  assert.ok(Math.abs(after[1] - before[1] + 60) < 25, `moved by ${after[1] - before[1]}`);
  assert.equal((await events('set')).length, sets);
}));

// The quick swipe has its press, its motion and its end before the next picture.
test('one finger turns spheres by its way, however quick', () => as_telephone(async () => {
  const way = [[180, 300], [240, 300]];
  const quick = () => Promise.all([
    touch('touchStart', way[0]), touch('touchMove', way[1]), touch('touchEnd')]);
  for (const act of [() => swipe(way), quick]) {
    await open('spheres_vibrated', '&until=0');
    await act();
    await sleep(1000);
    const {azimuth} = (await events('turn')).pop();
    const expected = 20 - 0.4 * 60 * await browser.value('devicePixelRatio');
    assert.ok(Math.abs(azimuth - expected) < 0.5, `azimuth ${azimuth}, expected ${expected}`);
  }
}));

test('a touched field of text shows the keyboard of the screen', () => as_telephone(async () => {
  await open('cradle', '&until=0');
  const focused = () => browser.value('document.activeElement.id');
  await tap('gallery');
  assert.equal(await focused(), 'canvas');
  const [x, y, , height] = await settled_place('gallery.close');
  await touch('touchStart', [x - 100, y + height / 2]);
  await sleep(100);
  await touch('touchEnd');
  await sleep(500);
  assert.equal(await focused(), 'keys');
  // Such keyboards insert words, replace them and delete characters, without codes of keys.
  await browser.send('Input.insertText', {text: 'Haff cook'});
  await browser.value(`document.execCommand('delete')`);
  await browser.send('Input.insertText', {text: 'l'});
  await browser.value(`(keys.setSelectionRange(100, 105), document.execCommand('delete'))`);
  await sleep(500);
  await browser.send('Input.dispatchKeyEvent', {type: 'keyDown', code: 'Enter', key: 'Enter'});
  await sleep(500);
  await browser.send('Input.dispatchKeyEvent', {type: 'keyUp', code: 'Enter', key: 'Enter'});
  await browser.until(`log.some((line) => line.includes('"event":"open"') && line.includes('Haff'))`);
}));

test('a touched number is typed on the keyboard of the screen', () => as_telephone(async () => {
  await open('vibrated', '&until=0');
  await tap('sheet.gas');
  await tap('particles.restitution.number');
  assert.equal(await browser.value('document.activeElement.id'), 'keys');
  await browser.send('Input.insertText', {text: '0.55'});
  await sleep(500);
  await browser.send('Input.dispatchKeyEvent', {type: 'keyDown', code: 'Enter', key: 'Enter'});
  await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"status"')).pop()).restitution === 0.55`);
}));

// The last test with fingers: after it, Chromium delivers no single touch to the next page.
test('two fingers move and zoom the view, and pick nothing', () => as_telephone(async () => {
  await open('vibrated', '&until=0');
  const wall = async () => settled_place('wall.left');
  const [left, , , tall] = await wall();
  await swipe([[160, 400], [200, 400]], [[200, 400], [240, 400]]);
  const moved = await wall();
  assert.ok(Math.abs(moved[0] - left - 40) < 3, `moved by ${moved[0] - left}`);
  assert.ok(Math.abs(moved[3] - tall) < 2, `height ${tall} became ${moved[3]}`);
  await swipe([[170, 350], [170, 330]], [[170, 370], [170, 390]]);
  const zoomed = await wall();
  const factor = zoomed[3] / moved[3];
  assert.ok(Math.abs(factor - 3) < 0.4, `zoomed by ${factor}`);
  assert.deepEqual(await events('pick'), []);
}));

// ---- embedded ----

test('an embedded gas has its chosen controls alone, in an iframe of another origin', async () => {
  const controls = 'play,particles.restitution,walls.left.drive_speed';
  await browser.open(`${host.address}frame.html?embed&log&controls=${controls}#vibrated`,
                     `document.querySelector('iframe')?.contentDocument === null`);
  const inside = async (expression) => browser.value(expression, await browser.iframe());
  while (!await inside(`document.title.includes('Vibrated')`)) await sleep(100);
  await sleep(1500);
  const names = await inside(
      `log.map((line) => JSON.parse(line)).filter((event) => event.event === 'widget')
      .map((event) => event.name)`);
  for (const name of controls.split(',')) assert.ok(names.includes(name), `no ${name}`);
  for (const name of ['gallery', 'reset', 'particles.count', 'walls.right.drive_speed']) {
    assert.ok(!names.includes(name), name);
  }
  assert.deepEqual(complaints(), []);
});

test('an unknown control of an embedded gas is named with a suggestion', async () => {
  await open('vibrated', '&embed&controls=particles.restitutoin');
  const {text} = await browser.until(`log.map((line) => JSON.parse(line)).filter((event) => event.event === 'message').pop()`);
  assert.match(text, /restitutoin.*"particles.restitution"/s);
});

test('an embedded gas without controls has the picture of the program', async () => {
  if (!program || !has_ffmpeg) return ' (skipped: needs a build of the program, and ffmpeg)';
  await browser.resize(960, 720);
  try {
    await open('vibrated', '&embed&until=3');
    await browser.until('log.some((line) => JSON.parse(line).time === 3)');
    await sleep(1000);
    writeFileSync(scratch('page.png'), await browser.picture());
  } finally {
    await browser.resize(1280, 720);
  }
  execute(program, 'render', 'vibrated', '--from', '3', '--size', '960x720', '--out', scratch('program.png'), '--overwrite');
  const {stderr} = execute('ffmpeg', '-i', scratch('page.png'), '-i', scratch('program.png'),
                           '-lavfi', 'ssim', '-f', 'null', '-');
  const likeness = Number(/All:([\d.]+)/.exec(stderr)[1]);
  console.log(`  SSIM ${likeness}`);
  assert.ok(likeness >= 0.98, `SSIM ${likeness}`);
});

// ---- files ----

// Keeps the next downloads in the page instead: saved has [name, Blob].
const keep_downloads = () => browser.value(`void (globalThis.saved = [],
    globalThis.blob = null, URL.createObjectURL = (made) => { blob = made; return '#'; },
    HTMLAnchorElement.prototype.click = function () { saved.push([this.download, blob]); })`);

async function saved_file(number = 0) {
  const name = await browser.until(`saved[${number}]?.[0]`);
  const text = await browser.value(`new Promise((done) => {
    const reader = new FileReader();
    reader.onload = () => done(reader.result);
    reader.readAsDataURL(saved[${number}][1]);
  })`);
  return [name, Buffer.from(text.split(',')[1], 'base64')];
}

test('a film shows the gas', async () => {
  if (!has_ffmpeg) return ' (skipped: needs ffmpeg)';
  await open('vibrated&view.speed=3');
  await keep_downloads();
  await browser.value(`void (globalThis.filmed = 0, globalThis.added = Film.prototype.add,
      Film.prototype.add = function (...place) { ++filmed; return added.apply(this, place); })`);
  await scroll_to('film');
  const began = Date.now();
  await click('film');
  await sleep(3000);
  await browser.until('filmed > 30');
  await click('film');
  const longest = (Date.now() - began) / 1000;
  const [name, bytes] = await saved_file();
  assert.match(name, /^clatter-1\.(mp4|webm)$/);
  writeFileSync(scratch(name), bytes);
  const probe = execute('ffprobe', '-v', 'error', '-count_packets', '-select_streams', 'v', '-show_entries',
                        'stream=codec_name,width,height,nb_read_packets', '-of', 'json', scratch(name));
  const [stream] = JSON.parse(probe.stdout).streams;
  const [, , width, height] = await place_of('viewport');
  assert.ok(Math.abs(stream.width - width) <= 2 && Math.abs(stream.height - height) <= 2);
  assert.ok(stream.nb_read_packets >= 10, `${stream.nb_read_packets} frames`);
  const times = execute('ffprobe', '-v', 'error', '-select_streams', 'v', '-show_entries', 'packet=pts_time',
                        '-of', 'csv=p=0', scratch(name)).stdout.split('\n').map(parseFloat).filter(isFinite);
  const length = Math.max(...times) - Math.min(...times);
  assert.ok(length > 1.5 && length < longest + 1, `${length} s`);
  execute('ffmpeg', '-v', 'error', '-y', '-sseof', '-1', '-i', scratch(name), '-frames:v', '1', scratch('film.png'));
  const {stderr} = execute('ffmpeg', '-i', scratch('film.png'), '-vf', 'signalstats,metadata=print', '-f', 'null', '-');
  const value = (key) => Number(new RegExp(`${key}=([\\d.]+)`).exec(stderr)[1]);
  console.log(`  ${name}: ${stream.codec_name}, ${stream.nb_read_packets} frames in ${length} s, ${bytes.length} bytes`);
  assert.ok(value('YMAX') - value('YMIN') > 100, 'the frame has no contrast');
});

// Drops files on the page, each [name, bytes].
const drop = (...files) => browser.value(`(() => {
  const data = new DataTransfer();
  for (const [name, text] of ${JSON.stringify(files.map(([name, bytes]) => [name, Buffer.from(bytes).toString('base64')]))}) {
    data.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
  }
  dispatchEvent(new DragEvent('drop', {dataTransfer: data, cancelable: true}));
})()`);

test('a dropped scene opens, and so does a dropped picture', async () => {
  await open('cradle');
  await drop(['own.toml', 'title = "Own"\nbox.size = [12.0, 9.0]\nparticles.count = 17\n']);
  await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"status"')).pop()).particles === 17`);
  assert.equal((await last('open')).title, 'Own');
  await keep_downloads();
  await scroll_to('screenshot');
  await click('screenshot');
  const [name, picture] = await saved_file();
  assert.match(name, /\.png$/);
  await open('cradle');
  await drop([name, picture]);
  await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"status"')).pop()).particles === 17`);
  assert.equal((await last('open')).title, 'Own');
  await drop(['wrong.toml', 'box.size = "wide"']);
  await browser.until(`log.some((line) => line.includes('"event":"message"'))`);
  assert.match((await last('message')).text, /box.size/);
});

test('a saved scene with a start state is two files, which the page and the program open again', async () => {
  await open('vibrated', '&until=1');
  await halted_where('e.time === 1');
  await keep_downloads();
  await drag('box.size.x', 0.6);  // the gas adapts and is the start of another scene
  const start = await halted_where(`e.time === 0`);
  await browser.send('Input.dispatchKeyEvent', {type: 'keyDown', code: 'KeyS', key: 's', modifiers: 2});
  const files = [await saved_file(0), await saved_file(1)];
  assert.deepEqual(files.map(([name]) => name), ['clatter-1.csv', 'clatter-1.toml']);
  await open('cradle', '&until=0');
  await drop(...files);
  await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"status"')).pop()).particles > 10`);
  await press('Space', ' ');
  await press('Home', 'Home');
  assert.equal((await halted_where('e.particles > 10 && e.time === 0')).hash, start.hash);
  await press('Period', ':', true);
  const stepped = await halted_where('e.particles > 10 && e.collisions === 1');
  if (!program) return ' (partly skipped: needs a build of the program)';
  for (const [name, bytes] of files) writeFileSync(scratch(name), bytes);
  const {stdout} = execute(program, 'measure', scratch('clatter-1.toml'), '--seed', '1', '--until',
                           `${stepped.time}`, '--set', 'measure.burn_in=0.0');
  assert.equal(JSON.parse(stdout).state_hash, stepped.hash);
});

test('a dropped file that is too large gives a message', async () => {
  await open('cradle');
  await drop(['large.csv', Buffer.alloc(20e6 + 1)]);
  await browser.until(`log.some((line) => line.includes('"event":"message"'))`);
  assert.match((await last('message')).text, /large.csv is larger than 20 MB/);
});

// ---- browsers ----

test('the button and F11 enter and leave full screen', async () => {
  await open('vibrated', '&until=0');
  await scroll_to('full_screen');
  await click('full_screen');
  await browser.until(`document.fullscreenElement === document.documentElement`);
  await press('F11', 'F11');
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

// ---- time ----

test('a hidden page does not run', async () => {
  await open('vibrated');
  const {windowId} = await browser.send('Browser.getWindowForTarget');
  const collisions = async () => (await last('status')).collisions;
  await browser.send('Browser.setWindowBounds', {windowId, bounds: {windowState: 'minimized'}});
  try {
    await browser.until(`document.visibilityState === 'hidden'`);
    await sleep(500);
    const before = await collisions();
    await sleep(2000);
    assert.equal(await collisions(), before);
  } finally {
    await browser.send('Browser.setWindowBounds', {windowId, bounds: {windowState: 'normal'}});
  }
  const before = await collisions();
  await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"status"')).pop()).collisions > ${before}`);
});

// ---- speed ----

// The least of several values, because other programs may use the machine.
async function least(count, measure) {
  const values = [];
  for (let turn = 0; turn < count; ++turn) values.push(await measure());
  return Math.min(...values);
}

test('the first gas moves soon after the files have arrived', async () => {
  const milliseconds = await least(3, async () => {
    await browser.open(`${server.address}?log#vibrated`,
                       `log.some((line) => { const e = JSON.parse(line); return e.event === 'status' && e.time > 0; })`);
    return browser.value(`performance.now() - Math.max(
        ...performance.getEntriesByType('resource').map((entry) => entry.responseEnd))`);
  });
  console.log(`  ${Math.round(milliseconds)} ms after the last file`);
  assert.ok(milliseconds < 2000);
});

// Runs a function, without the work of OpenGL. No task may take much processor time. The goal is
// 100 ms, and the processor of a test may be slow.
async function need_short_tasks(run) {
  const most = 200;
  await browser.without_drawing();
  const tasks = await browser.tasks(run);
  const longest = Math.max(...tasks.map((task) => task.processor));
  console.log(`  longest task ${Math.round(longest)} ms of the processor`);
  assert.ok(longest < most);
}

test('a large scene opens in slices, and can be cancelled', async () => {
  await open('cradle');
  const dense = 'vibrated&particles.count=100000&box.size=[340.0,400.0]';
  const go = (fragment) => browser.value(`void (location.hash = '${fragment}')`);
  await go(dense);
  await browser.until(`log.some((line) => line.includes('"opening.cancel"'))`);
  await click('opening.cancel');
  await browser.until(`log.some((line) => line.includes('"cancel"'))`);
  await sleep(500);
  const {time} = await last('status');
  await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"status"')).pop()).time > ${time}`);
  assert.equal((await last('status')).run, 1);
  await need_short_tasks(async () => {
    await go(dense + '&seed=2');
    await browser.until(`log.map((line) => JSON.parse(line)).some((event) =>
        event.event === 'status' && event.particles === 100000 && event.time > 0)`, 120);
  });
});

test('a large gas goes to other times, and looks ahead, in slices', async () => {
  await open('vibrated&particles.count=100000&box.size=[340.0,400.0]&view.speed=5');
  const status = (condition) => browser.until(
      `log.map((line) => JSON.parse(line)).filter((e) => e.event === 'status').slice(-1).find((e) => ${condition})`, 120);
  await status('e.collisions > 1000000');
  await press('Space', ' ');
  const head = await status('e.hash');
  await need_short_tasks(async () => {
    await press('Home', 'Home');
    await status('e.hash && e.time === 0');
    await press('End', 'End');
    await status(`e.hash === '${head.hash}'`);
    await press('Comma', ';', true);
    await status(`e.hash && e.time < ${head.time}`);
    const [x, y, width, height] = await place_of('viewport');
    for (let k = 0; k < 10 && ((await last('pick'))?.particle ?? null) === null; ++k) {
      await click_at(x + width / 2 + 7 * k, y + height / 2);
      await sleep(500);
    }
    assert.ok((await last('pick')).particle !== null);
    await sleep(1000);
  });
});

test('the gallery makes its pictures in slices', async () => {
  await open('cradle', '&until=0');
  await need_short_tasks(async () => {
    await click('gallery');
    await sleep(8000);
  });
});

test('the gallery opens, and its pictures appear', async () => {
  await open('cradle', '&until=0');
  await click('gallery');
  await browser.until('log.some((line) => line.includes(\'"gallery.vibrated"\'))');
  await sleep(8000);
  // Pictures of scenes have more colours than the list without them.
  const [x, y, , height] = await place_of('gallery.vibrated');
  const colours = await browser.value(`(() => {
    Module._clatter_draw();
    const gl = canvas.getContext('webgl2');
    const pixels = new Uint8Array(4 * 90 * 60);
    gl.readPixels(${Math.round(x)} + 5, canvas.height - ${Math.round(y + height)} + 5, 90, 60, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return new Set(new Uint32Array(pixels.buffer)).size;
  })()`);
  assert.ok(colours > 100, `${colours} colours`);
  await click('gallery.close');
  await browser.until(`JSON.parse(log.filter((line) => line.includes('"event":"gallery"')).pop()).open === false`);
});

test('10 000 disks need less than 33 ms per picture without the work of OpenGL', async () => {
  await open('vibrated&particles.count=10000&box.size=[120.0,150.0]');
  await browser.without_drawing();
  const milliseconds = await least(3, () => browser.value(`(() => {
    const pictures = 30;
    const began = performance.now();
    for (let k = 0; k < pictures; ++k) Module._clatter_draw();
    return (performance.now() - began) / pictures;
  })()`));
  console.log(`  ${milliseconds.toFixed(1)} ms per picture`);
  assert.ok(milliseconds < 33);
});

server = await serve(folder);
// A page that shows the gas of the same query and fragment in an iframe.
const frame = '<!DOCTYPE html><link rel="icon" href="data:,"><iframe width="640" height="480"></iframe><script>' +
    `document.querySelector('iframe').src = '${server.address}' + location.search + location.hash</script>`;
host = await serve(folder, {'/frame.html': frame});
browser = await Browser.start();
let failed = 0;
try {
  await browser.resize(1280, 720);
  for (const [name, run] of cases) {
    if (!name.includes(chosen)) continue;
    try {
      complaints();
      console.log(`ok: ${name}${await run() || ''}`);
    } catch (error) {
      ++failed;
      console.log(`FAILED: ${name}\n  ${error.stack}`);
    }
  }
} finally {
  await browser.stop();
  server.close();
  host.close();
  rmSync(scratch_folder, {recursive: true, force: true});
}
process.exitCode = failed ? 1 : 0;
