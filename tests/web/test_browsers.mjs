// Tests of the page in one browser: node test_browsers.mjs FOLDER chromium|firefox|webkit [CASE]
// FOLDER has the page; CASE is a part of the names of the cases to run. Without the browser, or
// without a display for it, all are skipped.

import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {Browser, serve} from './browser.mjs';
import {drop, execute, has_ffmpeg, installed, keep_downloads, program, run_cases, saved_file, scratch, skip, test}
  from './cases.mjs';
import {start} from './tab.mjs';
import {Firefox, WebKit} from './web_driver.mjs';

const [folder, name, chosen = ''] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));

const browsers = {
  chromium: {type: Browser, programs: ['chromium', 'chromium-browser'], package: 'chromium'},
  firefox: {type: Firefox, programs: ['firefox-esr', 'firefox'], package: 'firefox-esr'},
  webkit: {type: WebKit, programs: ['WebKitWebDriver'], package: 'webkit2gtk-driver'},
};

const {type, programs, package: wanted} = browsers[name];
const found = installed(...programs) || skip(`the package ${wanted} is not installed`);
const display = installed('Xvfb') || skip('the package xvfb is not installed');

// Of `clatter measure SCENE --until TIME --seed 1`.
const kHashes = [['vibrated', 20, '5ca4f7af577a3f59'], ['spheres_vibrated', 2, 'afb45d9a721cd9d6']];

let tab, server;

// A page that is watched, see watch.js.
const watched = readFileSync(join(folder, 'index.html'), 'utf8')
    .replace('<script', '<script src="watch.js"></script>\n<script');
const pages = {'/watched.html': watched, '/watch.js': readFileSync(join(here, 'watch.js'), 'utf8')};

async function open(fragment, query = '') {
  await tab.open(`${server.address}watched.html?log${query}#${fragment}`);
  await tab.until_last('status', 'true');
}

// The gas goes on, and the browser complains of nothing.
async function expect_alive() {
  const {time} = await tab.last('status');
  await tab.until_last('status', `e.time > ${time}`);
  assert.deepEqual(await tab.value('complaints'), []);
}

test('the gas has the state of native builds', async () => {
  for (const [scene, time, hash] of kHashes) {
    await open(`${scene}&view.speed=100`, `&until=${time}`);
    assert.equal((await tab.halted_where(`e.time === ${time}`)).hash, hash, scene);
    assert.deepEqual(await tab.value('complaints'), []);
  }
});

test('the picture has the gas and its panels', async () => {
  await open('vibrated', '&until=1');
  await tab.halted_where('e.time === 1');
  await tab.idle();
  writeFileSync(scratch('page.png'), await tab.picture());
  if (process.env.CLATTER_PICTURES) {
    writeFileSync(join(process.env.CLATTER_PICTURES, `${name}.png`), await tab.picture());
  }
  if (!has_ffmpeg) return ' (partly skipped: needs ffmpeg)';
  const {stderr} = execute('ffmpeg', '-i', scratch('page.png'), '-vf', 'signalstats,metadata=print', '-f', 'null', '-');
  const value = (key) => Number(new RegExp(`${key}=([\\d.]+)`).exec(stderr)[1]);
  assert.ok(value('YMAX') - value('YMIN') > 100, 'the picture has no contrast');
});

test('a film is recorded, or a message says why not, and the gas goes on', async () => {
  await open('vibrated', '&embed&controls=play,film');
  await keep_downloads(tab);
  await tab.click('film');
  await tab.until_last('message', '/Stop film|cannot record/.test(e.text)');
  await expect_alive();
  await tab.pictures(60);
  await tab.click('film');
  const refusal = `log.filter((line) => line.includes('cannot record')).pop()`;
  const outcome = await tab.until(`saved.length ? 'saved' : ${refusal}`);
  await expect_alive();
  if (outcome !== 'saved') return `: ${JSON.parse(outcome).text}`;
  const [file, bytes] = await saved_file(tab);
  if (!has_ffmpeg) return ' (partly skipped: needs ffmpeg)';
  writeFileSync(scratch(file), bytes);
  const frames = execute('ffprobe', '-v', 'error', '-count_frames', '-select_streams', 'v', '-show_entries',
                         'stream=nb_read_frames', '-of', 'csv=p=0', scratch(file)).stdout;
  console.log(`  ${file}: ${parseInt(frames)} frames, ${bytes.length} bytes`);
  assert.ok(parseInt(frames) >= 5, frames);
});

// What a browser without encoders, with broken ones, or without the functions does.
test('a browser that cannot record says so, and the gas goes on', async () => {
  for (const broken of [
    'window.MediaRecorder = undefined',
    'MediaRecorder.isTypeSupported = () => false',
    `window.MediaRecorder = class { static isTypeSupported() { return true; }
        constructor() { throw new DOMException('no encoder', 'NotSupportedError'); } }`,
    'HTMLCanvasElement.prototype.captureStream = undefined',
  ]) {
    await open('vibrated', '&embed&controls=film');
    await tab.value(`void (${broken})`);
    await tab.click('film');
    await tab.until_last('message', 'e.text.includes("cannot record")');
    await expect_alive();
  }
});

test('a film that the browser ends early is saved, with a message', async () => {
  await open('vibrated', '&embed&controls=film');
  await keep_downloads(tab);
  await tab.value(`void (window.MediaRecorder = class {
    static isTypeSupported() { return true; }
    start() { this.state = 'recording'; setTimeout(() => {
      this.state = 'inactive';
      this.onerror({error: new DOMException('the encoder failed', 'UnknownError')});
      this.ondataavailable({data: new Blob(['half a film'])});
      this.onstop();
    }); }
  })`);
  await tab.click('film');
  await tab.until_last('message', 'e.text.includes("the encoder failed")');
  const [, bytes] = await saved_file(tab);
  assert.equal(String(bytes), 'half a film');
  await expect_alive();
});

test('a finger drags a slider, and draws one picture at a time', async () => {
  await open('vibrated');
  const [x, y, width, height] = await tab.place_of('particles.restitution');
  const middle = y + height / 2;
  await tab.touch('touchStart', [x + 0.9 * width, middle]);
  for (const share of [0.8, 0.6, 0.4]) await tab.touch('touchMove', [x + share * width, middle]);
  await tab.touch('touchEnd');
  await tab.until_last('status', 'e.restitution < 0.7');
  // Pictures of the page per picture of the browser.
  const share = await tab.value(`new Promise((done) => {
    const drawn = () => log.filter((line) => line.includes('"event":"picture"')).length;
    const before = drawn(), pictures = 30;
    let left = pictures;
    (function next() { if (left--) requestAnimationFrame(next); else done((drawn() - before) / pictures); })();
  })`);
  assert.ok(share > 0.5 && share < 1.2, `${share}`);
  await expect_alive();
});

test('a finger picks the particle that it taps', async () => {
  await open('cradle', '&until=0');
  const [x, y, width, height] = await tab.place_of('viewport');
  await tab.tap_at(x + 0.5 * width, y + 0.5 * height);
  const {particle} = await tab.until_last('pick', 'true');
  assert.ok(particle !== null);
  assert.deepEqual(await tab.value('complaints'), []);
});

test('buttons whose work the browser may refuse do it or give a message', async () => {
  await open('vibrated', '&embed&controls=play,screenshot,save,film,link,full_screen,sound');
  await keep_downloads(tab);
  await tab.value(`void Object.defineProperty(navigator, 'clipboard', {value: undefined})`);
  await tab.value('void (Element.prototype.requestFullscreen = undefined)');
  for (const [control, message] of [['link', 'cannot copy'], ['full_screen', 'cannot fill the screen']]) {
    await tab.click(control);
    await tab.until_last('message', `e.text.includes('${message}')`);
    await expect_alive();
  }
  await tab.value('void (window.AudioContext = class { constructor() { throw new Error("none"); } })');
  await tab.click('sound');
  await tab.until_last('message', `e.text.includes('cannot play sound')`);
  await expect_alive();
});

test('a mistake in a link or in a dropped scene gives a message', async () => {
  await open('vibrated&particles.restitutoin=0.6');
  await tab.until_last('message', 'e.text.includes("restitutoin")');
  await drop(tab, ['wrong.toml', 'box.size = "wide"']);
  await tab.until_last('message', 'e.text.includes("box.size")');
  await expect_alive();
});

// ---- sound ----

// A disk that flies between two walls: all its clicks have the same impulse and energy.
const kBouncing = {
  'particles.count': '1', 'particles.restitution': '1.0', 'box.size': '[3.0,3.0]', 'view.speed': '4.0',
  'walls': '{left={kind="static"},right={kind="static"}}',
};

// The sounds that silence of 10 ms separates: [left, right] in which each is a list. The last one may
// be cut, so it is left out.
function clicks_in(left, right) {
  const clicks = [];
  let silent = 480;
  for (let k = 0; k < left.length; ++k) {
    const silence = left[k] === 0 && right[k] === 0;
    if (!silence && silent >= 480) clicks.push([[], []]);
    silent = silence ? silent + 1 : 0;
    if (clicks.length) {
      clicks.at(-1)[0].push(left[k]);
      clicks.at(-1)[1].push(right[k]);
    }
  }
  const trimmed = (levels) => levels.slice(0, 1 + levels.findLastIndex((level) => level !== 0)).join();
  return clicks.slice(0, -1).map((click) => click.map(trimmed).join('|'));
}

test('the sound is that of films of the program', async () => {
  const set = Object.entries(kBouncing);
  await open('vibrated&seed=1&' + set.map(([key, value]) => `${key}=${encodeURIComponent(value)}`).join('&'),
             '&heard&embed&controls=sound');
  await tab.click('sound');
  await tab.until('scheduled > 15');
  await tab.click('sound');
  const page = clicks_in(...await tab.value('heard_samples()'));
  await expect_alive();
  if (!program) return ' (partly skipped: needs a build of the program)';
  execute(program, 'render', 'vibrated', ...set.flatMap(([key, value]) => ['--set', `${key}=${value}`]),
          '--seed', '1', '--sound', '--to', '20', '--fps', '5', '--size', '64x48', '--out', scratch('film/'));
  const wave = readFileSync(scratch('film/sound.wav'));
  const samples = new Int16Array(wave.buffer.slice(wave.byteOffset + wave.indexOf('data') + 8));
  const side = (number) => Array.from(samples.filter((level, k) => k % 2 === number));
  const film = new Set(clicks_in(side(0), side(1)));
  assert.equal(film.size, 2, 'the walls have one sound each');
  // A picture that is very late cuts a sound.
  const whole = page.filter((click) => film.has(click));
  assert.ok(whole.length > page.length / 2, `${whole.length} of ${page.length} clicks are those of the film`);
  assert.deepEqual(new Set(whole), film);
});

// ---- files ----

test('a page from a file says that it needs a web server', async () => {
  await tab.open(`file://${folder}/index.html#vibrated`,
                 `document.getElementById('note').textContent.match(/web server/)`);
});

test('the page in one file works from a file, as from a server', async () => {
  const [scene, time, hash] = kHashes[0];
  execute('node', join(here, '../../app/web/make_single.mjs'), folder, scratch('clatter.html'));
  await tab.open(`file://${scratch('clatter.html')}?log&until=${time}#${scene}&view.speed=100`);
  assert.equal((await tab.halted_where(`e.time === ${time}`)).hash, hash);
  assert.equal(await tab.value(`performance.getEntriesByType('resource').length`), 0);
});

// The number of a display without a screen, which its program writes to the file 3.
async function virtual_display() {
  const server = start(display, ['-displayfd', '3', '-screen', '0', '1400x900x24', '-nolisten', 'tcp'],
                       ['ignore', 'ignore', 'ignore', 'pipe']);
  let number = '';
  for await (const piece of server.stdio[3]) {
    number += piece;
    if (number.endsWith('\n')) break;
  }
  return {name: `:${parseInt(number)}`, close: server.end};
}

const screen = await virtual_display();
process.env.DISPLAY = screen.name;
server = await serve(folder, pages);
tab = await type.start(found);
try {
  await tab.resize(1280, 720);
  process.exitCode = await run_cases(chosen, () => {}) ? 0 : 1;
} finally {
  await tab.stop();
  server.close();
  await screen.close();
}
