// Colours of labels and of qualities.

/** What tets can be coloured by, beside their label. `worst` and above it up to `best`; more is better. */
export const qualities = {
  angle: {title: 'smallest dihedral angle (deg)', steps: 3.5, worst: 0, best: 70.5, ticks: [0, 10, 20, 30, 40, 50, 60, 70]},
  ratio: {title: 'mean ratio', steps: 250, worst: 0, best: 1, ticks: [0, 0.2, 0.4, 0.6, 0.8, 1]},
};

// Viridis (matplotlib, CC0), which the colour-blind can read and which gets lighter all the way.
const viridis = [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [53, 183, 121],
  [109, 205, 89], [180, 222, 44], [253, 231, 37]];

/** Red, green, blue (0 to 255) of a share from 0, worst, to 1, best. */
export function scaleColour(share) {
  const place = Math.min(Math.max(share, 0), 1) * (viridis.length - 1);
  const low = Math.min(Math.floor(place), viridis.length - 2);
  return viridis[low].map((from, channel) => Math.round(from + (place - low) * (viridis[low + 1][channel] - from)));
}

/** "#rrggbb" as three numbers. */
export function rgbOf(hexadecimal) {
  return [1, 3, 5].map((at) => Number.parseInt(hexadecimal.slice(at, at + 2), 16));
}

/** A function from a tet's number to its colour. */
export function colouring(mesh, labelColours, by) {
  if (by === 'label') {
    const colours = labelColours.map(rgbOf);
    return (tet) => colours[mesh.labels[tet]];
  }
  const {steps, worst, best} = qualities[by];
  const table = Array.from({length: 256}, (_, step) => scaleColour((step / steps - worst) / (best - worst)));
  return (tet) => table[mesh[by][tet]];
}

/** Three bytes for each corner of triangles. */
export function cornerColours(triangles, colourOf) {
  const colours = new Uint8Array(9 * triangles.count);
  for (let n = 0; n < triangles.count; ++n) {
    const colour = colourOf(triangles.tets[n]);
    for (let corner = 0; corner < 3; ++corner) colours.set(colour, 9 * n + 3 * corner);
  }
  return colours;
}
