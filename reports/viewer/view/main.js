// The 3D view of the report: every mesh of the page, one alone or two beside each other.
import {colouring, qualities} from './colours.js';
import {centreOf, decodeMesh, inflate} from './decode_mesh.js';
import {make, makePanel, markLabels, showLabels, showScale} from './panel.js';
import {View} from './scene.js';
import {facesOf, sectionOf, surfaceOf} from './surface.js';
import {cutPlane, radiusOf, worstPoints} from './space.js';
import style from './view.css';

const FIRST_DIRECTION = [1, -1.6, 0.9];

class MeshView {
  constructor(place, headers) {
    this.headers = headers;
    this.decoded = new Map();
    this.panel = makePanel(headers);
    this.canvas = make('canvas', {tabIndex: 0});
    this.canvas.setAttribute('aria-label', 'Mesh in 3D. Drag or arrow keys turn it, the wheel, two fingers or + and - zoom.');
    this.names = make('div', {className: 'pane-names'});
    this.under = make('div', {className: 'under'});
    this.under.setAttribute('role', 'status');
    this.stage = make('div', {className: 'stage'}, this.canvas, this.names, this.under);
    place.replaceChildren(make('style', {textContent: style}), this.stage, this.panel.element);
    this.view = new View(this.canvas);
    this.visible = new Map(); // by the name of a label, so that two meshes of an image switch alike
    this.shown = [];
    this.listen();
  }

  listen() {
    const {panel} = this;
    const listen = (control, event, react) => control.addEventListener(event, () => react());
    listen(panel.mesh, 'change', () => this.showMeshes());
    listen(panel.beside, 'change', () => this.showMeshes());
    listen(panel.colour, 'change', () => this.build());
    for (const control of [panel.cut, panel.flip]) listen(control, 'change', () => this.cutAgain());
    listen(panel.place, 'input', () => this.cutAgain());
    listen(panel.lines, 'change', () => this.restyle());
    listen(panel.worst, 'input', () => this.showWorst());
    listen(panel.reset, 'click', () => this.view.look(this.radius(), FIRST_DIRECTION));
    listen(panel.all, 'click', () => this.switchLabels(() => true));
    new ResizeObserver(() => this.view.resize()).observe(this.stage);
    this.canvas.addEventListener('keydown', (event) => this.key(event));
    this.listenForPicks();
  }

  listenForPicks() {
    let down = null;
    this.canvas.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; });
    this.canvas.addEventListener('pointerup', (event) => {
      if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) this.pick(event.clientX, event.clientY);
      down = null;
    });
  }

  key(event) {
    const step = Math.PI / 24;
    const actions = {
      ArrowLeft: () => this.view.turn(-step, 0), ArrowRight: () => this.view.turn(step, 0),
      ArrowUp: () => this.view.turn(0, step), ArrowDown: () => this.view.turn(0, -step),
      '+': () => this.view.near(1.15), '-': () => this.view.near(1 / 1.15), Home: () => this.panel.reset.click(),
    };
    if (actions[event.key] && !event.ctrlKey && !event.altKey && !event.metaKey) {
      event.preventDefault();
      actions[event.key]();
    }
  }

  async meshOf(n, centre) {
    const key = `${n} ${centre}`;
    if (!this.decoded.has(key)) {
      this.decoded.clear(); // a phone has no room for all; the two that are shown are kept below
      this.shown.forEach((one) => this.decoded.set(one.key, one.mesh));
      const bytes = await inflate(document.getElementById(`view-mesh-${this.headers[n].data}`).textContent);
      this.decoded.set(key, decodeMesh(this.headers[n], bytes, centre));
    }
    return {key, mesh: this.decoded.get(key), header: this.headers[n], centre};
  }

  /** Shows what the two choices say. Meshes of one case lie in the same place, others around their own centres. */
  async showMeshes() {
    const turn = (this.turn = (this.turn ?? 0) + 1);
    const numbers = [this.panel.mesh, this.panel.beside].map((choice) => Number(choice.value)).filter((n) => n >= 0);
    const first = this.headers[numbers[0]];
    const centreFor = (n) => centreOf(this.headers[n].case === first.case ? first : this.headers[n]);
    const before = this.shown[0]?.header.case;
    const shown = [];
    for (const n of numbers) shown.push(await this.meshOf(n, centreFor(n)));
    if (turn !== this.turn) return; // another choice was made meanwhile
    this.shown = shown;
    this.stage.classList.toggle('two', shown.length === 2);
    this.view.setPaneCount(shown.length);
    this.describe();
    this.build();
    if (before !== first.case) this.view.look(this.radius(), FIRST_DIRECTION);
  }

  radius() {
    return Math.max(...this.shown.map(({header}) => radiusOf(header)));
  }

  describe() {
    const labels = [...new Map(this.shown.flatMap(({header}) => header.labels).map((label) => [label.name, label])).values()];
    this.labels = labels;
    showLabels(this.panel, labels, labels.map(({name}) => this.isVisible(name)), (n, alone) => {
      const name = labels[n].name;
      this.switchLabels((other) => (alone ? other === name : other === name ? !this.isVisible(name) : this.isVisible(other)));
    });
    this.panel.worst.max = String(Math.max(...this.shown.map(({header}) => header.worst.length)));
    this.panel.note.textContent = this.shown.map(({header}) => `${header.case}, ${header.mesher}: ${header.note}`).join(' ');
    const stacked = this.view.isStacked();
    this.names.replaceChildren(...this.shown.map(({header}, n) => {
      const name = make('span', {textContent: `${header.case}, ${header.mesher}`});
      if (n === 1) name.style[stacked ? 'top' : 'left'] = '50%';
      return name;
    }));
    this.under.textContent = '';
  }

  isVisible(name) {
    return this.visible.get(name) ?? true;
  }

  switchLabels(isOn) {
    this.visible = new Map(this.labels.map(({name}) => [name, isOn(name)]));
    markLabels(this.panel, this.labels.map(({name}) => this.isVisible(name)));
    this.build();
  }

  /** Surface, section and worst elements anew. */
  build() {
    showScale(this.panel, this.panel.colour.value);
    this.shown.forEach((one, n) => {
      one.isOn = one.header.labels.map(({name}) => this.isVisible(name));
      one.colourOf = colouring(one.mesh, one.header.labels.map(({colour}) => colour), this.panel.colour.value);
      this.view.panes[n].set('surface', surfaceOf(one.mesh, one.isOn), one.colourOf);
    });
    this.cutAgain();
    this.showWorst();
  }

  cutAgain() {
    const {panel, view} = this;
    const share = panel.place.value / panel.place.max;
    const direction = panel.cut.value === 'view' ? view.camera.position.clone().sub(view.controls.target).toArray() : null;
    this.cut = cutPlane(panel.cut.value, share, panel.flip.checked, this.shown[0].header, this.shown[0].centre, direction);
    this.shown.forEach((one, n) => {
      const section = this.cut ? sectionOf(one.mesh, one.isOn, this.cut) : facesOf([]);
      view.panes[n].set('section', section, one.colourOf);
    });
    this.restyle();
  }

  showWorst() {
    const count = Number(this.panel.worst.value);
    this.shown.forEach((one, n) => {
      const worst = one.header.worst.filter(({label}) => one.isOn[label]).slice(0, count);
      one.worst = worst;
      this.view.panes[n].set('worst', facesOf(worst.map((tet) => worstPoints(tet, one.header, one.centre))), () => [214, 40, 40]);
    });
    const range = ({worst}) => (worst.length ? `${worst[0].angle}° to ${worst.at(-1).angle}°` : 'none');
    this.panel.worstText.textContent = count ? `${count}: ${this.shown.map(range).join('; ')}` : 'not shown';
    this.restyle();
  }

  restyle() {
    const ghost = Number(this.panel.worst.value) > 0;
    this.view.panes.forEach((pane) => pane.style({lines: this.panel.lines.checked, ghost, cut: this.cut}));
    this.view.draw();
  }

  pick(x, y) {
    const hit = this.view.tetAt(x, y, this.cut);
    if (!hit) {
      this.under.textContent = '';
      return;
    }
    const {header, mesh, worst} = this.shown[hit.pane];
    const isWorst = hit.part === 'worst';
    const label = isWorst ? worst[hit.tet].label : mesh.labels[hit.tet];
    const angle = isWorst ? worst[hit.tet].angle : Math.round((10 * mesh.angle[hit.tet]) / qualities.angle.steps) / 10;
    const ratio = isWorst ? worst[hit.tet].ratio : Math.round((100 * mesh.ratio[hit.tet]) / qualities.ratio.steps) / 100;
    this.under.textContent = `${header.labels[label].name}\nsmallest dihedral angle ${angle}°, mean ratio ${ratio}`;
  }
}

/** Begins when the view is about to be seen, for decoding takes a moment. */
function start() {
  const place = document.getElementById('view');
  if (!place) return;
  const begin = async () => {
    try {
      const meshView = new MeshView(place, JSON.parse(document.getElementById('view-meshes').textContent));
      await meshView.showMeshes();
      place.meshView = meshView; // for tests
    } catch (error) {
      place.replaceChildren(make('p', {className: 'note', textContent: `The view cannot be shown here: ${error.message}`}));
    }
  };
  const observer = new IntersectionObserver((entries) => {
    if (entries.some((entry) => entry.isIntersecting)) {
      observer.disconnect();
      begin();
    }
  }, {rootMargin: '300px'});
  observer.observe(place);
}

start();
