// The pictures over time: the x–t diagram, the stress at the ground and the energies, on one axis.
import { colour, ramp, shade } from "./colours.js";
import { prepare, write } from "./rod.js";

/** To the left, right, top and bottom of the panels, and between them. */
const MARGIN = [66, 12, 8, 26, 14];
/** Milliseconds that a question to the engine may take: between two, others have their turn. */
const EACH = 7;
/** Points and columns of the first, quick picture; points of the last one, whose columns are those of the screen. */
const COARSE = { columns: 90, rows: 24 };
const ROWS = 160;

/** About `count` round numbers between two. */
export function ticks(from, to, count) {
  const rough = (to - from) / count;
  const unit = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find((k) => k * unit >= rough) * unit;
  const found = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; k += 1) found.push(k * step);
  return found.map((x) => Number(x.toPrecision(12)));
}

/** A number of an axis in at most seven letters: with an exponent where it is great or small. */
export function shortest(x) {
  const size = Math.abs(x);
  const plain = size === 0 || (size >= 1e-3 && size < 1e5);
  return (plain ? String(x) : x.toExponential().replace("e+", "e")).replaceAll("-", "−");
}

export class Diagram {
  constructor(canvas, engine) {
    Object.assign(this, { canvas, engine });
  }

  /** Draws the pictures of `shot` between the times of `view`; whether all are drawn, or others took their place. */
  async show(shot, view) {
    // A copy, by which later pictures are told from these.
    Object.assign(this, { shot, view: { ...view }, energies: [] });
    const { pen, width, height, ratio, em } = prepare(this.canvas, 560);
    this.em = em;
    const [left, right, top, bottom, gap] = MARGIN.map((space) => space * this.em);
    const inner = height - top - bottom - 2 * gap;
    const panel = (top, tall) => ({ left, top, width: width - left - right, height: tall });
    this.panels = {
      field: panel(top, 0.52 * inner),
      stress: panel(top + 0.52 * inner + gap, 0.25 * inner),
      energy: panel(top + 0.77 * inner + 2 * gap, 0.23 * inner),
    };
    this.pen = pen;
    this.drawStress();
    this.axes();
    const fine = Math.min(Math.round(this.panels.field.width * ratio), 1200);
    return await this.field(COARSE.columns, COARSE.rows) && await this.energy(60)
      && await this.energy(Math.round(fine / 2)) && await this.field(fine, ROWS);
  }

  place(time) {
    const { field } = this.panels;
    return field.left + (field.width * (time - this.view.from)) / (this.view.to - this.view.from);
  }

  time(place) {
    const { field } = this.panels;
    return this.view.from + ((place - field.left) / field.width) * (this.view.to - this.view.from);
  }

  /** Asks for all columns, as many at a time as there is time for, and calls `draw` with them; false where others
   * came. */
  async columns(columns, what, rest, draw) {
    const { shot, view } = this;
    const at = (k) => view.from + ((view.to - view.from) * k) / columns;
    for (let [done, each] = [0, 0.5]; done < columns;) {
      const start = performance.now();
      const count = Math.max(1, Math.min(columns - done, Math.floor(EACH / each)));
      const found = await this.engine.ask(what, shot.number, at(done), at(done + count), count, ...rest);
      if (!found || view !== this.view) return false;
      each = Math.max((performance.now() - start) / count, 1e-3);
      draw(found, done, count);
      done += count;
    }
    return true;
  }

  field(columns, rows) {
    const image = new ImageData(columns, rows);
    const sheet = new OffscreenCanvas(columns, rows);
    const paper = sheet.getContext("2d");
    const { sizes } = this.shot;
    return this.columns(columns, "strains", [rows], (found, done, count) => {
      for (let i = 0; i < count; i += 1) {
        for (let j = 0; j < rows; j += 1) {
          const k = shade(found[i * rows + j], sizes.strain);
          const pixel = 4 * ((rows - 1 - j) * columns + done + i);
          image.data[pixel] = ramp[k];
          image.data[pixel + 1] = ramp[k + 1];
          image.data[pixel + 2] = ramp[k + 2];
          image.data[pixel + 3] = 255;
        }
      }
      paper.putImageData(image, 0, 0, done, 0, count, rows);
      const { left, top, width, height } = this.panels.field;
      const wide = width / columns;
      this.pen.imageSmoothingEnabled = false;
      this.pen.drawImage(sheet, done, 0, count, rows, left + done * wide, top, count * wide, height);
      this.contacts();
    });
  }

  energy(columns) {
    const all = [];
    return this.columns(columns, "energies", [], (found) => {
      all.push(...found);
      if (all.length === 2 * columns) {
        this.energies = all;
        this.drawEnergies();
      }
    });
  }

  /** When the end is on the ground: a line along the ground. */
  contacts() {
    const { left, top, width, height } = this.panels.field;
    const { events, end } = this.shot;
    this.pen.fillStyle = colour.ink;
    for (let k = 0; k < events.length; k += 2) {
      const from = Math.max(this.place(events[k]), left);
      const to = Math.min(this.place(events[k + 1] ?? end), left + width);
      if (to > from) this.pen.fillRect(from, Math.round(top + height), to - from, 4 * this.em);
    }
  }

  axes() {
    const { pen, panels, view } = this;
    const { field } = panels;
    this.labels(field, [[0, "0"], [1, "L"]], (part) => field.top + field.height * (1 - part), "x");
    pen.fillStyle = colour.ink;
    pen.textAlign = "center";
    const low = this.canvas.clientHeight - 6 * this.em;
    for (const time of this.times()) pen.fillText(shortest(time), this.place(time), low);
    pen.textAlign = "left";
    pen.fillText("t", 2, low);
  }

  times() {
    return ticks(this.view.from, this.view.to, Math.max(this.panels.field.width / (90 * this.em), 2));
  }

  /** A frame with values at its left. */
  labels(panel, values, place, name) {
    const { pen } = this;
    pen.strokeStyle = colour.line;
    pen.lineWidth = this.em;
    pen.strokeRect(panel.left - 0.5, panel.top - 0.5, panel.width + 1, panel.height + 1);
    pen.fillStyle = colour.ink;
    pen.textAlign = "right";
    for (const [value, text] of values) pen.fillText(text, panel.left - 5 * this.em, place(value) + 4 * this.em);
    pen.textAlign = "left";
    write(pen, name, 2, panel.top + 7 * this.em, 13 * this.em);
  }

  drawStress() {
    const { pen, shot, panels } = this;
    const panel = panels.stress;
    const line = shot.stress;
    let [low, high] = [0, 0];
    for (let k = 1; k < line.length; k += 2) [low, high] = [Math.min(low, line[k]), Math.max(high, line[k])];
    low = 1.08 * low || -1;
    const place = (value) => panel.top + (panel.height * (high - value)) / (high - low);
    this.grid(panel, ticks(low, high, 3), place, "v_x");
    this.clipped(panel, () => {
      pen.strokeStyle = colour.ink;
      pen.lineWidth = 1.6 * this.em;
      pen.beginPath();
      for (let k = 0; k < line.length; k += 2) pen.lineTo(this.place(line[k]), place(line[k + 1]));
      pen.stroke();
    });
  }

  drawEnergies() {
    const { pen, energies, panels } = this;
    const panel = panels.energy;
    pen.clearRect(0, panel.top - 6 * this.em, this.canvas.clientWidth, panel.height + 11 * this.em);
    const low = Math.min(0, ...energies);
    const high = 1.08 * Math.max(0, ...energies) || 1;
    const place = (value) => panel.top + (panel.height * (high - value)) / (high - low);
    const count = energies.length / 2;
    const x = (k) => panel.left + (panel.width * (k + 0.5)) / count;
    this.grid(panel, ticks(low, high, 3), place, "E");
    const curve = (of, name, wide) => {
      pen.beginPath();
      for (let k = 0; k < count; k += 1) pen.lineTo(x(k), place(of(k)));
      pen.strokeStyle = colour[name];
      pen.lineWidth = wide * this.em;
      pen.stroke();
    };
    this.clipped(panel, () => {
      curve((k) => energies[2 * k] + energies[2 * k + 1], "ink", 1);
      curve((k) => energies[2 * k], "translation", 2);
      curve((k) => energies[2 * k + 1], "vibration", 2);
    });
    pen.textAlign = "left";
    [["E_h", "translation"], ["E_z", "vibration"]].forEach(([text, name], k) => {
      pen.fillStyle = colour[name];
      write(pen, text, 2, panel.top + (23 + 17 * k) * this.em, 13 * this.em);
    });
  }

  grid(panel, values, place, name) {
    const { pen } = this;
    pen.fillStyle = colour.faint;
    for (const value of values) pen.fillRect(panel.left, place(value) - 0.5 * this.em, panel.width, this.em);
    for (const time of this.times()) pen.fillRect(this.place(time) - 0.5 * this.em, panel.top, this.em, panel.height);
    this.labels(panel, values.map((value) => [value, shortest(value)]), place, name);
  }

  clipped(panel, draw) {
    const { pen } = this;
    pen.save();
    pen.beginPath();
    pen.rect(panel.left, panel.top, panel.width, panel.height);
    pen.clip();
    draw();
    pen.restore();
  }
}
