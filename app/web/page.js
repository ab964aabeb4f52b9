// The page around the window of clatter: pictures, size, files and links. clatter.js runs the C++
// code, whose functions are in page.cpp. Positions are pixels of the device.
'use strict';

const canvas = document.getElementById('canvas');
const keys = document.getElementById('keys');
const note = document.getElementById('note');
const finger = matchMedia('(pointer: coarse)');
const query = new URLSearchParams(location.search);
const program = document.getElementById('program');  // of a page in one file: the WebAssembly as text
// Members of the window, which programs that drive a browser can read.
var log = [];       // lines of the script log, with ?log
var ready = false;  // the program has started
var asked = 0;      // the request for the next picture; 0: none, the page shows all it knows
var speaker = null; // open while there is sound
let over = false;   // the program cannot start, or has stopped

note.textContent = 'Loading …';

// ---- the end ----

// The first reason is the cause of later ones, which are not shown.
function end_with(reason) {
  if (!over) note.textContent = reason;
  over = true;
  ready = false;
  cancelAnimationFrame(asked);
  asked = 0;
}

function fail(what) {
  end_with(ready ? `The program stopped: ${what}. Reload the page to start again.`
                 : `The page could not be loaded: ${what}`);
}

// A page that cannot start says why.
function do_not_start(reason) {
  end_with(reason);
  Module.instantiateWasm = () => ({});
}

// ---- drawing: only while something moves, and never in a hidden tab ----

function draw() {
  if (!ready) return;
  cancelAnimationFrame(asked);
  asked = 0;
  try {
    if (Module._clatter_draw()) wake();
  } catch (error) {
    fail(error);
  }
}

function wake() {
  if (ready && !asked) asked = requestAnimationFrame(draw);
}

// ---- what the program asks of the page ----

function save(name, pieces) {
  const types = {png: 'image/png', csv: 'text/csv', toml: 'application/toml', mp4: 'video/mp4',
                 webm: 'video/webm'};
  const link = document.createElement('a');
  const type = types[name.split('.').pop()] || 'application/octet-stream';
  link.href = URL.createObjectURL(new Blob(pieces, {type}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

let film = null;  // the film that is recorded

// Shows a message in the window.
function tell(text) {
  queueMicrotask(() => {  // after the present call of the program
    if (!ready) return;
    text_of('clatter_tell', text);
    wake();
  });
}

// An exception would end the program in the middle of a picture. So what the program asks, and a
// browser may refuse, ends with a message or returns it.
const reason_of = (what, error) => `This browser cannot ${what}: ${error}`;

async function or_tell(what, call) {
  try {
    await call();
  } catch (error) {
    tell(reason_of(what, error));
  }
}

// The message; empty: the browser does it.
function or_reason(what, call) {
  try {
    call();
    return '';
  } catch (error) {
    return reason_of(what, error);
  }
}

function open_sound(rate) {
  const opened = new Speaker(rate);
  try {
    opened.resume();
  } catch (error) {
    opened.close();
    throw error;
  }
  speaker = opened;
}

function close_sound() {
  const closed = speaker;
  speaker = null;
  return closed.close();
}

async function end_film(name) {
  const ended = film;
  film = null;
  save(name, await ended.end());
}

var Module = {
  page: {
    scale: () => devicePixelRatio,
    // Fingers hit areas of 40 pixels of the page.
    target: () => finger.matches ? 40 * devicePixelRatio : 0,
    title: (text) => { document.title = text; },
    copy: (text) => { or_tell('copy a text', () => navigator.clipboard.writeText(text)); },
    fullScreen: () => {
      or_tell('fill the screen', () => document.fullscreenElement
          ? document.exitFullscreen() : document.documentElement.requestFullscreen());
    },
    deliver: (file) => { or_tell('save a file', () => save(file, [Module.FS.readFile(file)])); },
    beginFilm: (width, height) =>
        or_reason('record a film', () => { film = new Film(width, height); }),
    filmExtension: () => film.extension,
    film: (...place) => or_reason('continue the film', () => film.add(...place)),
    endFilm: (name) => { or_tell('record the film', () => end_film(name)); },
    openSound: (rate) => or_reason('play sound', () => open_sound(rate)),
    waitingSound: () => speaker.waiting(),
    playSound: (samples) => or_reason('play sound', () => speaker.play(samples)),
    closeSound: () => { or_tell('end the sound', close_sound); },
    link: (fragment) => location.href.split(/[?#]/)[0] + '#' + fragment,
  },
  print: (line) => { log.push(line); },
  printErr: (line) => { console.warn(line); },
  stdin: () => null,
  onAbort: (what) => fail(ready ? what : `clatter.wasm: ${what}`),
  onRuntimeInitialized: start,
};

function text_of(name, ...values) {
  const types = values.map((value) => typeof value === 'string' ? 'string' : 'number');
  return Module.ccall(name, 'string', types, values);
}

// ---- size ----

function resize() {
  const box = canvas.getBoundingClientRect();
  canvas.width = Math.max(1, Math.round(box.width * devicePixelRatio));
  canvas.height = Math.max(1, Math.round(box.height * devicePixelRatio));
  Module._clatter_resize(canvas.width, canvas.height);
  wake();
}

// ---- dropped scenes and pictures ----

// A scene and its start state are dropped together, in any order.
async function on_drop(event) {
  event.preventDefault();
  const largest = 20e6;  // bytes
  const paths = [];
  // The list is empty after the event.
  for (const file of [...event.dataTransfer.files]) {
    if (file.size > largest) {
      text_of('clatter_tell', `${file.name} is larger than 20 MB, the limit of a page. Use the program.`);
      continue;
    }
    const path = '/dropped/' + file.name.replace(/[^\w.-]/g, '_');
    await or_tell(`read ${file.name}`, async () => {
      Module.FS.writeFile(path, new Uint8Array(await file.arrayBuffer()));
      paths.push(path);
    });
  }
  const scenes = paths.filter((path) => !path.endsWith('.csv'));
  for (const path of scenes.length ? scenes : paths) text_of('clatter_drop', path);
  wake();
}

// ---- start ----

function fragment() {
  return location.hash.slice(1);
}

// Simulation time at which the gas pauses; NaN: none.
function until() {
  if (query.has('until')) return Number(query.get('until'));
  return matchMedia('(prefers-reduced-motion: reduce)').matches ? 0 : NaN;
}

function start() {
  // A style may be missing before this script can hear of it.
  if (getComputedStyle(canvas).touchAction !== 'none') return fail('page.css is missing');
  Module.FS.mkdir('/dropped');
  const failure = text_of('clatter_start', fragment(), until(), +query.has('log'));
  if (failure) return end_with(failure);
  if (query.has('embed')) text_of('clatter_embed', query.get('controls') || '');
  resize();
  new ResizeObserver(resize).observe(canvas);
  for (const kind of ['pointerdown', 'pointermove', 'pointerup', 'pointercancel']) {
    canvas.addEventListener(kind, on_pointer);
  }
  canvas.addEventListener('wheel', on_wheel, {passive: false});
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  keys.addEventListener('input', on_input);
  for (const kind of ['pointerup', 'keydown']) addEventListener(kind, () => speaker?.resume());
  addEventListener('keydown', on_key);
  addEventListener('keyup', on_key);
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', on_drop);
  addEventListener('hashchange', () => {
    text_of('clatter_open', fragment(), until());
    wake();
  });
  // The browser asks before it leaves a page with unsaved changes. An embedded gas has no files.
  addEventListener('beforeunload', (event) => {
    if (ready && !query.has('embed') && Module._clatter_unsaved()) event.preventDefault();
  });
  canvas.addEventListener('webglcontextlost', () => {
    end_with('The graphics of this page were lost. Reload it to start again.');
  });
  canvas.focus();
  ready = true;
  note.textContent = '';
  wake();
}

// A part that is missing, or an exception before the start.
function on_error(event) {
  const part = event.target.src || event.target.href;
  if (part) do_not_start(`The page could not be loaded: ${part} is missing`);
  else if (!ready) fail(event.reason || event.message);
}
addEventListener('error', on_error, true);
addEventListener('unhandledrejection', on_error);

// Vectors of WebAssembly: a module with the instruction v128.const.
const with_vectors = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1,
  0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]);
if (typeof WebAssembly !== 'object' || !WebAssembly.validate(with_vectors)) {
  do_not_start('This browser has no vectors of WebAssembly. Browsers of 2023 and later have.');
} else if (program) {
  // Emscripten 6 no longer takes the bytes as Module.wasmBinary.
  const bytes = Uint8Array.from(atob(program.textContent), (sign) => sign.charCodeAt(0));
  Module.instantiateWasm = (imports, done) => {
    WebAssembly.instantiate(bytes, imports).then(({instance, module}) => done(instance, module));
    return {};
  };
} else if (location.protocol === 'file:') {
  do_not_start('Browsers load the parts of this page only from a web server. The page in one file, which ' +
      './run web --single makes, needs none.');
}
