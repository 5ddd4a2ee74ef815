// Sliders and fields of the values, and of the two dimensionless numbers on which the motion depends.
import { scene, short, value } from "./scene.js";

/** Values that have a slider, each with its symbol, its label and the dimensionless number that follows from it. */
const VALUES = [
  { name: "mu", symbol: "μ", label: "μ, impact speed", ratio: "M", title: "M = μ/(g t₁)" },
  { name: "r", symbol: "r", label: "r, damping", ratio: "R", title: "R = r t₁" },
  { name: "g", symbol: "g", label: "g, gravity", hint: "gravity" },
];
const NOTCHES = 400;

const round = () => (2 * value(scene.L)) / value(scene.c);

/** Returns the least of 1, 2 and 5 times a power of ten that is not below x. */
function nice(x) {
  const unit = 10 ** Math.floor(Math.log10(x));
  return [1, 2, 5, 10].find((k) => k * unit >= x * (1 - 1e-12)) * unit;
}

/** Returns the right end of a slider, chosen so that its value is in the left half. */
function range(name) {
  const given = value(scene[name]);
  if (name === "r") return Math.max(4 / round(), nice(given || 1e-9) * (given > 4 / round() ? 2 : 0));
  const other = name === "mu" ? value(scene.g) * round() : value(scene.mu) / round();
  return nice(2 * (given > 0 ? given : other > 0 ? other : 1));
}

export class Sliders {
  /** Adds the fields to an element; calls `changed` after every change of the scene. */
  constructor(place, changed) {
    this.changed = changed;
    this.fields = {};
    const element = (tag, attributes = {}, ...children) => {
      const made = Object.assign(document.createElement(tag), attributes);
      made.append(...children);
      return made;
    };
    for (const { name, symbol, label, ratio, title, hint } of VALUES) {
      const slider = element("input", { type: "range", min: 0, max: NOTCHES, step: 1, id: `${name}-slider` });
      slider.setAttribute("aria-label", label);
      const parts = [element("label", { htmlFor: `${name}-field`, title: label }, symbol), this.field(name, label)];
      if (ratio) {
        this.fields[ratio] = element("input", { type: "text", inputMode: "decimal", id: `${ratio}-field` });
        this.fields[ratio].addEventListener("change", () => this.setRatio(ratio));
        parts.push(element("label", { htmlFor: `${ratio}-field` }, title), this.fields[ratio]);
      } else {
        parts.push(element("span", {}, hint));
      }
      slider.addEventListener("input", () => {
        scene[name] = short((slider.value / NOTCHES) * this.ranges[name]);
        this.refresh(name);
        changed();
      });
      this.fields[`${name}-slider`] = slider;
      place.append(element("div", { className: "row" }, ...parts, slider));
    }
    this.bounces = element("input", { type: "range", min: 1, max: 20, step: 1, id: "n-slider" });
    this.count = element("output", { htmlFor: "n-slider" });
    this.bounces.addEventListener("input", () => this.set("n", Number(this.bounces.value)));
    const bounces = [element("label", { htmlFor: "n-slider" }, "bounces"), this.bounces, this.count];
    this.top = element("select", { id: "top" }, new Option("free", "free"), new Option("held", "fixed"));
    this.top.addEventListener("change", () => this.set("top", this.top.value));
    const rest = ["L", "c"].map((name) => element("label", {}, name, this.field(name, name)));
    rest.push(element("label", {}, "top", this.top));
    place.append(element("div", { className: "line" }, ...bounces), element("div", { className: "line" }, ...rest));
    this.refit();
  }

  field(name, label) {
    const field = document.createElement("input");
    Object.assign(field, { type: "text", inputMode: "decimal", id: `${name}-field` });
    field.setAttribute("aria-label", label);
    field.addEventListener("change", () => this.set(name, field.value.trim()));
    this.fields[name] = field;
    return field;
  }

  set(name, to) {
    scene[name] = to;
    this.refit();
    this.changed();
  }

  setRatio(ratio) {
    const given = value(this.fields[ratio].value);
    if (ratio === "R") this.set("r", short(given / round()));
    else this.set("mu", short(given * value(scene.g) * round()));
  }

  /** Shows the scene, after adapting the ranges of the sliders to its values. */
  refit() {
    this.ranges = Object.fromEntries(VALUES.map(({ name }) => [name, range(name)]));
    this.refresh();
  }

  /** Shows the scene; the slider that is being moved is left alone. */
  refresh(moved) {
    for (const { name } of VALUES) {
      if (name !== moved) this.fields[`${name}-slider`].value = (NOTCHES * value(scene[name])) / this.ranges[name];
      this.fields[`${name}-slider`].setAttribute("aria-valuetext", scene[name]);
    }
    for (const name of ["mu", "r", "g", "L", "c"]) this.fields[name].value = scene[name];
    this.top.value = scene.top;
    this.bounces.value = this.count.value = scene.n;
  }

  /** Shows `R` and `M` as the command prints them. */
  ratios([, , damping, speed]) {
    this.fields.R.value = damping;
    this.fields.M.value = speed;
    this.fields.M.disabled = speed === "∞";
  }
}
