// Tests of the whole page in headless Chromium: node test_page.mjs FOLDER [CASE]
// FOLDER has the page; CASE is a part of the names of the cases to run.

import {run_cases} from './cases.mjs';
import './window_cases.mjs';
import './finger_cases.mjs';
import './file_cases.mjs';
import './large_cases.mjs';
import {browser, chosen, host, server, take_complaints} from './in_chromium.mjs';

try {
  process.exitCode = await run_cases(chosen, take_complaints) ? 0 : 1;
} finally {
  await browser.stop();
  server.close();
  host.close();
}
