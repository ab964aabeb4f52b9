// Cases of test_page.mjs: embedded gases, and files that are dropped and saved.

import assert from 'node:assert/strict';
import {writeFileSync} from 'node:fs';
import {drop, execute, has_ffmpeg, keep_downloads, program, program_hash, saved_file, scratch, test}
  from './cases.mjs';
import {browser, drag, host, open, scroll_to, server, take_complaints, usual_size} from './in_chromium.mjs';

// ---- embedded ----

test('an embedded gas has its chosen controls alone, in an iframe of another origin', async () => {
  const controls = 'play,sound,particles.restitution,walls.left.drive_speed';
  await browser.open(`${host.address}frame.html?embed&log&controls=${controls}#vibrated`,
                     `document.querySelector('iframe')?.contentDocument === null`);
  const inside = await browser.iframe(new URL(server.address).origin);
  const pictures = `log.filter((line) => line.includes('"event":"picture"')).length`;
  await browser.until(`document.title.includes('Vibrated') && ${pictures} > 20`, inside);
  const names = await browser.value(
      `log.map((line) => JSON.parse(line)).filter((event) => event.event === 'widget')
      .map((event) => event.name)`, inside);
  for (const name of controls.split(',')) assert.ok(names.includes(name), `no ${name}`);
  for (const name of ['gallery', 'reset', 'particles.count', 'walls.right.drive_speed']) {
    assert.ok(!names.includes(name), name);
  }
  assert.deepEqual(take_complaints(), []);
});

test('an unknown control of an embedded gas is named with a suggestion', async () => {
  await open('vibrated', '&embed&controls=particles.restitutoin');
  const {text} = await browser.until_last('message', 'true');
  assert.match(text, /restitutoin.*"particles.restitution"/s);
});

test('an embedded gas without controls has the picture of the program', async () => {
  if (!program || !has_ffmpeg) return ' (skipped: needs a build of the program, and ffmpeg)';
  await browser.resize(960, 720);
  try {
    await open('vibrated', '&embed&until=3');
    await browser.halted_where('e.time === 3');
    await browser.idle();
    writeFileSync(scratch('page.png'), await browser.picture());
  } finally {
    await usual_size();
  }
  execute(program, 'render', 'vibrated', '--from', '3', '--size', '960x720', '--out', scratch('program.png'), '--overwrite');
  const {stderr} = execute('ffmpeg', '-i', scratch('page.png'), '-i', scratch('program.png'),
                           '-lavfi', 'ssim', '-f', 'null', '-');
  const likeness = Number(/All:([\d.]+)/.exec(stderr)[1]);
  console.log(`  SSIM ${likeness}`);
  assert.ok(likeness >= 0.98, `SSIM ${likeness}`);
});

// ---- files ----

test('a film shows the gas at the time of its pictures', async () => {
  if (!has_ffmpeg) return ' (skipped: needs ffmpeg)';
  await open('vibrated&view.speed=3');
  await keep_downloads(browser);
  await browser.value(`void (globalThis.filmed = [], globalThis.added = Film.prototype.add,
      Film.prototype.add = function (...place) { filmed.push(performance.now()); return added.apply(this, place); })`);
  await scroll_to('film');
  await browser.click('film');
  await browser.until('filmed.length > 60');
  await browser.click('film');
  const [name, bytes] = await saved_file(browser);
  assert.match(name, /^clatter-1\.(mp4|webm)$/);
  writeFileSync(scratch(name), bytes);
  const probe = execute('ffprobe', '-v', 'error', '-count_packets', '-select_streams', 'v', '-show_entries',
                        'stream=codec_name,width,height,nb_read_packets', '-of', 'json', scratch(name));
  const [stream] = JSON.parse(probe.stdout).streams;
  const scale = await browser.value('devicePixelRatio');
  const [width, height] = (await browser.place_of('viewport')).slice(2).map((length) => scale * length);
  assert.ok(Math.abs(stream.width - width) <= 2 && Math.abs(stream.height - height) <= 2);
  // An encoder that is late leaves out pictures.
  assert.ok(stream.nb_read_packets >= 5, `${stream.nb_read_packets} frames`);
  const times = execute('ffprobe', '-v', 'error', '-select_streams', 'v', '-show_entries', 'packet=pts_time',
                        '-of', 'csv=p=0', scratch(name)).stdout.split('\n').map(parseFloat).filter(isFinite);
  const length = Math.max(...times) - Math.min(...times);
  const span = await browser.value('(filmed.at(-1) - filmed[0]) / 1000');
  assert.ok(length > 0.5 * span && length < 1.5 * span, `${length} s of ${span} s`);
  execute('ffmpeg', '-v', 'error', '-y', '-sseof', '-1', '-i', scratch(name), '-frames:v', '1', scratch('film.png'));
  const {stderr} = execute('ffmpeg', '-i', scratch('film.png'), '-vf', 'signalstats,metadata=print', '-f', 'null', '-');
  const value = (key) => Number(new RegExp(`${key}=([\\d.]+)`).exec(stderr)[1]);
  console.log(`  ${name}: ${stream.codec_name}, ${stream.nb_read_packets} frames in ${length} s, ${bytes.length} bytes`);
  assert.ok(value('YMAX') - value('YMIN') > 100, 'the frame has no contrast');
});

test('a dropped scene opens, and so does a dropped picture', async () => {
  await open('cradle');
  await drop(browser, ['own.toml', 'title = "Own"\nbox.size = [12.0, 9.0]\nparticles.count = 17\n']);
  await browser.until_last('status', 'e.particles === 17');
  assert.equal((await browser.last('open')).title, 'Own');
  await keep_downloads(browser);
  await scroll_to('screenshot');
  await browser.click('screenshot');
  const [name, picture] = await saved_file(browser);
  assert.match(name, /\.png$/);
  await open('cradle');
  await drop(browser, [name, picture]);
  await browser.until_last('status', 'e.particles === 17');
  assert.equal((await browser.last('open')).title, 'Own');
});

test('a saved scene with a start state is two files, which the page and the program open again', async () => {
  const ctrl = 2, shift = 8;
  await open('vibrated', '&until=1');
  await browser.halted_where('e.time === 1');
  await keep_downloads(browser);
  await drag('box.size.x', 0.6);  // the gas adapts and is the start of another scene
  const start = await browser.halted_where('e.time === 0');
  await browser.press('KeyS', 's', ctrl);
  const files = [await saved_file(browser, 0), await saved_file(browser, 1)];
  assert.deepEqual(files.map(([name]) => name), ['clatter-1.csv', 'clatter-1.toml']);
  await open('cradle', '&until=0');
  await drop(browser, ...files);
  await browser.until_last('status', 'e.particles > 10');
  await browser.press('Space', ' ');
  await browser.press('Home', 'Home');
  assert.equal((await browser.halted_where('e.particles > 10 && e.time === 0')).hash, start.hash);
  await browser.press('Period', ':', shift);
  const stepped = await browser.halted_where('e.particles > 10 && e.collisions === 1');
  if (!program) return ' (partly skipped: needs a build of the program)';
  for (const [name, bytes] of files) writeFileSync(scratch(name), bytes);
  assert.equal(program_hash(scratch('clatter-1.toml'), stepped.time), stepped.hash);
});

test('a dropped file that is too large gives a message, and so does one that cannot be read', async () => {
  await open('cradle');
  await drop(browser, ['large.csv', Buffer.alloc(20e6 + 1)]);
  await browser.until_last('message', 'e.text.includes("large.csv is larger than 20 MB")');
  await browser.value(`void (File.prototype.arrayBuffer = () => Promise.reject(new Error('it is gone')))`);
  await drop(browser, ['gone.toml', '']);
  await browser.until_last('message', 'e.text.includes("gone.toml") && e.text.includes("it is gone")');
});
