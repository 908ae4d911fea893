// Where meshes and cuts lie. Positions are physical LPS mm from a centre.

const normals = {x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]};

/** The radius of the ball around the box of a mesh. */
export function radiusOf(header) {
  return Math.hypot(...header.step.map((step) => (65535 / 2) * step));
}

/**
 * The plane of a cut: `share` of the way through the box of a mesh along x, y, z or, for "view", `direction`, from which
 * the camera looks. What lies beyond it, where normal . p > offset, is cut away; null without a cut.
 */
export function cutPlane(axis, share, flipped, header, centre, direction) {
  if (axis === '') return null;
  let normal = normals[axis];
  if (axis === 'view') {
    const length = Math.hypot(...direction);
    normal = direction.map((d) => d / length);
  }
  const middle = header.origin.map((low, n) => low + (65535 / 2) * header.step[n] - centre[n]);
  const reach = normal.reduce((sum, one, n) => sum + Math.abs(one) * (65535 / 2) * header.step[n], 0);
  const offset = normal.reduce((sum, one, n) => sum + one * middle[n], 0) + (2 * share - 1) * reach;
  // A cut at the very end of the box would leave nothing, or cut nothing, so it stays a hair within.
  const within = offset + (share <= 0 ? 1e-4 : share >= 1 ? -1e-4 : 0) * reach;
  return flipped ? {normal: normal.map((one) => -one), offset: -within} : {normal, offset: within};
}

/** The points of one of the worst tets, twelve numbers. */
export function worstPoints(tet, header, centre) {
  return tet.points.map((value, n) => value + header.origin[n % 3] - centre[n % 3]);
}
