// The values of the page, and the same as a scene, as a command and as a link.
import { CHAINS, PRESETS } from "./presets.js";

/** Values of the scene; numbers are texts, as they were typed. */
export const scene = { ...PRESETS[0].scene };

const NUMBER = /^[+-]?\d+(\.\d+)?([eE][+-]?\d+)?$/;
const tomlValue = (text) => (NUMBER.test(text) ? text : JSON.stringify(text));
const isZero = (text) => Number(text) === 0 && text.trim() !== "";

/** Returns the scene in TOML, as it is solved, copied and shown. */
export function toml() {
  const { L, c, mu, r, g, top, n } = scene;
  const lines = ["[rod]", `length = ${tomlValue(L)}`, `wave_speed = ${tomlValue(c)}`];
  if (!isZero(r)) lines.push(`damping = ${tomlValue(r)}`);
  if (top === "fixed") lines.push('top = "fixed"');
  lines.push("", "[impact]", `speed = ${tomlValue(mu)}`);
  if (!isZero(g)) lines.push("", "[gravity]", `acceleration = ${tomlValue(g)}`);
  return [...lines, "", "[run]", `impacts = ${n}`, ""].join("\n");
}

/** Returns a command line for a POSIX shell that solves a scene. */
export const command = (text = toml()) => `dalembert solve - <<'END'\n${text}END\n`;

/** Returns the fragment of a link that holds the scene and a time. */
export const fragment = (time) => `#${new URLSearchParams({ ...scene, t: time })}`;

/** Returns the fragment of a link that holds a chain, and the index of the chain that a fragment holds, or −1. */
export const chainFragment = (k) => `#chain=${k + 1}`;
export function readChain(hash) {
  const k = Number(new URLSearchParams(hash.slice(1)).get("chain")) - 1;
  return CHAINS[k] ? k : -1;
}

/** Reads the scene from the fragment of a link. Returns the time, or null if there is none. */
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

/** Returns the value of a text that is a number or a fraction; NaN for any other text. */
export function value(text) {
  const parts = text.split("/").map((part) => (part.trim() === "" ? NaN : Number(part)));
  return parts.length === 2 ? parts[0] / parts[1] : parts.length === 1 ? parts[0] : NaN;
}

/** Formats a number with six digits, without trailing zeros. */
export const short = (x) => String(Number(x.toPrecision(6)));
