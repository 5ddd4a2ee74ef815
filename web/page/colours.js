// The colours of the page, for canvases: read from the style sheet, which has them for both themes.

const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const parts = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
const STEPS = 256;

export let colour = {};
/** Red, green and blue from the most compressed to the most stretched, in steps. */
let ramp = new Uint8ClampedArray(3 * STEPS);

export function readColours() {
  for (const name of ["page", "panel", "line", "faint", "ink", "soft", "accent", "translation", "vibration"]) {
    colour[name] = style(name);
  }
  const anchors = style("diverging").split(",").map((hex) => parts(hex.trim()));
  for (let k = 0; k < STEPS; k += 1) {
    const at = (k / (STEPS - 1)) * (anchors.length - 1);
    const below = Math.min(Math.floor(at), anchors.length - 2);
    for (let j = 0; j < 3; j += 1) {
      ramp[3 * k + j] = anchors[below][j] + (at - below) * (anchors[below + 1][j] - anchors[below][j]);
    }
  }
}

/** Where in the ramp a strain stands, whose greatest size is `most`. */
function shade(strain, most) {
  const part = most > 0 ? strain / most : 0;
  return 3 * Math.round(((Math.min(Math.max(part, -1), 1) + 1) / 2) * (STEPS - 1));
}

export function shaded(strain, most) {
  const k = shade(strain, most);
  return `rgb(${ramp[k]} ${ramp[k + 1]} ${ramp[k + 2]})`;
}
