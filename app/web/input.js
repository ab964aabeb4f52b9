// Mouse, fingers and keys of the page. Positions are pixels of the device.
'use strict';

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
    try {
      canvas.setPointerCapture(event.pointerId);
    } catch {
      // A pointer that has left is not followed.
    }
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
