// Tests of the whole page in headless Chromium: node test_page.mjs FOLDER CASES [CASE]
// FOLDER has the page; CASES is a list of files, such as window,finger for window_cases.mjs and
// finger_cases.mjs; CASE is a part of the names of the cases to run.

import {run_cases} from './cases.mjs';
import {browser, chosen, files, host, server, take_complaints} from './in_chromium.mjs';

for (const file of files.split(',')) await import(`./${file}_cases.mjs`);

try {
  process.exitCode = await run_cases(chosen, take_complaints) ? 0 : 1;
} finally {
  await browser.stop();
  server.close();
  host.close();
}
