// A headless Chromium, controlled by the DevTools protocol through pipes, and a server of files.
// Needs nothing but node.

import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import {extname, join, normalize} from 'node:path';
import {Questions, start, Tab} from './tab.mjs';

const kinds = {'.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css',
               '.wasm': 'application/wasm'};

/// Serves the files of a folder, and pages given as text by their paths; null: a file that is
/// missing. Resolves to {address, close}.
export function serve(folder, pages = {}) {
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname));
    if (pages[path] === null) {
      response.writeHead(404).end();
      return;
    }
    if (path in pages) {
      response.writeHead(200, {'Content-Type': kinds[extname(path)]});
      response.end(pages[path]);
      return;
    }
    const file = join(folder, path.endsWith('/') ? path + 'index.html' : path);
    try {
      const bytes = readFileSync(file);
      response.writeHead(200, {'Content-Type': kinds[extname(file)] || 'application/octet-stream'});
      response.end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve({
    address: `http://127.0.0.1:${server.address().port}/`,
    close: () => server.close(),
  })));
}

/// Chromium with one tab.
export class Browser extends Tab {
  static async start(program = 'chromium') {
    const browser = new Browser();
    browser.profile = mkdtempSync(join(tmpdir(), 'clatter-chromium-'));
    browser.process = start(program, [
      '--headless', '--no-sandbox', '--disable-quic', '--no-first-run',
      '--disable-background-networking', '--disable-component-update', '--disable-sync',
      '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--remote-debugging-pipe', `--user-data-dir=${browser.profile}`, 'about:blank',
    ], ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']);
    browser.questions = new Questions(browser.process, browser.process.stdio[3]);
    browser.told = [];
    browser.listen();
    const {targetInfos} = await browser.send('Target.getTargets');
    const {targetId} = targetInfos.find((target) => target.type === 'page');
    const {sessionId} = await browser.send('Target.attachToTarget', {targetId, flatten: true});
    browser.session = sessionId;
    for (const domain of ['Page', 'Runtime', 'Network', 'Log']) await browser.send(domain + '.enable');
    return browser;
  }

  listen() {
    let text = '';
    this.process.stdio[4].on('data', (bytes) => {
      text += bytes;
      const messages = text.split('\0');
      text = messages.pop();
      for (const message of messages.map((one) => JSON.parse(one))) {
        const error = message.error && JSON.stringify(message.error);
        if (!this.questions.answer(message.id, error, message.result)) this.told.push(message);
      }
    });
  }

  send(method, params = {}) {
    return this.questions.ask((id) => {
      const message = {id, method, params, sessionId: this.session};
      this.process.stdio[3].write(JSON.stringify(message) + '\0');
    });
  }

  /// The value of an expression in the page, or in its iframe.
  async value(expression, contextId = undefined) {
    const {result, exceptionDetails} = await this.send(
        'Runtime.evaluate', {expression, returnByValue: true, awaitPromise: true, contextId});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description || expression);
    return result.value;
  }

  /// The context of the scripts in an iframe with a page of this origin, for value() and until().
  async iframe(origin) {
    const context = await this.found(
        () => this.told.filter((event) => event.method === 'Runtime.executionContextCreated')
            .map((event) => event.params.context).findLast((made) => made.origin === origin),
        `an iframe of ${origin}`);
    return context.id;
  }

  go(address) {
    return this.send('Page.navigate', {url: address});
  }

  resize(width, height, scale = 1, mobile = false) {
    return this.send('Emulation.setDeviceMetricsOverride',
                     {width, height, deviceScaleFactor: scale, mobile});
  }

  mouse(type, x, y, buttons = 0) {
    return this.send('Input.dispatchMouseEvent',
                     {type, x, y, buttons, button: buttons || type === 'mouseReleased' ? 'left' : 'none',
                      clickCount: 1});
  }

  /// Presses a key of the keyboard. `modifiers`: 2 Ctrl, 8 Shift.
  async press(code, key, modifiers = 0) {
    const text = key.length === 1 && modifiers !== 2 ? key : '';
    await this.send('Input.dispatchKeyEvent', {type: 'keyDown', code, key, text, modifiers});
    await this.settle();
    await this.send('Input.dispatchKeyEvent', {type: 'keyUp', code, key, modifiers});
    await this.settle();
  }

  /// An event of fingers, each [x, y] in pixels of the page.
  touch(type, ...points) {
    return this.send('Input.dispatchTouchEvent',
                     {type, touchPoints: points.map(([x, y], id) => ({x, y, id}))});
  }

  /// The picture of the page as PNG.
  async picture() {
    const {data} = await this.send('Page.captureScreenshot', {format: 'png'});
    return Buffer.from(data, 'base64');
  }

  /// Runs a function. Resolves to the tasks of the page's thread meanwhile, each with its duration
  /// and its processor time, {wall, processor}, in milliseconds. Where the browser does not know the
  /// processor time, it is the duration.
  async tasks(run) {
    this.told.length = 0;
    await this.send('Tracing.start', {transferMode: 'ReportEvents', categories: 'toplevel'});
    await run();
    await this.send('Tracing.end');
    await this.found(() => this.told.some((event) => event.method === 'Tracing.tracingComplete'),
                     'the tracing is complete');
    const events = this.told.filter((event) => event.method === 'Tracing.dataCollected')
        .flatMap((event) => event.params.value);
    const thread = (event) => `${event.pid}:${event.tid}`;
    const pages = events.filter((event) => event.args?.name === 'CrRendererMain').map(thread);
    return events
        .filter((event) => event.name.endsWith('RunTask') && event.dur && pages.includes(thread(event)))
        .map((event) => ({wall: event.dur / 1000, processor: (event.tdur ?? event.dur) / 1000}));
  }

  /// Leaves out the calls of WebGL that draw or copy pixels, until the page is left.
  without_drawing() {
    return this.value(`(() => {
      const calls = WebGL2RenderingContext.prototype;
      for (const name of ['drawArrays', 'drawElements', 'drawArraysInstanced', 'drawElementsInstanced',
                          'bufferData', 'bufferSubData', 'texImage2D', 'texSubImage2D', 'blitFramebuffer',
                          'clear', 'clearBufferfv', 'finish', 'flush']) {
        calls[name] = () => {};
      }
    })()`);
  }

  async stop() {
    await this.process.end();
    rmSync(this.profile, {recursive: true, force: true, maxRetries: 5});
  }
}
