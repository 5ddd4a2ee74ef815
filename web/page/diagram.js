// The pictures over time: field, stress and energies, drawn by the engine as `dalembert plot` draws them.
/** Millimetres of a pixel. */
const MM = 25.4 / 96;

/**
 * Width, height and letters of a place in mm. These are greater than usual as the place is, and as the reader has set
 * the letters.
 */
export const sized = ({ clientWidth, clientHeight }, usual) => [clientWidth, clientHeight, 13 * Math.max(
  parseFloat(getComputedStyle(document.documentElement).fontSize) / 16,
  Math.min(clientWidth / usual, clientHeight / 290),
)].map((pixels) => pixels * MM);

export class Diagram {
  constructor(place, engine) {
    Object.assign(this, { place, engine, greatest: 1 });
  }

  /** Draws the pictures of `shot` between the times of `view`; whether no others took their place meanwhile. */
  async show(shot, view) {
    // A copy, by which later pictures are told from these.
    const asked = { ...view };
    this.asked = asked;
    const found = await this.engine.ask("screen", shot.number, view.from, view.to, ...sized(this.place, 560));
    if (!found || asked !== this.asked) return false;
    this.place.innerHTML = found.svg;
    this.place.firstElementChild.setAttribute("aria-hidden", "true");
    const frame = this.place.querySelector(".panel > rect");
    const [left, wide] = ["x", "width"].map((name) => Number(frame.getAttribute(name)) / MM);
    Object.assign(this, { shown: asked, left, wide, greatest: found.greatest });
    return true;
  }

  /** Where a time stands, in pixels. */
  at(time) {
    const { from, to } = this.shown ?? { from: 0, to: 1 };
    return this.left + (this.wide * (time - from)) / (to - from);
  }

  /** The time at a place. */
  time(place) {
    const { from, to } = this.shown;
    return from + ((place - this.left) / this.wide) * (to - from);
  }
}
