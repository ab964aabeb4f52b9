// The longest tasks of the page while a scene opens, in milliseconds: node measure_tasks.mjs FOLDER
// FRAGMENT [--without-drawing]. Each line is a fresh browser: the longest tasks, and the longest
// processor times.

import {Browser, serve, sleep} from './browser.mjs';

const [folder, fragment, option] = process.argv.slice(2);
const [, particles] = /particles\.count=(\d+)/.exec(fragment);
const server = await serve(folder);

const longest = (durations) => durations.sort((a, b) => b - a).slice(0, 3).map(Math.round).join(' ');

for (let run = 0; run < 3; ++run) {
  const browser = await Browser.start();
  try {
    await browser.resize(1280, 720);
    await browser.open(`${server.address}?log#cradle`);
    await sleep(2000);
    if (option === '--without-drawing') await browser.without_drawing();
    const tasks = await browser.tasks(async () => {
      await browser.value(`void (location.hash = '${fragment}')`);
      await browser.until(`log.map((line) => JSON.parse(line)).some((event) =>
          event.event === 'status' && event.particles === ${particles} && event.time > 0)`, 120);
      await sleep(1500);
    });
    console.log(`longest ${longest(tasks.map((task) => task.wall))}, processor time ` +
                longest(tasks.map((task) => task.processor)));
  } finally {
    await browser.stop();
  }
}
server.close();
