// The drawing of one or two meshes side by side, with one camera and one cut for both.
import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, FrontSide, GLSL3, Mesh, PerspectiveCamera, RawShaderMaterial, Raycaster,
  Scene, Vector2, Vector4, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {cornerColours} from './colours.js';

const vertexShader = `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
in vec3 position, color, sides;
out vec3 vColour, vSides, vView, vPlace;
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  vColour = color;
  vSides = sides;
  vView = view.xyz;
  vPlace = position;
  gl_Position = projectionMatrix * view;
}`;

// Flat shading by a light at the camera. Lines fade where triangles are hardly wider than they.
const fragmentShader = `
precision highp float;
uniform vec4 cut;
uniform float lines, opacity, shade;
in vec3 vColour, vSides, vView, vPlace;
out vec4 colour;
void main() {
  if (dot(cut.xyz, vPlace) > cut.w) discard;
  vec3 normal = normalize(cross(dFdx(vView), dFdy(vView)));
  float light = 1.0 - shade * 0.65 * (1.0 - abs(dot(normal, normalize(vView))));
  vec3 width = fwidth(vSides);
  vec3 near = vSides / max(width, vec3(1e-6));
  float line = 1.0 - smoothstep(0.25, 1.1, min(near.x, min(near.y, near.z)));
  float coarse = 1.0 - smoothstep(0.12, 0.45, max(width.x, max(width.y, width.z)));
  colour = vec4(mix(vColour * light, vec3(0.08), 0.6 * lines * line * coarse), opacity);
}`;

const NO_CUT = [0, 0, 0, 1];
const FILL = 0.82; // of the ball around the box, whose corners are empty

function material(side) {
  return new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader, fragmentShader, side,
    uniforms: {cut: {value: new Vector4(...NO_CUT)}, lines: {value: 1}, opacity: {value: 1}, shade: {value: 1}},
  });
}

function geometryOf(triangles, colourOf) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(triangles.positions, 3));
  geometry.setAttribute('sides', new BufferAttribute(triangles.sides, 3, true));
  geometry.setAttribute('color', new BufferAttribute(cornerColours(triangles, colourOf), 3, true));
  return geometry;
}

/** What is drawn of one mesh. */
class Pane {
  constructor() {
    this.scene = new Scene();
    this.scene.background = new Color(0xffffff);
    this.parts = {surface: material(FrontSide), section: material(DoubleSide), worst: material(DoubleSide)};
    for (const [name, look] of Object.entries(this.parts)) {
      this.parts[name] = new Mesh(new BufferGeometry(), look);
      this.parts[name].frustumCulled = false;
      this.scene.add(this.parts[name]);
    }
    this.parts.worst.renderOrder = 1;
    this.parts.section.material.uniforms.shade.value = 0.3; // it is flat, and its colours are to be read
    this.triangles = {};
  }

  set(name, triangles, colourOf) {
    this.parts[name].geometry.dispose();
    this.parts[name].geometry = geometryOf(triangles, colourOf);
    this.triangles[name] = triangles;
  }

  /** `ghost`: the surface is but a hint around what lies within. */
  style({lines, ghost, cut}) {
    for (const [name, part] of Object.entries(this.parts)) {
      const {uniforms} = part.material;
      uniforms.lines.value = lines && !(ghost && name === 'surface') ? 1 : 0;
      uniforms.cut.value.set(...(cut && name === 'surface' ? [...cut.normal, cut.offset] : NO_CUT));
      const fades = ghost && name !== 'worst';
      uniforms.opacity.value = fades ? 0.16 : 1;
      part.material.transparent = fades;
      part.material.depthWrite = !fades;
    }
  }

  /** The tet under the pointer, as the part it is drawn by and its number; null without one. */
  tetAt(raycaster, cut) {
    const isCutAway = ({object, point}) => object === this.parts.surface && cut &&
      cut.normal[0] * point.x + cut.normal[1] * point.y + cut.normal[2] * point.z > cut.offset;
    const ghost = this.parts.surface.material.transparent;
    const parts = ghost ? [this.parts.worst] : [this.parts.surface, this.parts.section];
    const hit = raycaster.intersectObjects(parts).find((one) => !isCutAway(one));
    if (!hit) return null;
    const name = Object.keys(this.parts).find((key) => this.parts[key] === hit.object);
    return {part: name, tet: this.triangles[name].tets[hit.faceIndex]};
  }
}

/** The canvas with its panes. `onDraw` is called after each drawing. */
export class View {
  constructor(canvas, onDraw = () => {}) {
    this.canvas = canvas;
    this.onDraw = onDraw;
    this.renderer = new WebGLRenderer({canvas, antialias: true});
    this.renderer.autoClear = false;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.camera = new PerspectiveCamera(30, 1, 1, 1000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.panes = [new Pane()];
    this.pending = false;
  }

  setPaneCount(count) {
    while (this.panes.length < count) this.panes.push(new Pane());
    this.panes.length = count;
    this.resize();
  }

  /** Looks at a ball of a radius around the origin from a side; `direction` points from the origin to the camera. */
  look(radius, direction) {
    this.radius = radius;
    const length = Math.hypot(...direction);
    const tall = Math.min(1, this.paneAspect());
    const distance = (FILL * radius) / Math.sin((this.camera.fov / 2) * (Math.PI / 180)) / tall;
    this.camera.position.set(...direction.map((d) => (d / length) * distance));
    this.camera.near = distance / 100;
    this.camera.far = distance * 10;
    this.camera.updateProjectionMatrix();
    this.controls.target.set(0, 0, 0);
    this.controls.update();
    this.draw();
  }

  /** Turns the camera around the target, or nears it by a factor. */
  turn(aroundUp, upwards) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const length = offset.length();
    const azimuth = Math.atan2(offset.y, offset.x) + aroundUp;
    const height = Math.min(Math.max(Math.asin(offset.z / length) + upwards, -1.5), 1.5);
    offset.set(Math.cos(height) * Math.cos(azimuth), Math.cos(height) * Math.sin(azimuth), Math.sin(height));
    this.camera.position.copy(this.controls.target).addScaledVector(offset, length);
    this.controls.update();
    this.draw();
  }

  near(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(1 / factor).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  isStacked() {
    return this.canvas.clientHeight > this.canvas.clientWidth;
  }

  paneAspect() {
    const {width, height} = this.rectangle(0);
    return width / height;
  }

  /** Where a pane is drawn, in CSS pixels from the lower left. */
  rectangle(n) {
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    const count = this.panes.length;
    if (this.isStacked()) return {x: 0, y: ((count - 1 - n) * height) / count, width, height: height / count};
    return {x: (n * width) / count, y: 0, width: width / count, height};
  }

  resize() {
    this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
    this.draw();
  }

  /** Draws once before the next frame, however often it is asked. */
  draw() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.drawNow();
    });
  }

  drawNow() {
    this.renderer.setScissorTest(false);
    this.renderer.setClearColor(0xffffff);
    this.renderer.clear();
    this.renderer.setScissorTest(true);
    this.panes.forEach((pane, n) => {
      const {x, y, width, height} = this.rectangle(n);
      this.renderer.setViewport(x, y, width, height);
      this.renderer.setScissor(x, y, width, height);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.renderer.render(pane.scene, this.camera);
    });
    this.onDraw();
  }

  /** The pane and tet under a place of the window. */
  tetAt(clientX, clientY, cut) {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [clientX - box.left, box.bottom - clientY];
    const n = this.panes.findIndex((_, pane) => {
      const r = this.rectangle(pane);
      return x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
    });
    if (n < 0) return null;
    const r = this.rectangle(n);
    const raycaster = new Raycaster();
    raycaster.setFromCamera(new Vector2((2 * (x - r.x)) / r.width - 1, (2 * (y - r.y)) / r.height - 1), this.camera);
    const hit = this.panes[n].tetAt(raycaster, cut);
    return hit && {pane: n, ...hit};
  }

  /** The picture's bytes, red, green, blue, opacity, from below: for tests. */
  pixels() {
    this.drawNow();
    const gl = this.renderer.getContext();
    const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return {width: gl.drawingBufferWidth, height: gl.drawingBufferHeight, bytes};
  }
}
