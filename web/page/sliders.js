// The values of the scene: sliders, fields, and the two numbers that decide everything.
import { scene, short, value } from "./scene.js";

/** What a slider sets, its unit in the scene, and from which `g t₁`, `t₁` its other number follows. */
const VALUES = [
  { name: "mu", label: "μ, impact speed", ratio: "M", title: "M = μ/(g t₁)" },
  { name: "r", label: "r, damping", ratio: "R", title: "R = r t₁" },
  { name: "g", label: "g, gravity" },
];
const NOTCHES = 400;

const round = () => (2 * value(scene.L)) / value(scene.c);

/** The least of 1, 2, 5, 10, … that is not below x. */
function nice(x) {
  const unit = 10 ** Math.floor(Math.log10(x));
  return [1, 2, 5, 10].find((k) => k * unit >= x * (1 - 1e-12)) * unit;
}

/** The right end of a slider: so that its value stands in the left half. */
function range(name) {
  const given = value(scene[name]);
  if (name === "r") return Math.max(4 / round(), nice(given || 1e-9) * (given > 4 / round() ? 2 : 0));
  const other = name === "mu" ? value(scene.g) * round() : value(scene.mu) / round();
  return nice(2 * (given > 0 ? given : other > 0 ? other : 1));
}

export class Sliders {
  /** Fills `place`; calls `changed` after every change of the scene. */
  constructor(place, changed) {
    this.changed = changed;
    this.fields = {};
    const element = (tag, attributes = {}, ...children) => {
      const made = Object.assign(document.createElement(tag), attributes);
      made.append(...children);
      return made;
    };
    for (const { name, label, ratio, title } of VALUES) {
      const slider = element("input", { type: "range", min: 0, max: NOTCHES, step: 1, id: `${name}-slider` });
      slider.setAttribute("aria-label", label);
      const field = this.field(name, label);
      const parts = [element("label", { htmlFor: `${name}-field` }, label), field, slider];
      if (ratio) {
        this.fields[ratio] = element("input", { type: "text", inputMode: "decimal", title, id: `${ratio}-field` });
        this.fields[ratio].addEventListener("change", () => this.setRatio(ratio));
        parts.push(element("label", { htmlFor: `${ratio}-field` }, title), this.fields[ratio]);
      }
      slider.addEventListener("input", () => {
        scene[name] = short((slider.value / NOTCHES) * this.ranges[name]);
        this.refresh(name);
        changed();
      });
      this.fields[`${name}-slider`] = slider;
      place.append(element("div", { className: "row" }, ...parts));
    }
    const bounces = element("input", { type: "range", min: 1, max: 20, step: 1, id: "n-slider" });
    const count = element("output", { htmlFor: "n-slider" });
    Object.assign(this, { bounces, count });
    bounces.addEventListener("input", () => this.set("n", Number(bounces.value)));
    place.append(element("div", { className: "row" }, element("label", { htmlFor: "n-slider" }, "bounces"), count, bounces));
    this.top = element("select", { id: "top" }, new Option("free", "free"), new Option("held", "fixed"));
    this.top.addEventListener("change", () => this.set("top", this.top.value));
    place.append(element("div", { className: "row" }, element("label", { htmlFor: "top" }, "upper end"), this.top));
    const pair = ["L", "c"].map((name) => element("label", {}, name, this.field(name, name)));
    place.append(element("div", { className: "row pair" }, ...pair));
    this.refit();
  }

  field(name, label) {
    const field = Object.assign(document.createElement("input"), { type: "text", inputMode: "decimal", id: `${name}-field` });
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

  /** Shows the scene, with sliders that reach as far as its values ask for. */
  refit() {
    this.ranges = Object.fromEntries(VALUES.map(({ name }) => [name, range(name)]));
    this.refresh();
  }

  /** Shows the scene; the slider that is moved stays. */
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
