// Drives a report in headless Chromium and reads its pixels: node drive_report.js REPORT.html [FOLDER for screenshots]
// Every check is a line; the exit code is 1 where one does not hold. Reports of any run will do.
import {writeFileSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

import {Chromium} from './chromium.js';

const [report, folder] = process.argv.slice(2);
const browser = new Chromium();
let failures = 0;

function check(holds, text) {
  console.log(`${holds ? 'ok' : 'FAILED'}: ${text}`);
  failures += holds ? 0 : 1;
}

async function shot(name) {
  if (folder) writeFileSync(join(folder, `${name}.png`), await browser.screenshot());
}

/** The middle of an element, scrolled into the window; what listens for scrolling has heard of it. */
async function middleOf(expression, block = 'center') {
  return browser.evaluate(`(async () => {
    const element = ${expression};
    element.scrollIntoView({block: '${block}'});
    for (let frame = 0; frame < 3; ++frame) await new Promise((done) => requestAnimationFrame(done));
    const box = element.getBoundingClientRect();
    return [box.x + box.width / 2, box.y + box.height / 2];
  })()`);
}

async function sortsTables() {
  const table = `[...document.querySelectorAll('table.sortable')].find((t) => t.tBodies[0].rows.length > 1)`;
  const state = () => browser.evaluate(`(() => {
    const head = ${table}.tHead.rows[0].cells[0];
    const texts = [...${table}.tBodies[0].rows].map((row) => row.cells[0].textContent);
    return {sort: head.getAttribute('aria-sort'), texts: texts.join('|')};
  })()`);
  const before = await state();
  await browser.click(...await middleOf(`${table}.tHead.rows[0].cells[0].querySelector('button')`));
  const ascending = await state();
  check(ascending.sort === 'ascending', 'a click on a head sorts its table');
  await browser.key('Enter', '\r');
  const descending = await state();
  check(descending.sort === 'descending', 'Enter on the head sorts it the other way');
  const inOrder = (texts) => texts.split('|').every((text, n, all) => n === 0 ||
    all[n - 1].localeCompare(text, 'en', {numeric: true, sensitivity: 'base'}) <= 0);
  check(inOrder(ascending.texts) && inOrder(descending.texts.split('|').reverse().join('|')), 'rows are in order');
  await browser.key('Enter', '\r');
  check((await state()).texts === before.texts, 'a third time gives the order as it was');
}

async function plotsAnswer() {
  const svg = `document.querySelector('.plots svg')`;
  const place = await middleOf(`${svg}.querySelector('.mark')`);
  await browser.mouse('mouseMoved', ...place);
  const tip = await browser.evaluate(`document.querySelector('.tip').hidden ? '' : document.querySelector('.tip').textContent`);
  check(/\d/.test(tip) && tip.includes('\n'), `a mark shows its job and figures: ${JSON.stringify(tip)}`);
  await shot('plot');
  await browser.click(...await middleOf(`${svg}.querySelector('.key')`));
  const hidden = await browser.evaluate(`getComputedStyle(${svg}.querySelector('.series')).display`);
  check(hidden === 'none', 'a click on its entry in the legend hides a series');
  await browser.click(...await middleOf(`${svg}.querySelector('.key')`));
  const shown = await browser.evaluate(`getComputedStyle(${svg}.querySelector('.series')).display`);
  check(shown !== 'none', 'and shows it again');
}

/**
 * Of the picture: how many pixels are not white, how many have the hue of each label, how many are of the red of the worst
 * elements, and a sum that changes with the picture.
 */
function picture() {
  return browser.evaluate(`(() => {
    const meshView = document.getElementById('view').meshView;
    const {bytes, width, height} = meshView.view.pixels();
    const colours = meshView.labels.map(({colour}) => [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)));
    const hues = colours.map((c) => c.map((one) => one / Math.max(...c)));
    const counts = hues.map(() => 0);
    let ink = 0, red = 0, sum = 0;
    for (let at = 0; at < bytes.length; at += 4) {
      const [r, g, b] = [bytes[at], bytes[at + 1], bytes[at + 2]];
      sum = (Math.imul(sum, 31) + r + 7 * g + 13 * b) | 0;
      if (r + g + b > 750) continue;
      ++ink;
      if (r > 60 && g < 0.3 * r && b < 0.3 * r) ++red;
      const most = Math.max(r, g, b);
      hues.forEach((hue, n) => {
        if (most > 40 && Math.abs(r / most - hue[0]) + Math.abs(g / most - hue[1]) + Math.abs(b / most - hue[2]) < 0.05) ++counts[n];
      });
    }
    return {ink: ink / (width * height), red, sum, counts};
  })()`);
}

const control = (name) => `document.getElementById('view').meshView.panel.${name}`;

async function set(name, value) {
  await browser.evaluate(`(() => {
    const input = ${control(name)};
    if (input.type === 'checkbox') input.checked = ${JSON.stringify(value)};
    else input.value = ${JSON.stringify(String(value))};
    for (const event of ['input', 'change']) input.dispatchEvent(new Event(event));
  })()`);
}

async function turns() {
  const before = await picture();
  check(before.ink > 0.03, `the mesh is drawn: ${(100 * before.ink).toFixed(1)} % of the pixels`);
  const [x, y] = await middleOf(`document.querySelector('#view canvas')`);
  await browser.drag([x, y], [x + 90, y + 30]);
  const dragged = await picture();
  check(dragged.sum !== before.sum && dragged.ink > 0.03, 'a drag turns it');
  await browser.evaluate(`document.querySelector('#view canvas').focus()`);
  await browser.key('ArrowLeft');
  check((await picture()).sum !== dragged.sum, 'an arrow key turns it');
  await browser.click(x, y);
  const under = await browser.evaluate(`document.querySelector('#view .under').textContent`);
  check(/smallest dihedral angle [\d.]+/.test(under), `a click names the element: ${JSON.stringify(under)}`);
  await browser.evaluate(`${control('reset')}.click()`);
}

async function cuts() {
  const whole = await picture();
  await set('cut', 'x');
  const half = await picture();
  check(half.sum !== whole.sum && half.ink < whole.ink && half.ink > 0.1 * whole.ink,
    `a cut takes a part away: ${(100 * whole.ink).toFixed(1)} to ${(100 * half.ink).toFixed(1)} % of the pixels`);
  await shot('cut');
  await set('place', 6);
  const slice = await picture();
  check(slice.ink < 0.75 * half.ink, `the slider moves it: ${(100 * slice.ink).toFixed(1)} %`);
  await set('flip', true);
  check((await picture()).ink > half.ink, 'the other side is what was cut away');
  await set('flip', false);
  await set('place', 100);
  await set('cut', '');
  check((await picture()).sum === whole.sum, 'without the cut it is as before');
}

async function picksLabels() {
  await set('lines', false);
  const all = await picture();
  const most = all.counts.indexOf(Math.max(...all.counts));
  check(all.counts[most] > 500, `label ${most} is seen in its colour: ${all.counts[most]} pixels`);
  const button = `${control('names')}.children[${most}]`;
  await browser.click(...await middleOf(button));
  const without = await picture();
  check(without.counts[most] < 0.02 * all.counts[most], `a click on its name hides it: ${without.counts[most]} pixels`);
  await shot('label-off');
  await browser.click(...await middleOf(button));
  check((await picture()).sum === all.sum, 'another one shows it again');
  await set('colour', 'angle');
  const byAngle = await picture();
  check(byAngle.counts[most] < 0.5 * all.counts[most], 'colours are those of the quality');
  check(await browser.evaluate(`!${control('scale')}.hidden`), 'the scale is there');
  await set('lines', true);
  await shot('quality');
  await set('worst', 50);
  check((await picture()).red > 0, 'the worst elements are shown');
  await shot('worst');
  await set('worst', 0);
  await set('colour', 'label');
}

async function comparesTwo() {
  if (await browser.evaluate(`${control('beside')}.options.length`) < 3) return;
  const alone = await picture();
  await set('beside', 1);
  await browser.evaluate(`new Promise((done) => {
    const wait = () => (document.getElementById('view').meshView.shown.length === 2 ? done() : setTimeout(wait, 50));
    wait();
  })`);
  check((await picture()).sum !== alone.sum, 'two meshes stand beside each other');
  await set('cut', 'y');
  await shot('beside');
  await set('cut', '');
}

async function atWidth(width, height) {
  await browser.size(width, height);
  await browser.goTo(pathToFileURL(resolve(report)).href);
  await shot(`${width}-top`);
  const wide = await browser.evaluate('document.documentElement.scrollWidth');
  check(wide <= width, `the page is ${wide} px wide in a window of ${width}`);
}

async function viewIsThere() {
  await middleOf(`document.getElementById('view')`, 'start');
  const ready = await browser.evaluate(`new Promise((done) => {
    const began = Date.now();
    const wait = () => {
      const place = document.getElementById('view');
      if (place.meshView) done('');
      else if (place.textContent.includes('cannot be shown') || Date.now() - began > 240000) done(place.textContent);
      else setTimeout(wait, 100);
    };
    wait();
  })`);
  check(ready === '', `the view is there ${ready}`);
  return ready === '';
}

try {
  await browser.openPage();
  await atWidth(1400, 1000);
  await sortsTables();
  await plotsAnswer();
  if (await browser.evaluate(`document.getElementById('view') !== null`)) {
    if (await viewIsThere()) {
      await shot('1400-view');
      for (const part of [turns, cuts, picksLabels, comparesTwo]) await part();
    }
    await atWidth(390, 844);
    if (await viewIsThere()) {
      check((await picture()).ink > 0.03, 'the mesh is drawn on a phone');
      await shot('390-view');
      await middleOf(`document.querySelector('#view .controls')`, 'end');
      await shot('390-controls');
    }
  } else {
    console.log('no 3D view in this report');
  }
  check(browser.faults.length === 0, `no errors, no request: ${browser.faults.join('; ')}`);
} finally {
  await browser.close();
}
process.exitCode = failures === 0 ? 0 : 1;
