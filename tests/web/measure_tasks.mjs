// The longest tasks of the page while a scene opens, in milliseconds: node measure_tasks.mjs FOLDER
// FRAGMENT. Each line is a fresh browser: the longest tasks, and the longest processor time of one.

import {Browser, serve, sleep} from './browser.mjs';

const [folder, fragment] = process.argv.slice(2);
const [, particles] = /particles\.count=(\d+)/.exec(fragment);
const server = await serve(folder);

// Tasks of the thread of the page, each {dur, tdur} in microseconds.
async function tasks_of(browser) {
  await browser.send('Tracing.end');
  while (!browser.events.some((event) => event.method === 'Tracing.tracingComplete')) await sleep(100);
  const events = browser.events.filter((event) => event.method === 'Tracing.dataCollected')
      .flatMap((event) => event.params.value);
  const thread = (event) => `${event.pid}:${event.tid}`;
  const pages = events.filter((event) => event.args?.name === 'CrRendererMain').map(thread);
  return events.filter((event) => event.name.endsWith('RunTask') && event.dur && pages.includes(thread(event)));
}

const longest = (durations) =>
    durations.sort((a, b) => b - a).slice(0, 3).map((one) => Math.round(one / 1000)).join(' ');

for (let run = 0; run < 3; ++run) {
  const browser = await Browser.start();
  try {
    await browser.resize(1280, 720);
    await browser.open(`${server.address}?log#cradle`);
    await sleep(2000);
    await browser.send('Tracing.start', {transferMode: 'ReportEvents', categories: 'toplevel'});
    await browser.value(`void (location.hash = '${fragment}')`);
    await browser.until(`log.map((line) => JSON.parse(line)).some((event) =>
        event.event === 'status' && event.particles === ${particles} && event.time > 0)`, 120);
    await sleep(1500);
    const tasks = await tasks_of(browser);
    console.log(`longest ${longest(tasks.map((task) => task.dur))}, processor time ` +
                longest(tasks.map((task) => task.tdur)));
  } finally {
    await browser.stop();
  }
}
server.close();
