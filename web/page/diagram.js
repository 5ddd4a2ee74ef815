// The pictures over time: field, stress and energies, which the engine draws as `dalembert plot` does.
/** Width of a pixel in mm. */
const MM = 25.4 / 96;

/**
 * Returns the width, the height and the height of letters of an element in mm. Letters grow with the element, compared
 * with its `usual` width, and with the reader's font size.
 */
export const sized = ({ clientWidth, clientHeight }, usual) => [clientWidth, clientHeight, 13 * Math.max(
  parseFloat(getComputedStyle(document.documentElement).fontSize) / 16,
  Math.min(clientWidth / usual, clientHeight / 290),
)].map((pixels) => pixels * MM);

export class Diagram {
  constructor(place, engine) {
    Object.assign(this, { place, engine, colorLimit: 1 });
  }

  /** Draws the pictures of `shot` for the times of `view`. Returns false if later ones were asked for meanwhile. */
  async show(shot, view) {
    // The copy identifies this request.
    const asked = { ...view };
    this.asked = asked;
    const found = await this.engine.ask("screen", shot.number, view.from, view.to, ...sized(this.place, 560));
    if (!found || asked !== this.asked) return false;
    this.place.innerHTML = found.svg;
    this.place.firstElementChild.setAttribute("aria-hidden", "true");
    const frame = this.place.querySelector(".panel > rect");
    const [left, wide] = ["x", "width"].map((name) => Number(frame.getAttribute(name)) / MM);
    Object.assign(this, { shown: asked, left, wide, colorLimit: found.colorLimit });
    return true;
  }

  /** Returns the place of a time in pixels. */
  at(time) {
    const { from, to } = this.shown ?? { from: 0, to: 1 };
    return this.left + (this.wide * (time - from)) / (to - from);
  }

  /** Returns the time at a place in pixels. */
  time(place) {
    const { from, to } = this.shown;
    return from + ((place - this.left) / this.wide) * (to - from);
  }
}
