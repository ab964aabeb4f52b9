// Times of the page in headless Chromium: node measure_tasks.mjs FOLDER WHAT [--without-drawing]
// FOLDER has the page. WHAT is one of these:
//   first      milliseconds from the arrival of the files to the first moving gas
//   picture    milliseconds per picture of 10 000 disks, without the work of OpenGL
//   gallery    longest tasks while the gallery makes its pictures
//   ways       longest tasks of jumps, a step back and a pick in 100 000 disks
//   FRAGMENT   longest tasks while the scene of a link opens, with its particles.count
// Longest tasks are milliseconds: with all waits, and of the processor. Each line is a fresh browser.

import {Browser, serve} from './browser.mjs';

const [folder, what, option] = process.argv.slice(2);
const server = await serve(folder);
let browser;

const open = (...link) => browser.open_scene(server.address, ...link);

async function longest_tasks(run) {
  if (option === '--without-drawing') await browser.without_drawing();
  const tasks = await browser.tasks(run);
  const longest = (kind) =>
      tasks.map((task) => task[kind]).sort((a, b) => b - a).slice(0, 3).map(Math.round).join(' ');
  return `longest ${longest('wall')}, processor time ${longest('processor')}`;
}

const measurements = {
  async first() {
    await browser.open(`${server.address}?log#vibrated`,
                       `log.some((line) => { const e = JSON.parse(line); return e.event === 'status' && e.time > 0; })`);
    return browser.value(`Math.round(performance.now() - Math.max(
        ...performance.getEntriesByType('resource').map((entry) => entry.responseEnd)))`);
  },

  async picture() {
    await open('vibrated&particles.count=10000&box.size=[120.0,150.0]');
    await browser.without_drawing();
    return (await browser.value(`(() => {
      const pictures = 30;
      const began = performance.now();
      for (let k = 0; k < pictures; ++k) Module._clatter_draw();
      return (performance.now() - began) / pictures;
    })()`)).toFixed(1);
  },

  async gallery() {
    await open('cradle', '&until=0');
    return longest_tasks(async () => {
      await browser.click('gallery');
      await browser.idle();
    });
  },

  async ways() {
    const shift = 8;
    await open('vibrated&particles.count=100000&box.size=[340.0,400.0]&view.speed=5');
    await browser.until_last('status', 'e.collisions > 1000000');
    await browser.press('Space', ' ');
    const head = await browser.halted_where('true');
    return longest_tasks(async () => {
      await browser.press('Home', 'Home');
      await browser.halted_where('e.time === 0');
      await browser.press('End', 'End');
      await browser.halted_where(`e.hash === '${head.hash}'`);
      await browser.press('Comma', ';', shift);
      await browser.halted_where(`e.time < ${head.time}`);
      await browser.click('viewport');
      await browser.idle();
    });
  },

  async opening() {
    const [, particles] = /particles\.count=(\d+)/.exec(what);
    await open('cradle');
    await browser.pictures(60);
    return longest_tasks(async () => {
      await browser.value(`void (location.hash = '${what}')`);
      await browser.until_last('status', `e.particles === ${particles} && e.time > 0`);
      await browser.pictures(60);
    });
  },
};

for (let run = 0; run < 3; ++run) {
  browser = await Browser.start();
  try {
    await browser.resize(1280, 720);
    console.log(await (measurements[what] || measurements.opening)());
  } finally {
    await browser.stop();
  }
}
server.close();
