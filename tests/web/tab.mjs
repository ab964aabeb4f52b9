// The window of clatter in a tab of a browser: what it shows, and how scripts use it. Everything is
// waited for by its state, so a busy machine makes tests slower and nothing else.

import {spawn} from 'node:child_process';

export const sleep = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(1));

/// Starts a program, which ends with this one, as all that it has started.
export function start(program, words, stdio = 'ignore', env = process.env) {
  const started = spawn(program, words, {stdio, env, detached: true});
  const kill = () => {
    try {
      process.kill(-started.pid, 'SIGKILL');
    } catch {
      // It has ended.
    }
  };
  process.on('exit', kill);
  started.has_ended = () => started.exitCode !== null || started.signalCode !== null;
  started.end = () => new Promise((done) => {
    started.on('exit', done);
    kill();
    if (started.has_ended()) done();
  });
  return started;
}

/// Questions to a browser, by their numbers. They fail when the browser ends, or its `channel`.
export class Questions {
  constructor(browser, channel) {
    this.browser = browser;
    this.open = new Map();
    this.last = 0;
    browser.on('exit', () => this.fail());
    for (const event of ['error', 'close']) channel.on(event, () => this.fail());
  }

  fail() {
    for (const {reject} of this.open.values()) reject(new Error('the browser has ended'));
    this.open.clear();
  }

  /// Sends a question by its number. Resolves to the answer.
  ask(send) {
    return new Promise((resolve, reject) => {
      this.open.set(++this.last, {resolve, reject});
      if (this.browser.has_ended()) this.fail();
      else send(this.last);
    });
  }

  /// Takes an answer, or the text of an error. Returns whether there was a question.
  answer(number, error, result) {
    const question = this.open.get(number);
    this.open.delete(number);
    if (error) question?.reject(new Error(error));
    else question?.resolve(result);
    return question !== undefined;
  }
}

/// A tab. A class of a browser adds: value(expression) of the page, go(address), mouse(type, x, y,
/// buttons) and touch(type, ...points) with the types of events of Chromium's DevTools protocol, and
/// stop().
export class Tab {
  /// Waits until a function finds something, and returns it. The number of questions is limited, for
  /// pages that have failed. On a busy machine they take longer.
  async found(find, what) {
    const most = 6000;
    for (let asked = 0; asked < most; ++asked) {
      const value = await find();
      if (value) return value;
      await sleep(20);
    }
    const note = await this.value(`document.getElementById('note')?.textContent`);
    throw new Error(`it does not hold: ${what}; the page says "${note}"`);
  }

  /// Waits until an expression of the page, or of its iframe, is true, and returns its value.
  until(expression, context = undefined) {
    const tried = `(() => { try { return ${expression}; } catch { return false; } })()`;
    return this.found(() => this.value(tried, context), expression);
  }

  /// Opens an address and waits until `state` holds in the page.
  async open(address, state = 'ready') {
    // A page with unsaved changes would ask before it is left. Another fragment alone would not load
    // the page again.
    await this.value('void (window.ready = false)');
    await this.go('about:blank');
    await this.go(address);
    await this.until(state);
  }

  /// Opens the scene of a link, with the script log.
  async open_scene(page, fragment, query = '') {
    await this.open(`${page}?log${query}#${fragment}`);
    await this.until_last('status', 'true');
  }

  /// Waits until the page has drawn this number of pictures, or shows all it knows.
  pictures(count) {
    return this.value(`new Promise((done) => {
      let left = ${count};
      (function next() { if (!asked || !left--) done(true); else requestAnimationFrame(next); })();
    })`);
  }

  /// Pictures of the page per picture of the browser.
  picture_share() {
    return this.value(`new Promise((done) => {
      const drawn = () => log.filter((line) => line.includes('"event":"picture"')).length;
      const before = drawn(), shown = 30;
      let left = shown;
      (function next() { if (left--) requestAnimationFrame(next); else done((drawn() - before) / shown); })();
    })`);
  }

  /// The number of colours in a place of the page: left, top, width and height.
  colours_in(place) {
    return this.value(`(() => {
      const [left, top, width, height] =
          ${JSON.stringify(place)}.map((length) => Math.round(length * devicePixelRatio));
      const pixels = new Uint8Array(4 * width * height);
      const gl = canvas.getContext('webgl2');
      Module._clatter_draw();
      gl.readPixels(left, canvas.height - top - height, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      return new Set(new Uint32Array(pixels.buffer)).size;
    })()`);
  }

  /// Waits until the pictures have the input so far. The panels need four of them after an event.
  settle() {
    return this.pictures(8);
  }

  /// Waits until the page shows all it knows: a gas that is halted, and pictures of the gallery.
  idle() {
    return this.until('!asked');
  }

  /// The events of a name in the script log.
  events(name) {
    return this.value(
        `log.map((line) => JSON.parse(line)).filter((event) => event.event === '${name}')`);
  }

  async last(name) {
    return (await this.events(name)).pop();
  }

  /// Waits until a condition of the last event `e` of a name holds, and returns the event.
  until_last(name, condition) {
    return this.until(`log.filter((line) => line.includes('"event":"${name}"')).slice(-1)
        .map((line) => JSON.parse(line)).find((e) => ${condition})`);
  }

  /// The last status, once the gas is halted and a condition holds. It has the hash of the state.
  halted_where(condition) {
    return this.until_last('status', `e.hash && (${condition})`);
  }

  /// Left, top, width and height of a widget, in pixels of the page.
  async place_of(widget) {
    await this.until(`log.some((line) => line.includes('"name":"${widget}"'))`);
    await this.settle();
    const scale = await this.value('devicePixelRatio');
    const {place} = (await this.events('widget')).filter((event) => event.name === widget).pop();
    return place.map((length) => length / scale);
  }

  async middle_of(widget) {
    const [x, y, width, height] = await this.place_of(widget);
    return [x + width / 2, y + height / 2];
  }

  async click_at(x, y) {
    await this.mouse('mouseMoved', x, y);
    await this.mouse('mousePressed', x, y, 1);
    await this.mouse('mouseReleased', x, y);
    await this.settle();
  }

  async click(widget) {
    await this.click_at(...await this.middle_of(widget));
  }

  async tap_at(x, y) {
    await this.touch('touchStart', [x, y]);
    await this.touch('touchEnd');
    await this.settle();
  }

  async tap(widget) {
    await this.tap_at(...await this.middle_of(widget));
  }
}
