// The page around the window of clatter: input, size, files and links. clatter.js runs the C++ code,
// whose functions are in page.cpp. Positions are pixels of the device.
'use strict';

const canvas = document.getElementById('canvas');
const keys = document.getElementById('keys');
const note = document.getElementById('note');
const finger = matchMedia('(pointer: coarse)');
const query = new URLSearchParams(location.search);
const log = [];  // lines of the script log, with ?log

// ---- drawing: only while something moves, and never in a hidden tab ----

let ready = false;
let asked = 0;

function draw() {
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

// ---- films: the part of the canvas with the gas, by the encoders of the browser ----

const film_types = ['video/mp4;codecs=avc1.64002A', 'video/webm;codecs=vp9', 'video/webm', 'video/mp4'];
const film_type = typeof MediaRecorder === 'function'
    ? film_types.find((type) => MediaRecorder.isTypeSupported(type)) : undefined;
let film = null;  // the film that is recorded

class Film {
  constructor(width, height) {
    const longest = 1920, bits_per_pixel = 6, even = (length) => 2 * Math.round(length / 2);
    const scale = Math.min(1, longest / Math.max(width, height));
    this.sheet = document.createElement('canvas');
    this.sheet.width = even(scale * width);
    this.sheet.height = even(scale * height);
    this.pen = this.sheet.getContext('2d', {alpha: false});
    const stream = this.sheet.captureStream(0);  // takes a frame when asked
    this.track = stream.getVideoTracks()[0];
    this.recorder = new MediaRecorder(stream, {
      mimeType: film_type, videoBitsPerSecond: bits_per_pixel * this.sheet.width * this.sheet.height});
    this.pieces = [];
    this.recorder.ondataavailable = (event) => { this.pieces.push(event.data); };
    this.recorder.start();
  }

  add(x, y, width, height) {
    const {sheet, pen} = this;
    const scale = Math.min(sheet.width / width, sheet.height / height);
    const [wide, tall] = [scale * width, scale * height];
    pen.clearRect(0, 0, sheet.width, sheet.height);
    pen.drawImage(canvas, x, y, width, height, (sheet.width - wide) / 2, (sheet.height - tall) / 2,
                  wide, tall);
    this.track.requestFrame();
  }

  end(name) {
    this.recorder.onstop = () => save(name, this.pieces);
    this.recorder.stop();
  }
}

var Module = {
  page: {
    scale: () => devicePixelRatio,
    // Fingers hit areas of 40 pixels of the page.
    target: () => finger.matches ? 40 * devicePixelRatio : 0,
    title: (text) => { document.title = text; },
    copy: (text) => { navigator.clipboard?.writeText(text).catch(() => {}); },
    fullScreen: () => {
      if (document.fullscreenElement) document.exitFullscreen();
      else document.documentElement.requestFullscreen?.().catch(() => {});
    },
    deliver: (file) => save(file, [Module.FS.readFile(file)]),
    filmExtension: () => film_type ? '.' + film_type.split(/[/;]/)[1] : '',
    beginFilm: (width, height) => { film = new Film(width, height); },
    film: (x, y, width, height) => film?.add(x, y, width, height),
    endFilm: (name) => { film.end(name); film = null; },
    link: (fragment) => location.href.split(/[?#]/)[0] + '#' + fragment,
  },
  print: (line) => { log.push(line); },
  printErr: (line) => { console.warn(line); },
  stdin: () => null,
  onAbort: (what) => { note.textContent = 'The program stopped: ' + what; },
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

// ---- pointers: mouse, pen and touch ----

// One finger is the left button of the mouse, except that it scrolls panels along y. Two fingers
// move and zoom the view.
const fingers = new Map();
let pinch = null;  // middle and distance of two fingers
let touch = null;  // the only finger on a panel: its place at the start, and what it does

function point(x, y, buttons, wheel = 0) {
  Module._clatter_point(x * devicePixelRatio, y * devicePixelRatio, buttons, wheel);
  wake();
}

function place(x, y) {
  Module._clatter_place(x * devicePixelRatio, y * devicePixelRatio);
}

function scroll(x, y, way) {
  Module._clatter_scroll(x * devicePixelRatio, y * devicePixelRatio, way * devicePixelRatio);
  wake();
}

function pinched() {
  const [a, b] = [...fingers.values()];
  return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y)};
}

function use_pinch() {
  const now = pinched();
  const right = 2;
  if (!pinch) place(now.x, now.y);
  // A zoom step of the wheel is a factor of .85.
  const wheel = pinch ? Math.log(now.apart / pinch.apart) / -Math.log(0.85) : 0;
  point(now.x, now.y, right, wheel);
  pinch = now;
}

function put_finger(x, y) {
  const on_gas = Module._clatter_shows_gas(x * devicePixelRatio, y * devicePixelRatio);
  touch = {x, y, last: y, does: on_gas ? 'press' : 'nothing yet'};
  place(x, y);
  point(x, y, on_gas ? 1 : 0);
}

function move_finger(x, y) {
  const slack = 8;
  const [right, down] = [Math.abs(x - touch.x), Math.abs(y - touch.y)];
  if (touch.does === 'nothing yet' && Math.max(right, down) > slack) {
    touch.does = down > right ? 'scroll' : 'press';
  }
  if (touch.does === 'press') point(x, y, 1);
  if (touch.does === 'scroll') {
    scroll(touch.x, touch.y, y - touch.last);
    touch.last = y;
  }
}

function lift_finger(x, y) {
  if (touch.does === 'nothing yet') point(x, y, 1);
  point(x, y, 0);
  touch = null;
  show_keyboard();
}

function on_touch(event) {
  const {clientX: x, clientY: y, pointerId: id} = event;
  const begins = event.type === 'pointerdown';
  const held = begins || fingers.has(id);
  const moves = event.type === 'pointermove';
  if (!held) return;
  if (begins || moves) fingers.set(id, {x, y});
  else fingers.delete(id);
  if (fingers.size === 2) {
    touch = null;
    use_pinch();
    return;
  }
  if (pinch) point(pinch.x, pinch.y, 0);
  pinch = null;
  if (begins && fingers.size === 1) put_finger(x, y);
  else if (moves && touch) move_finger(x, y);
  else if (touch) lift_finger(x, y);
  if (fingers.size === 0) Module._clatter_lift();
}

function on_pointer(event) {
  if (event.type === 'pointerdown') {
    canvas.focus();
    canvas.setPointerCapture(event.pointerId);
  }
  if (event.pointerType === 'touch') on_touch(event);
  // DOM: left, right, middle are 1, 2, 4, as for Dear ImGui.
  else point(event.clientX, event.clientY, event.buttons);
  event.preventDefault();
}

function on_wheel(event) {
  const lines = event.deltaMode === 0 ? event.deltaY / 100 : event.deltaY / 3;
  point(event.clientX, event.clientY, event.buttons, -lines);
  event.preventDefault();
}

// ---- keys: the codes of GLFW, which the window uses ----

const special = {
  Space: 32, Quote: 39, Comma: 44, Minus: 45, Period: 46, Slash: 47, Semicolon: 59, Equal: 61,
  BracketLeft: 91, Backslash: 92, BracketRight: 93, Escape: 256, Enter: 257, Tab: 258,
  Backspace: 259, Insert: 260, Delete: 261, ArrowRight: 262, ArrowLeft: 263, ArrowDown: 264,
  ArrowUp: 265, PageUp: 266, PageDown: 267, Home: 268, End: 269, F1: 290, F2: 291, F11: 300,
};

function code_of(event) {
  if (/^Key[A-Z]$/.test(event.code)) return event.code.charCodeAt(3);
  if (/^Digit[0-9]$/.test(event.code)) return event.code.charCodeAt(5);
  if (event.code === 'NumpadEnter') return special.Enter;
  return special[event.code] || 0;
}

// The letter, comma or period of a key in the keyboard layout, without Shift; empty: another sign.
// Alphabets without such letters have those of a US keyboard.
function sign_of({key, code, shiftKey}) {
  if (/^Numpad/.test(code)) return '';
  if (/^[a-z,.]$/i.test(key)) return key.toLowerCase();
  if (/^Key[A-Z]$/.test(code) && !/^[ -~]$/.test(key)) return code[3].toLowerCase();
  if (shiftKey && (key === '>' || (key === ':' && code === 'Period'))) return '.';
  if (shiftKey && (key === '<' || (key === ';' && code === 'Comma'))) return ',';
  return '';
}

function on_key(event) {
  const code = code_of(event);
  const sign = sign_of(event);
  const ctrl = event.ctrlKey || event.metaKey;
  const down = event.type === 'keydown';
  if (code) Module._clatter_key(code, sign ? sign.charCodeAt(0) : 0, event.shiftKey, ctrl, down, event.repeat);
  if (down && !ctrl && !event.altKey && [...event.key].length === 1) {
    text_of('clatter_type', event.key);
  }
  wake();
  // The keys of the browser itself keep their meaning: reload, search, new tab.
  const own = !ctrl || (sign && 'zys'.includes(sign));
  if (code && own && !event.altKey && event.code !== 'F11') event.preventDefault();
}

// ---- the keyboard of touch screens ----

// It edits an invisible field. The edits are repeated in the field of the window, because such
// keyboards have no codes of keys and replace whole words.
let typed = '';  // content of the invisible field that has been repeated

// Browsers show the keyboard during a touch only, so pictures are drawn until the touched field of
// the window has the focus: for the press, the release, the focus and the text field.
function show_keyboard() {
  const pictures = 5;
  for (let k = 0; k < pictures; ++k) draw();
  if (!Module._clatter_wants_text()) return canvas.focus();
  keys.value = typed = ' '.repeat(100);  // for the key Backspace
  keys.focus();
}

function press(code) {
  for (const down of [1, 0]) {
    Module._clatter_key(code, 0, false, false, down, false);
    draw();
  }
}

function on_input() {
  const text = keys.value;
  let same = 0;
  while (same < Math.min(text.length, typed.length) && text[same] === typed[same]) ++same;
  for (let k = same; k < typed.length; ++k) press(special.Backspace);
  text_of('clatter_type', text.slice(same));
  typed = text;
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
    Module.FS.writeFile(path, new Uint8Array(await file.arrayBuffer()));
    paths.push(path);
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

// Vectors of WebAssembly: a module with the instruction v128.const.
const with_vectors = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1,
  0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]);
if (typeof WebAssembly !== 'object' || !WebAssembly.validate(with_vectors)) {
  note.textContent = 'This browser has no vectors of WebAssembly. Browsers of 2023 and later have.';
  Module.onRuntimeInitialized = () => {};
}
