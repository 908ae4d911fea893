// The triangles that are drawn of a mesh: facets of its visible labels, and its section by a plane.
//
// Triangles are lists of positions, nine numbers each, with the number of the tet that each belongs to, and for each of
// their corners which sides are drawn as lines: `sides` has three bytes a corner, as barycentric coordinates of the sides
// opposite the corners, 255 everywhere for a side without a line.

/** A list of triangles that grows. */
class Triangles {
  constructor(capacity = 1024) {
    this.positions = new Float32Array(9 * capacity);
    this.sides = new Uint8Array(9 * capacity);
    this.tets = new Uint32Array(capacity);
    this.count = 0;
  }

  grow() {
    for (const name of ['positions', 'sides', 'tets']) {
      const grown = new this[name].constructor(2 * this[name].length);
      grown.set(this[name]);
      this[name] = grown;
    }
  }

  /** Corners are arrays of three numbers; `hidden`: bit i for the side opposite corner i. */
  add(a, b, c, tet, hidden = 0) {
    if (this.count === this.tets.length) this.grow();
    const at = 9 * this.count;
    this.positions.set(a, at);
    this.positions.set(b, at + 3);
    this.positions.set(c, at + 6);
    for (let corner = 0; corner < 3; ++corner) {
      for (let side = 0; side < 3; ++side) {
        this.sides[at + 3 * corner + side] = (hidden >> side) & 1 || side === corner ? 255 : 0;
      }
    }
    this.tets[this.count++] = tet;
  }

  done() {
    return {
      positions: this.positions.slice(0, 9 * this.count),
      sides: this.sides.slice(0, 9 * this.count),
      tets: this.tets.slice(0, this.count),
      count: this.count,
    };
  }
}

const pointOf = (mesh, vertex) => [mesh.positions[3 * vertex], mesh.positions[3 * vertex + 1], mesh.positions[3 * vertex + 2]];

/** Six times the volume of a tet, positive where d sees a, b, c counter-clockwise. */
function sixVolumes(a, b, c, d) {
  const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
  return (uy * vz - uz * vy) * (d[0] - a[0]) + (uz * vx - ux * vz) * (d[1] - a[1]) + (ux * vy - uy * vx) * (d[2] - a[2]);
}

/** Adds the face of a tet opposite a corner, counter-clockwise seen from outside the tet. */
function addFace(triangles, points, corner, tet) {
  const [a, b, c] = [0, 1, 2, 3].filter((n) => n !== corner).map((n) => points[n]);
  if (sixVolumes(a, b, c, points[corner]) > 0) triangles.add(a, c, b, tet);
  else triangles.add(a, b, c, tet);
}

/** The facets of the labels with visible[label], each as a face of its own tet: between two labels there are two. */
export function surfaceOf(mesh, visible) {
  const triangles = new Triangles();
  for (let t = 0; t < mesh.count; ++t) {
    if (!mesh.boundary[t] || !visible[mesh.labels[t]]) continue;
    const points = [0, 1, 2, 3].map((n) => pointOf(mesh, mesh.corners[4 * t + n]));
    for (let corner = 0; corner < 4; ++corner) {
      if ((mesh.boundary[t] >> corner) & 1) addFace(triangles, points, corner, t);
    }
  }
  return triangles.done();
}

/** All four faces of tets that are given by twelve numbers each. */
export function facesOf(tets) {
  const triangles = new Triangles(4 * Math.max(1, tets.length));
  tets.forEach((numbers, t) => {
    const points = [0, 3, 6, 9].map((n) => numbers.slice(n, n + 3));
    for (let corner = 0; corner < 4; ++corner) addFace(triangles, points, corner, t);
  });
  return triangles.done();
}

function crossing(mesh, inside, outside, distances) {
  const [a, b] = [pointOf(mesh, inside), pointOf(mesh, outside)];
  const share = distances[inside] / (distances[inside] - distances[outside]);
  return a.map((x, axis) => x + share * (b[axis] - x));
}

/** Adds the section of a tet, of which `above` corners are on one side of the plane and `below` on the other. */
function addSection(mesh, above, below, distances, triangles, tet) {
  if (above.length === 2) {
    const [a, b] = above;
    const [c, d] = below;
    const ring = [[a, c], [a, d], [b, d], [b, c]].map(([p, q]) => crossing(mesh, p, q, distances));
    triangles.add(ring[0], ring[1], ring[2], tet, 0b010);
    triangles.add(ring[0], ring[2], ring[3], tet, 0b100);
  } else {
    const [one] = above.length === 1 ? above : below;
    const others = above.length === 1 ? below : above;
    triangles.add(...others.map((other) => crossing(mesh, one, other, distances)), tet);
  }
}

/** The section of the labels with visible[label] by the plane of the points p with normal . p = offset. */
export function sectionOf(mesh, visible, {normal, offset}) {
  const vertices = mesh.positions.length / 3;
  const distances = new Float32Array(vertices);
  for (let v = 0; v < vertices; ++v) {
    distances[v] = normal[0] * mesh.positions[3 * v] + normal[1] * mesh.positions[3 * v + 1] +
      normal[2] * mesh.positions[3 * v + 2] - offset;
  }
  const triangles = new Triangles();
  for (let t = 0; t < mesh.count; ++t) {
    let bits = 0;
    for (let n = 0; n < 4; ++n) bits |= (distances[mesh.corners[4 * t + n]] > 0) << n;
    if (bits === 0 || bits === 15 || !visible[mesh.labels[t]]) continue;
    const corners = [0, 1, 2, 3].map((n) => mesh.corners[4 * t + n]);
    addSection(mesh, corners.filter((_, n) => (bits >> n) & 1), corners.filter((_, n) => !((bits >> n) & 1)), distances,
      triangles, t);
  }
  return triangles.done();
}
