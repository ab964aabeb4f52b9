// Firefox and WebKitGTK's MiniBrowser, controlled by commands of WebDriver: Firefox takes them from
// its socket (Marionette), MiniBrowser from the HTTP server WebKitWebDriver. Needs nothing but node.

import {existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {connect, createServer} from 'node:net';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {Questions, sleep, start, Tab} from './tab.mjs';

/// A browser with one tab. A class of a browser adds: command(method, path, name, parameters), the
/// command as HTTP and by its name; has_touch; and stop().
class DrivenTab extends Tab {
  async value(expression) {
    const script = `const done = arguments[arguments.length - 1];
        (async () => ${expression})().then((value) => done({value}),
                                           (error) => done({error: String(error)}));`;
    const {value, error} = await this.command(
        'POST', '/execute/async', 'ExecuteAsyncScript', {script, args: []});
    if (error) throw new Error(`${error}: ${expression}`);
    return value;
  }

  go(url) {
    return this.command('POST', '/url', 'Navigate', {url});
  }

  async resize(width, height) {
    // The window has bars around the page.
    const set = (wide, tall) =>
        this.command('POST', '/window/rect', 'SetWindowRect', {width: wide, height: tall});
    await set(width, height);
    const [wide, tall] = await this.value('[innerWidth, innerHeight]');
    await set(2 * width - wide, 2 * height - tall);
  }

  act(pointerType, actions) {
    const source = {type: 'pointer', id: pointerType, parameters: {pointerType}, actions};
    return this.command('POST', '/actions', 'PerformActions', {actions: [source]});
  }

  mouse(type, x, y) {
    const to = {type: 'pointerMove', x: Math.round(x), y: Math.round(y), duration: 0};
    const then = {mousePressed: [{type: 'pointerDown', button: 0}],
                  mouseReleased: [{type: 'pointerUp', button: 0}]};
    return this.act('mouse', [to, ...then[type] || []]);
  }

  async touch(type, point) {
    const [x, y] = this.touched = (point || this.touched).map(Math.round);
    if (!this.has_touch) return this.value(`void canvas.dispatchEvent(new PointerEvent('${
        {touchStart: 'pointerdown', touchMove: 'pointermove', touchEnd: 'pointerup'}[type]}',
        {pointerType: 'touch', pointerId: 7, clientX: ${x}, clientY: ${y}, bubbles: true, cancelable: true}))`);
    const to = {type: 'pointerMove', x, y, duration: 0};
    return this.act('touch', {touchStart: [to, {type: 'pointerDown', button: 0}], touchMove: [to],
                              touchEnd: [{type: 'pointerUp', button: 0}]}[type]);
  }
}

/// Firefox. It needs a display: without one it has no WebGL 2.
export class Firefox extends DrivenTab {
  static async start(program) {
    const tab = new Firefox();
    tab.has_touch = true;
    tab.profile = mkdtempSync(join(tmpdir(), 'clatter-firefox-'));
    writeFileSync(join(tab.profile, 'user.js'), 'user_pref("marionette.port", 0);\n');
    tab.process = start(program, ['--marionette', '--no-remote', '--profile', tab.profile, 'about:blank'],
                        'ignore', {...process.env, HOME: tab.profile});
    const port_file = join(tab.profile, 'MarionetteActivePort');
    while (!existsSync(port_file) || !readFileSync(port_file, 'utf8')) {
      if (tab.process.has_ended()) throw new Error('Firefox has ended');
      await sleep(50);
    }
    tab.socket = connect(Number(readFileSync(port_file, 'utf8')), '127.0.0.1');
    tab.questions = new Questions(tab.process, tab.socket);
    tab.listen();
    await tab.command('', '', 'NewSession', {capabilities: {alwaysMatch: {}}});
    await tab.command('', '', 'SetTimeouts', {script: 600000});
    return tab;
  }

  // A message is its length, a colon and JSON. The greeting is no list.
  listen() {
    let bytes = Buffer.alloc(0);
    this.socket.on('data', (more) => {
      bytes = Buffer.concat([bytes, more]);
      for (let colon; (colon = bytes.indexOf(':')) >= 0;) {
        const after = colon + 1 + Number(bytes.subarray(0, colon));
        if (bytes.length < after) return;
        const message = JSON.parse(bytes.subarray(colon + 1, after));
        bytes = bytes.subarray(after);
        if (!Array.isArray(message)) continue;
        const [, id, error, result] = message;
        this.questions.answer(id, error && `${error.error}: ${error.message}`,
                              result && 'value' in result ? result.value : result);
      }
    });
  }

  command(method, path, name, parameters) {
    return this.questions.ask((id) => {
      const text = JSON.stringify([0, id, `WebDriver:${name}`, parameters]);
      this.socket.write(`${Buffer.byteLength(text)}:${text}`);
    });
  }

  async stop() {
    this.socket.destroy();
    await this.process.end();
    rmSync(this.profile, {recursive: true, force: true, maxRetries: 5});
  }
}

/// WebKitGTK's MiniBrowser. Its driver makes a finger a mouse, so events of fingers are made in the
/// page.
export class WebKit extends DrivenTab {
  static async start(program) {
    const tab = new WebKit();
    tab.has_touch = false;
    const port = await new Promise((found) => {
      const probe = createServer().listen(0, '127.0.0.1', () => {
        const {port} = probe.address();
        probe.close(() => found(port));
      });
    });
    tab.address = `http://127.0.0.1:${port}/session`;
    tab.process = start(program, [`--port=${port}`]);
    const capabilities = {alwaysMatch: {timeouts: {script: 600000}}};
    for (;;) {
      try {
        const {sessionId} = await tab.command('POST', '', '', {capabilities});
        tab.address += `/${sessionId}`;
        return tab;
      } catch (error) {
        if (error.cause?.code !== 'ECONNREFUSED' || tab.process.has_ended()) throw error;
        await sleep(50);
      }
    }
  }

  async command(method, path, name, parameters) {
    const body = method === 'GET' ? undefined : JSON.stringify(parameters);
    const response = await fetch(this.address + path, {method, body});
    const {value} = await response.json();
    if (!response.ok) throw new Error(`${value.error}: ${value.message}`);
    return value;
  }

  async stop() {
    await this.process.end();
  }
}
