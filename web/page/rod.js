// The rod at one time, and its energies as bars.
import { colour, shaded } from "./colours.js";

/** Points along the rod that is drawn. */
export const POINTS = 121;

/** How many times displacements are enlarged where nothing else is chosen: strains and heights stay in the picture. */
export const enlargement = ({ strain, rise, length }) => Math.min(0.6 / strain, (0.9 * length) / rise) || 1;

/** How much greater than usual letters and lines are: as the canvas is, and as the reader has set the letters. */
export const zoomed = ({ clientWidth, clientHeight }, usual) => Math.max(
  parseFloat(getComputedStyle(document.documentElement).fontSize) / 16,
  Math.min(clientWidth / usual, clientHeight / 290),
);

/** A canvas, whose `usual` width is given, ready to be drawn on in CSS pixels, sharp on every screen. */
export function prepare(canvas, usual) {
  const ratio = window.devicePixelRatio || 1;
  const { clientWidth: width, clientHeight: height } = canvas;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  const em = zoomed(canvas, usual);
  setSize(pen, 13 * em);
  return { pen, width, height, ratio, em };
}

const setSize = (pen, size) => { pen.font = `${size}px system-ui, 'DejaVu Sans', sans-serif`; };

/** A name as it stands on the page: `E_h` in parts, every other one a subscript. */
export const lowered = (name) => name.split(/_([A-Za-z])/);

/** Writes a name, whose letters are `size` high, with its subscripts: beginning at x, or in the middle of it. */
export function write(pen, name, x, y, size) {
  const sizes = [size, 0.75 * size];
  const widths = lowered(name).map((part, k) => {
    setSize(pen, sizes[k % 2]);
    return pen.measureText(part).width;
  });
  let left = pen.textAlign === "center" ? x - widths.reduce((a, b) => a + b) / 2 : x;
  const align = pen.textAlign;
  pen.textAlign = "left";
  lowered(name).forEach((part, k) => {
    setSize(pen, sizes[k % 2]);
    pen.fillText(part, left, y + (k % 2) * 0.25 * size);
    left += widths[k];
  });
  pen.textAlign = align;
  setSize(pen, size);
}

/**
 * Draws the rod with the displacements and strains `found`, in colours that end at the strain `most`; energies are
 * `[E_h, E_z]`, `sizes` the greatest of all in the run.
 */
export function drawRod(canvas, { sizes, fixed }, found, most, factor, [translation, vibration], centre) {
  const { pen, width, height, em } = prepare(canvas, 176);
  const { length, rise } = sizes;
  const ground = height - 46 * em;
  // The upper end swings about the centre of mass.
  const reach = 1.12 * length + factor * rise;
  const place = (y) => ground - (y / reach) * (ground - 14);
  const narrow = width < 120 * em;
  const [left, thick] = (narrow ? [4, 22] : [22, 44]).map((x) => x * em);

  for (let k = 0; k + 1 < POINTS; k += 1) {
    const y = (j) => place((length * j) / (POINTS - 1) + factor * found[j]);
    pen.fillStyle = shaded((found[POINTS + k] + found[POINTS + k + 1]) / 2, most);
    pen.fillRect(left, y(k + 1) - 0.4, thick, y(k) - y(k + 1) + 0.8);
  }
  const [low, high] = [place(factor * found[0]), place(length + factor * found[POINTS - 1])];
  pen.strokeStyle = colour.ink;
  pen.lineWidth = 1.2 * em;
  pen.strokeRect(left, high, thick, low - high);
  pen.lineWidth = 2 * em;
  const middle = place(length / 2 + factor * centre);
  line(pen, left - 6 * em, middle, left + thick + 6 * em, middle);
  // The colours of the rod are the same in both themes.
  line(pen, left, middle, left + thick, middle, "#000");
  const edge = left + thick + (narrow ? 4 : 16);
  hatch(pen, 0, edge, ground, em);
  if (fixed) hatch(pen, 0, edge, high, -em);

  // E_h is below zero where the centre of mass is deeper than its speed can lift it.
  const [bar, apart] = (narrow ? [16, 9] : [22, 4]).map((x) => x * em);
  const from = width - 2 * bar - (narrow ? 11 : 14) * em;
  const scale = (ground - 14) / (sizes.most - sizes.least || 1);
  const zero = ground + scale * sizes.least;
  pen.textAlign = "center";
  [[translation, "translation", "E_h"], [vibration, "vibration", "E_z"]].forEach(([size, name, label], k) => {
    const x = from + k * (bar + apart);
    const end = Math.max(Math.min(zero - size * scale, ground + 12), 2);
    pen.fillStyle = colour[name];
    pen.fillRect(x, Math.min(end, zero), bar, Math.abs(end - zero));
    pen.fillStyle = colour.ink;
    write(pen, label, x + bar / 2, height - 8 * em, 13 * em);
  });
  pen.lineWidth = em;
  line(pen, from - 3, zero, width - 2, zero);
  pen.fillText("h", left + thick + 13 * em, middle + 4 * em);
}

function line(pen, x0, y0, x1, y1, ink = colour.ink) {
  pen.strokeStyle = ink;
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}

/** What does not move: a line, hatched below, or above it where `em` is negative. */
function hatch(pen, from, to, y, em) {
  const wide = 8 * Math.abs(em);
  pen.lineWidth = wide / 5;
  line(pen, from, y, to, y);
  pen.lineWidth = wide / 8;
  for (let x = from + wide / 2; x < to + wide / 2; x += wide) {
    line(pen, Math.min(x, to), y, Math.max(x - wide, from), y + 8 * em);
  }
}
