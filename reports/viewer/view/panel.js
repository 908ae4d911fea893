// The controls under the view, as elements. Names come from outside: they are set as text, never as HTML.
import {qualities, scaleColour} from './colours.js';

export function make(name, properties = {}, ...children) {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
}

function labelled(title, ...controls) {
  return make('label', {}, make('span', {textContent: title}), ...controls);
}

function row(title, ...controls) {
  return make('div', {className: 'row'}, make('span', {textContent: title}), ...controls);
}

/** A choice of meshes, those of a case together. */
function meshChoice(headers, none) {
  const select = make('select');
  if (none) select.append(make('option', {value: '-1', textContent: none}));
  const groups = new Map();
  headers.forEach((header, n) => {
    if (!groups.has(header.case)) {
      groups.set(header.case, make('optgroup', {label: header.case}));
      select.append(groups.get(header.case));
    }
    groups.get(header.case).append(make('option', {value: String(n), textContent: `${header.case}, ${header.mesher}`}));
  });
  return select;
}

function choice(options) {
  return make('select', {}, ...options.map(([value, text]) => make('option', {value, textContent: text})));
}

function check(text, checked = false) {
  const input = make('input', {type: 'checkbox', checked});
  return {input, element: make('label', {}, input, text)};
}

function range(max, value) {
  return make('input', {type: 'range', min: '0', max: String(max), value: String(value)});
}

/** All controls by name, and `element`, which holds them. */
export function makePanel(headers) {
  const lines = check('mesh lines', true);
  const flip = check('other side');
  const panel = {
    mesh: meshChoice(headers), beside: meshChoice(headers, 'nothing'),
    colour: choice([['label', 'label'], ...Object.entries(qualities).map(([key, {title}]) => [key, title])]),
    cut: choice([['', 'none'], ['x', 'across x (left)'], ['y', 'across y (posterior)'], ['z', 'across z (superior)'],
      ['view', 'facing me']]),
    place: range(200, 100), flip: flip.input, lines: lines.input, worst: range(0, 0),
    worstText: make('span'), reset: make('button', {type: 'button', textContent: 'whole mesh'}),
    all: make('button', {type: 'button', textContent: 'all'}), names: make('div', {className: 'names'}),
    scale: row('Scale', make('div', {className: 'bar'})), note: make('p', {className: 'note'}),
  };
  panel.place.setAttribute('aria-label', 'place of the cut');
  panel.scale.classList.add('scale');
  const labels = row('Labels', panel.names, panel.all);
  labels.classList.add('labels');
  panel.element = make('div', {className: 'controls'}, labelled('Mesh', panel.mesh), labelled('Beside', panel.beside),
    labelled('Colour by', panel.colour), labelled('Worst', panel.worst, panel.worstText),
    labelled('Cut', panel.cut), row('Place', panel.place, flip.element), row('Look', lines.element, panel.reset), labels,
    panel.scale, panel.note);
  return panel;
}

/** Buttons that switch labels by name; `toggle(n, alone)`: alone with a double click. */
export function showLabels(panel, labels, visible, toggle) {
  panel.names.replaceChildren(...labels.map(({name, colour}, n) => {
    const swatch = make('span', {className: 'swatch'});
    swatch.style.background = colour;
    const button = make('button', {type: 'button', title: 'double click: this one alone'}, swatch, name);
    button.setAttribute('aria-pressed', String(visible[n]));
    button.addEventListener('click', () => toggle(n, false));
    button.addEventListener('dblclick', () => toggle(n, true));
    return button;
  }));
}

export function markLabels(panel, visible) {
  [...panel.names.children].forEach((button, n) => button.setAttribute('aria-pressed', String(visible[n])));
}

/** The colours of a quality with its figures. */
export function showScale(panel, by) {
  panel.scale.hidden = by === 'label';
  if (by === 'label') return;
  const {worst, best, ticks} = qualities[by];
  const stops = Array.from({length: 21}, (_, n) => `rgb(${scaleColour(n / 20).join(' ')})`);
  const colours = make('div', {className: 'colours'});
  colours.style.background = `linear-gradient(to right, ${stops.join(', ')})`;
  panel.scale.lastChild.replaceChildren(colours, ...ticks.map((tick) => {
    const mark = make('span', {className: 'tick', textContent: String(tick)});
    mark.style.left = `${(100 * (tick - worst)) / (best - worst)}%`;
    return mark;
  }));
}
