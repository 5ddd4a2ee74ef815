// What is on the page as values, as a scene, as a command and as a link.
import { PRESETS } from "./presets.js";

/** The values that make the scene; numbers are texts, as they were typed. */
export const scene = { ...PRESETS[0].scene };

const NUMBER = /^[+-]?\d+(\.\d+)?([eE][+-]?\d+)?$/;
const spelt = (text) => (NUMBER.test(text) ? text : JSON.stringify(text));
const absent = (text) => Number(text) === 0 && text.trim() !== "";

/** The scene in TOML: what is solved, copied and shown. */
export function toml() {
  const { L, c, mu, r, g, top, n } = scene;
  const lines = ["[rod]", `length = ${spelt(L)}`, `wave_speed = ${spelt(c)}`];
  if (!absent(r)) lines.push(`damping = ${spelt(r)}`);
  if (top === "fixed") lines.push('top = "fixed"');
  lines.push("", "[impact]", `speed = ${spelt(mu)}`);
  if (!absent(g)) lines.push("", "[gravity]", `acceleration = ${spelt(g)}`);
  return [...lines, "", "[run]", `impacts = ${n}`, ""].join("\n");
}

/** A command line that solves the scene, for a POSIX shell. */
export const command = () => `dalembert solve - <<'END'\n${toml()}END\n`;

/** The scene and the time, as what follows # in a link. */
export const fragment = (time) => `#${new URLSearchParams({ ...scene, t: time })}`;

/** Takes the scene from what follows # in a link; the time, or null where there is none. */
export function read(hash) {
  const found = new URLSearchParams(hash.slice(1));
  for (const name of ["L", "c", "mu", "r", "g"]) {
    if (found.has(name)) scene[name] = found.get(name).slice(0, 60);
  }
  if (found.has("top")) scene.top = found.get("top") === "fixed" ? "fixed" : "free";
  if (found.has("n")) scene.n = Math.min(Math.max(Math.round(Number(found.get("n"))) || 1, 1), 20);
  const time = Number(found.get("t"));
  return found.has("t") && Number.isFinite(time) ? time : null;
}

/** The value of a text that is a number or a fraction; NaN for another. */
export function value(text) {
  const parts = text.split("/").map((part) => (part.trim() === "" ? NaN : Number(part)));
  return parts.length === 2 ? parts[0] / parts[1] : parts.length === 1 ? parts[0] : NaN;
}

/** A number to six digits, without zeros at its end. */
export const short = (x) => String(Number(x.toPrecision(6)));
