// Tests of the page in one browser: node test_browsers.mjs FOLDER chromium|firefox|webkit [CASE]
// FOLDER has the page; CASE is a part of the names of the cases to run. Without the browser, or the
// display that it needs, all are skipped.

import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';
import {Browser, serve} from './browser.mjs';
import {drop, execute, has_ffmpeg, installed, keep_downloads, kHashes, program, run_cases, saved_file, scratch, skip,
  test} from './cases.mjs';
import {start} from './tab.mjs';
import {Firefox, WebKit} from './web_driver.mjs';

const [folder, name, chosen = ''] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));

const browsers = {
  chromium: {
    type: Browser, programs: ['chromium', 'chromium-browser'], package: 'chromium', records: true,
  },
  firefox: {
    type: Firefox, programs: ['firefox-esr', 'firefox'], package: 'firefox-esr', records: true, needs_display: true,
  },
  webkit: {
    type: WebKit, programs: ['WebKitWebDriver'], package: 'webkit2gtk-driver', records: false, needs_display: true,
  },
};

const {type, programs, package: wanted, records, needs_display} = browsers[name];
const found = installed(...programs) || skip(`the package ${wanted} is not installed`);
const display = needs_display && (installed('Xvfb') || skip('the package xvfb is not installed'));

let tab, server;

// A page that is watched, see watch.js.
const watched = readFileSync(join(folder, 'index.html'), 'utf8')
    .replace('<script', '<script src="watch.js"></script>\n<script');
const pages = {'/watched.html': watched, '/watch.js': readFileSync(join(here, 'watch.js'), 'utf8')};

const open = (...link) => tab.open_scene(`${server.address}watched.html`, ...link);

// The gas goes on, and the browser complains of nothing.
async function expect_alive() {
  const {time} = await tab.last('status');
  await tab.until_last('status', `e.time > ${time}`);
  assert.deepEqual(await tab.value('complaints'), []);
}

// A click on a control has a message with this text.
async function expect_message(control, text) {
  const before = (await tab.events('message')).length;
  await tab.click(control);
  await tab.until(`log.filter((line) => line.includes('"event":"message"')).slice(${before})
      .some((line) => JSON.parse(line).text.includes('${text}'))`);
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
  const [left, top, width, height] = await tab.place_of('viewport');
  const colours = [await tab.colours_in([left, top, width, height]), await tab.colours_in([0, top, left, height])];
  assert.ok(colours[0] > 100 && colours[1] > 100, `${colours} colours of the gas and of the panels`);
});

test('a film is recorded, or a message says why not, and the gas goes on', async () => {
  await open('vibrated', '&embed&controls=play,film');
  await keep_downloads(tab);
  await tab.click('film');
  await tab.until_last('message', '/Stop film|cannot record/.test(e.text)');
  await expect_alive();
  await tab.pictures(60);
  await tab.click('film');
  const refused = `log.filter((line) => line.includes('cannot record')).pop()`;
  const outcome = await tab.until(`saved.length ? 'saved' : ${refused}`);
  await expect_alive();
  assert.ok(outcome === 'saved' || !records, outcome);
  if (outcome !== 'saved') return `: ${JSON.parse(outcome).text}`;
  const [file, bytes] = await saved_file(tab);
  assert.ok(bytes.length > 0);
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

// The encoder ends while the gas is halted.
test('a film that the browser ends early is saved, with a message', async () => {
  const error = `this.onerror({error: new DOMException('the encoder failed', 'UnknownError')});`;
  for (const [failure, message] of [[error, 'the encoder failed'], ['', 'its encoder has stopped']]) {
    await open('vibrated', '&until=0&embed&controls=play,film');
    await keep_downloads(tab);
    await tab.value(`void (window.MediaRecorder = class {
      static isTypeSupported() { return true; }
      start() {
        this.state = 'recording';
        window.recorder = this;
      }
      break() {
        this.state = 'inactive';
        ${failure}
        this.ondataavailable({data: new Blob(['half a film'])});
        this.onstop();
      }
    })`);
    await tab.click('film');
    await tab.idle();
    await tab.value('recorder.break()');
    await tab.until_last('message', `e.text.includes('${message}')`);
    const [, bytes] = await saved_file(tab);
    assert.equal(String(bytes), 'half a film');
    await tab.click('play');
    await expect_alive();
  }
});

test('a finger drags a slider, and draws one picture at a time', async () => {
  await open('vibrated');
  const [x, y, width, height] = await tab.place_of('particles.restitution');
  const middle = y + height / 2;
  await tab.touch('touchStart', [x + 0.9 * width, middle]);
  for (const share of [0.8, 0.6, 0.4]) await tab.touch('touchMove', [x + share * width, middle]);
  await tab.touch('touchEnd');
  await tab.until_last('status', 'e.restitution < 0.7');
  const share = await tab.picture_share();
  assert.ok(share > 0.5 && share < 1.2, `${share}`);
  await expect_alive();
});

test('a finger picks the particle that it taps', async () => {
  await open('cradle', '&until=0');
  const [x, , width] = await tab.place_of('viewport');
  const [, row] = await tab.middle_of('wall.left');
  await tab.tap_at(x + 0.5 * width, row);
  const {particle} = await tab.until_last('pick', 'true');
  assert.ok(particle !== null);
  assert.deepEqual(await tab.value('complaints'), []);
});

test('buttons whose work the browser may refuse do it or give a message', async () => {
  await open('vibrated', '&embed&controls=screenshot,save,link,full_screen,sound');
  await tab.value(`void (
    URL.createObjectURL = () => { throw new Error('none'); },
    Object.defineProperty(navigator, 'clipboard', {value: undefined}),
    Element.prototype.requestFullscreen = undefined,
    window.AudioContext = class { constructor() { throw new Error('none'); } })`);
  for (const [control, message] of [
    ['screenshot', 'cannot save a file'], ['save', 'cannot save a file'], ['link', 'cannot copy'],
    ['full_screen', 'cannot fill the screen'], ['sound', 'cannot play sound'],
  ]) {
    await expect_message(control, message);
    await expect_alive();
  }
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

// The sounds after silence of 10 ms, each as a text. The last one may be cut, so it is left out.
function clicks_in(left, right) {
  const clicks = [];
  let silent = 0;
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
  await tab.until('scheduled > 10');
  await tab.click('sound');
  // The loudness forms in the first two seconds.
  const page = clicks_in(...(await tab.value('heard_samples()')).map((side) => side.slice(2 * 48000)));
  await expect_alive();
  if (!program) return ' (partly skipped: needs a build of the program)';
  execute(program, 'render', 'vibrated', ...set.flatMap(([key, value]) => ['--set', `${key}=${value}`]),
          '--seed', '1', '--sound', '--to', '20', '--fps', '5', '--size', '64x48', '--out', scratch('film/'));
  const wave = readFileSync(scratch('film/sound.wav'));
  const samples = new Int16Array(wave.buffer.slice(wave.byteOffset + wave.indexOf('data') + 8));
  const side = (number) => Array.from(samples.filter((level, k) => k % 2 === number));
  const film = new Set(clicks_in(side(0), side(1)));
  assert.equal(film.size, 2, 'the walls have one sound each');
  assert.deepEqual(new Set(page), film);
});

test('the loudspeaker of the browser plays the sound, or a message says why not', async () => {
  await open('vibrated', '&embed&controls=sound');
  await tab.click('sound');
  const outcome = await tab.until(`speaker.context.state === 'running' && speaker.end > 0 ? 'played'
      : log.filter((line) => /cannot play sound|plays no sound/.test(line)).pop()`);
  await tab.click('sound');
  assert.equal(await tab.value('speaker'), null);
  await expect_alive();
  return outcome === 'played' ? '' : `: ${JSON.parse(outcome).text}`;
});

test('a loudspeaker that fails is closed, with one message', async () => {
  for (const failing of ['resume', 'createBuffer']) {
    await open('vibrated', '&embed&controls=sound');
    await tab.value(`void (window.closed_contexts = 0, window.AudioContext = class {
      state = '${failing}' === 'resume' ? 'suspended' : 'running';
      currentTime = 0;
      ${failing}() { throw new Error('it is gone'); }
      close() { ++window.closed_contexts; }
    })`);
    await expect_message('sound', 'cannot play sound: Error: it is gone');
    await expect_alive();
    assert.equal(await tab.value('closed_contexts'), 1, failing);
    assert.equal(await tab.value('speaker'), null, failing);
    assert.equal((await tab.events('message')).length, 1, failing);
  }
});

// ---- files ----

test('a page from a file says that it needs a web server', async () => {
  await tab.open(`${pathToFileURL(resolve(folder, 'index.html'))}#vibrated`,
                 `document.getElementById('note').textContent.match(/web server/)`);
});

test('the page in one file works from a file, as from a server', async () => {
  const [scene, time, hash] = kHashes[0];
  execute('node', join(here, '../../app/web/make_single.mjs'), folder, scratch('clatter.html'));
  await tab.open(`${pathToFileURL(scratch('clatter.html'))}?log&until=${time}#${scene}&view.speed=100`);
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

const screen = display && await virtual_display();
if (screen) process.env.DISPLAY = screen.name;
server = await serve(folder, pages);
tab = await type.start(found);
try {
  await tab.resize(1024, 600, 0.5);
  process.exitCode = await run_cases(chosen, () => {}) ? 0 : 1;
} finally {
  await tab.stop();
  server.close();
  await screen?.close();
}
