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

// ---- drawing: only while something moves, and never in a hidden tab ----

function draw() {
  cancelAnimationFrame(asked);
  asked = 0;
  let moves = false;
  try {
    moves = Module._clatter_draw() !== 0;
  } catch (error) {
    ready = false;
    note.textContent = 'The program stopped: ' + error + '. Reload the page to start again.';
    return;
  }
  if (moves) wake();
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

let film = null;     // the film that is recorded
let speaker = null;  // open while there is sound

// Shows a message: in the window, or in its place before it has started.
function complain(text) {
  queueMicrotask(() => {  // after the present call of the program
    if (ready) text_of('clatter_tell', text);
    else note.textContent = text;
    wake();
  });
}

// An exception would end the program in the middle of a picture. So what the program asks, and a
// browser may refuse, ends with a message or returns it.
const refusal_of = (what, error) => `This browser cannot ${what}: ${error}`;

async function attempt(what, call) {
  try {
    await call();
  } catch (error) {
    complain(refusal_of(what, error));
  }
}

// The message; empty: the browser does it.
function refusal(what, call) {
  try {
    call();
    return '';
  } catch (error) {
    return refusal_of(what, error);
  }
}

function open_sound(rate) {
  speaker = new Speaker(rate);
  speaker.resume();
  const patience = 2000;  // milliseconds
  setTimeout(() => {
    if (speaker && !speaker.plays()) complain('The browser plays no sound. Click the page once more, or check its settings.');
  }, patience);
}

function close_sound() {
  const {context} = speaker;
  speaker = null;
  return context.close();
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
    copy: (text) => { attempt('copy a text', () => navigator.clipboard.writeText(text)); },
    fullScreen: () => {
      attempt('fill the screen', () => document.fullscreenElement
          ? document.exitFullscreen() : document.documentElement.requestFullscreen());
    },
    deliver: (file) => { attempt('save a file', () => save(file, [Module.FS.readFile(file)])); },
    beginFilm: (width, height) =>
        refusal('record a film', () => { film = new Film(width, height); }),
    filmExtension: () => film.extension,
    film: (...place) => refusal('continue the film', () => film.add(...place)),
    endFilm: (name) => { attempt('record the film', () => end_film(name)); },
    openSound: (rate) => refusal('play sound', () => open_sound(rate)),
    waitingSound: () => speaker.waiting(),
    playSound: (samples) => { attempt('play sound', () => speaker.play(samples)); },
    closeSound: () => { attempt('end the sound', close_sound); },
    link: (fragment) => location.href.split(/[?#]/)[0] + '#' + fragment,
  },
  print: (line) => { log.push(line); },
  printErr: (line) => { console.warn(line); },
  stdin: () => null,
  onAbort: (what) => {
    note.textContent = `${ready ? 'The program stopped' : 'The page could not be loaded'}: ${what}`;
  },
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
  for (const file of event.dataTransfer.files) {
    if (file.size > largest) {
      text_of('clatter_tell', `${file.name} is larger than 20 MB, the limit of a page. Use the program.`);
      continue;
    }
    const path = '/dropped/' + file.name.replace(/[^\w.-]/g, '_');
    await attempt(`read ${file.name}`, async () => {
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
  Module.FS.mkdir('/dropped');
  const failure = text_of('clatter_start', fragment(), until(), +query.has('log'));
  if (failure) {
    note.textContent = failure;
    return;
  }
  if (query.has('embed')) text_of('clatter_embed', query.get('controls') || '');
  ready = true;
  note.textContent = '';
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
    ready = false;
    note.textContent = 'The graphics of this page were lost. Reload it to start again.';
  });
  canvas.focus();
}

// A page that cannot start says why.
function refuse(reason) {
  note.textContent = reason;
  Module.instantiateWasm = () => ({});
}

function on_missing(event) {
  const what = event.reason || event.message || `${event.target.src || event.target.href} is missing`;
  if (!ready) note.textContent = `The page could not be loaded: ${what}`;
}
addEventListener('error', on_missing, true);
addEventListener('unhandledrejection', on_missing);

// Vectors of WebAssembly: a module with the instruction v128.const.
const with_vectors = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1,
  0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]);
if (typeof WebAssembly !== 'object' || !WebAssembly.validate(with_vectors)) {
  refuse('This browser has no vectors of WebAssembly. Browsers of 2023 and later have.');
} else if (program) {
  Module.wasmBinary = Uint8Array.from(atob(program.textContent), (sign) => sign.charCodeAt(0));
} else if (location.protocol === 'file:') {
  refuse('Browsers load the parts of this page only from a web server. The page in one file, which ' +
      './run web --single makes, needs none.');
}
