// The rod at one time, and its energies as bars.
import { colour, shaded } from "./colours.js";

/** Points along the rod that is drawn. */
export const POINTS = 121;

/** How many times displacements are enlarged where nothing else is chosen: strains and heights stay in the picture. */
export const enlargement = ({ strain, rise, length }) => Math.min(0.6 / strain, (0.9 * length) / rise) || 1;

/** How much greater than usual the letters are: on a projector, or as the reader has set them. */
export const zoomed = () => parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;

/** A canvas ready to be drawn on in CSS pixels, sharp on every screen. */
export function prepare(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const { clientWidth: width, clientHeight: height } = canvas;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = `${13 * zoomed()}px system-ui, 'DejaVu Sans', sans-serif`;
  return { pen, width, height, ratio };
}

/**
 * Draws the rod with the displacements and strains `found`; energies are `[E_h, E_z]`, `sizes` the greatest of all in
 * the run.
 */
export function drawRod(canvas, { sizes, fixed }, found, factor, [translation, vibration], centre) {
  const { pen, width, height } = prepare(canvas);
  const { length, strain: most, rise } = sizes;
  const em = zoomed();
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
  pen.lineWidth = 1.2;
  pen.strokeRect(left, high, thick, low - high);
  pen.lineWidth = 2;
  line(pen, left - 6, place(length / 2 + factor * centre), left + thick + 6, place(length / 2 + factor * centre));
  const edge = left + thick + (narrow ? 4 : 16);
  hatch(pen, 0, edge, ground, 1);
  if (fixed) hatch(pen, 0, edge, high, -1);

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
    pen.fillText(label, x + bar / 2, height - 6);
  });
  pen.lineWidth = 1;
  line(pen, from - 3, zero, width - 2, zero);
  pen.fillText("h", left + thick + 13 * em, place(length / 2 + factor * centre) + 4);
}

function line(pen, x0, y0, x1, y1) {
  pen.strokeStyle = colour.ink;
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}

/** What does not move: a line, hatched on the side `down`. */
function hatch(pen, from, to, y, down) {
  pen.lineWidth = 1.5;
  line(pen, from, y, to, y);
  pen.lineWidth = 1;
  for (let x = from + 4; x < to + 4; x += 8) line(pen, Math.min(x, to), y, Math.max(x - 8, from), y + 8 * down);
}
