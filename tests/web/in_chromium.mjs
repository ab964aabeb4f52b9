// The browser of the cases of test_page.mjs, and what they do in it.

import {Browser, serve} from './browser.mjs';
import {installed, skip} from './cases.mjs';

const chromium = installed('chromium', 'chromium-browser') || skip('the package chromium is not installed');
export const [folder, chosen = ''] = process.argv.slice(2);
export const server = await serve(folder);

// A page of another origin that shows the gas of the same query and fragment in an iframe.
const frame = '<!DOCTYPE html><link rel="icon" href="data:,"><iframe width="640" height="480"></iframe><script>' +
    `document.querySelector('iframe').src = '${server.address}' + location.search + location.hash</script>`;
export const host = await serve(folder, {'/frame.html': frame});
export const browser = await Browser.start(chromium);

/// Gives the page the size of the other cases. Half of a pixel per pixel of the page halves their time.
export const usual_size = () => browser.resize(1280, 720, 0.5);
await usual_size();

/// Opens a scene by the fragment of a link, with the script log.
export const open = (...link) => browser.open_scene(server.address, ...link);

/// Errors of the browser since the last call: exceptions, and what it logs, such as errors of WebGL
/// and breaches of the Content-Security-Policy.
export function take_complaints() {
  const found = browser.told.filter((event) =>
      event.method === 'Runtime.exceptionThrown' || event.method === 'Log.entryAdded');
  browser.told.length = 0;
  return found.map((event) => JSON.stringify(event.params));
}

/// Drags a slider from its middle to a share of its width.
export async function drag(widget, share) {
  const [x, y, width, height] = await browser.place_of(widget);
  await browser.mouse('mouseMoved', x + width / 2, y + height / 2);
  await browser.mouse('mousePressed', x + width / 2, y + height / 2, 1);
  await browser.settle();
  await browser.mouse('mouseMoved', x + share * width, y + height / 2, 1);
  await browser.settle();
  await browser.mouse('mouseReleased', x + share * width, y + height / 2);
  await browser.settle();
}

/// Scrolls the left panel until a widget is in the page.
export async function scroll_to(widget) {
  for (let turn = 0; turn < 40 && (await browser.middle_of(widget))[1] > 700; ++turn) {
    await browser.send('Input.dispatchMouseEvent',
                       {type: 'mouseWheel', x: 100, y: 400, deltaX: 0, deltaY: 300});
    await browser.settle();
  }
}
