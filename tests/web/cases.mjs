// The cases of a test of the page, and the program that they compare it with.

import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

const cases = new Map();

/// Adds a case. Its function may return what it has skipped.
export const test = (name, run) => cases.set(name, run);

// Ends the test if a case does not end, long before ctest ends it.
function limit(name) {
  const minutes = 15;
  return setTimeout(() => {
    console.log(`FAILED: ${name}\n  it has not ended after ${minutes} minutes`);
    process.exit(1);
  }, minutes * 60000);
}

/// Runs the cases whose names contain `chosen`, each after `before`. Returns whether there are some,
/// and all succeed.
export async function run_cases(chosen, before) {
  const names = [...cases.keys()].filter((name) => name.includes(chosen));
  if (!names.length) console.log(`no case has "${chosen}" in its name`);
  let failed = 0;
  for (const name of names) {
    const timer = limit(name);
    const began = Date.now();
    try {
      await before();
      const skipped = await cases.get(name)() || '';
      console.log(`ok: ${name}${skipped} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
    } catch (error) {
      ++failed;
      console.log(`FAILED: ${name}\n  ${error.stack}`);
    }
    clearTimeout(timer);
  }
  return names.length > 0 && failed === 0;
}

const scratch_folder = mkdtempSync(join(tmpdir(), 'clatter-page-'));
process.on('exit', () => rmSync(scratch_folder, {recursive: true, force: true}));

/// A file that is removed at the end.
export const scratch = (name) => join(scratch_folder, name);

/// The program, if it was built.
export const program = ['release', 'ci'].map((build) => join(process.env.CLATTER_BUILD || '', build, 'clatter'))
    .find(existsSync);
export const has_ffmpeg = spawnSync('ffprobe', ['-version']).status === 0;

/// Runs a program, which must succeed.
export function execute(program, ...words) {
  const outcome = spawnSync(program, words, {encoding: 'utf8'});
  assert.equal(outcome.status, 0, `${program} ${words.join(' ')}: ${outcome.error || outcome.stderr}`);
  return outcome;
}

/// The state hash of a run by the program.
export function program_hash(scene, time, ...words) {
  const {stdout} = execute(program, 'measure', scene, '--until', `${time}`, '--seed', '1',
                           '--set', 'measure.burn_in=0.0', ...words);
  return JSON.parse(stdout).state_hash;
}

/// State hashes of `clatter measure SCENE --until TIME --seed 1`. The second scene is of spheres. The
/// third one uses logarithms, sines and cosines.
export const kHashes = [
  ['vibrated', 20, '5ca4f7af577a3f59'],
  ['spheres_vibrated', 2, 'afb45d9a721cd9d6'],
  ['rough_driven', 5, 'b964a16b1fee4b1a'],
];

/// Keeps the next downloads in the page instead: saved has [name, Blob].
export const keep_downloads = (tab) => tab.value(`void (window.saved = [], window.blob = null,
    URL.createObjectURL = (made) => { blob = made; return '#'; },
    HTMLAnchorElement.prototype.click = function () { saved.push([this.download, blob]); })`);

/// The name and the bytes of a kept download.
export async function saved_file(tab, number = 0) {
  const name = await tab.until(`saved[${number}]?.[0]`);
  const text = await tab.value(`new Promise((done) => {
    const reader = new FileReader();
    reader.onload = () => done(reader.result);
    reader.readAsDataURL(saved[${number}][1]);
  })`);
  return [name, Buffer.from(text.split(',')[1], 'base64')];
}

/// Drops files on the page, each [name, bytes]. As in a real drop, the list is empty after the event.
export const drop = (tab, ...files) => tab.value(`(() => {
  const data = new DataTransfer();
  for (const [name, text] of ${JSON.stringify(files.map(([name, bytes]) => [name, Buffer.from(bytes).toString('base64')]))}) {
    data.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
  }
  dispatchEvent(new DragEvent('drop', {dataTransfer: data, cancelable: true}));
  data.items.clear();
})()`);

/// The path of the first of these programs that is installed; undefined: none.
export const installed = (...programs) => programs.flatMap((program) =>
    process.env.PATH.split(':').map((path) => join(path, program))).find(existsSync);

/// Ends a test that cannot run.
export function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}
