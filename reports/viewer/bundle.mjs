// Bundles view/main.js with its libraries into one script for the page: node bundle.mjs OUT
// The licences of the libraries stand at its beginning. The result is ASCII and has no end of a script element in it.
import {readFileSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {build} from 'esbuild';

const room = dirname(fileURLToPath(import.meta.url));
const three = join(room, 'node_modules', 'three');
const {version} = JSON.parse(readFileSync(join(three, 'package.json'), 'utf8'));
const licence = readFileSync(join(three, 'LICENSE'), 'utf8').trim().replaceAll('©', '(c)');
const result = await build({
  entryPoints: [join(room, 'view', 'main.js')],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: ['chrome94', 'firefox113', 'safari16.4'],
  charset: 'ascii',
  legalComments: 'none', // the whole text stands in the banner
  loader: {'.css': 'text'},
  logLevel: 'error',
  banner: {js: `/*! three.js ${version}, https://threejs.org\n${licence}\n*/`},
});
const text = result.outputFiles[0].text;
if (/[^\x00-\x7f]/.test(text)) throw new Error('the bundle is not ASCII');
for (const unwanted of ['</script', '<!--', ')script"']) {
  if (text.toLowerCase().includes(unwanted)) throw new Error(`the bundle has ${unwanted} in it`);
}
writeFileSync(process.argv[2], text);
