// Writes the page as one file with everything inside: node make_single.mjs FOLDER FILE.
// FOLDER has the page.

import {createHash} from 'node:crypto';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

const [folder, file] = process.argv.slice(2);
const text_of = (name) => readFileSync(join(folder, name), 'utf8');
const allowed = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

let page = text_of('index.html');

// Takes the parts that match a pattern out of the page. Returns their first groups.
function taken(pattern) {
  const names = [...page.matchAll(pattern)].map((match) => match[1]);
  if (!names.length) throw new Error(`index.html has nothing like ${pattern}`);
  page = page.replaceAll(pattern, '');
  return names;
}

function replace(part, by) {
  if (!page.includes(part)) throw new Error(`index.html has no ${part}`);
  page = page.replace(part, () => by);
}

const scripts = taken(/<script src="([^"]+)" defer><\/script>\n/g).map(text_of);
const styles = taken(/<link rel="stylesheet" href="([^"]+)">\n/g).map(text_of);
for (const script of scripts) {
  if (/<\/script|<!--/i.test(script)) throw new Error('a script would end early in a page');
}
replace("script-src 'self'", `script-src ${scripts.map(allowed).join(' ')}`);
replace("style-src 'self'", `style-src ${styles.map(allowed).join(' ')}`);
replace("connect-src 'self'; ", '');
const program = readFileSync(join(folder, 'clatter.wasm')).toString('base64');
replace('</head>', styles.map((style) => `<style>${style}</style>\n`).join('') + '</head>');
replace('</body>', `<script id="program" type="application/wasm">${program}</script>\n` +
    scripts.map((script) => `<script>${script}</script>\n`).join('') + '</body>');
writeFileSync(file, page);
