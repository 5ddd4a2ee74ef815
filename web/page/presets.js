// Scenes with a story of a few sentences each.
export const PRESETS = [
  {
    name: "A rod dropped on the ground",
    scene: { L: "1", c: "1", mu: "2.5", r: "0", g: "1", top: "free", n: 4 },
    story: "A wave of compression starts at the ground, runs up, comes back as tension and lifts the rod off after "
      + "exactly one round trip t₁ = 2L/c. The centre of mass leaves as fast as it came, but from a lower place: "
      + "what it lacks is the energy of the vibration. Each later landing meets this vibration in another phase, "
      + "and so no two are alike.",
  },
  {
    name: "The bounce that takes its energy back",
    scene: { L: "10", c: "30", mu: "10", r: "0", g: "10", top: "free", n: 4 },
    story: "The bar of Doyen, Ern and Piperno: the first bounce leaves 4/27 of the energy as vibration E_z. The "
      + "second landing comes just when the vibration has the opposite phase, and undoes all of it. So every "
      + "second contact gives back what the one before it took, and the motion repeats for ever.",
  },
  {
    name: "The rod that never bounces",
    scene: { L: "1", c: "1", mu: "1", r: "1.6", g: "0", top: "free", n: 4 },
    story: "With R = r t₁ = 3.2 the lowest mode of the rod is overdamped: from R = π on it creeps back without "
      + "swinging. The ground pushes ever less, but it never has to pull, and without gravity there is nothing "
      + "else to end the contact. Lower r to just below π/t₁, and the rod leaves after all, later and later the "
      + "closer you come.",
  },
  {
    name: "Rays that multiply",
    scene: { L: "1", c: "1", mu: "1.5", r: "0", g: "1", top: "free", n: 20 },
    story: "Here every bounce starts new rays, none of which ever ends, and so the x–t picture breaks into finer and "
      + "finer pieces. The impacts multiply with them, 373 019 up to t = 400, and by then a change of μ in its tenth "
      + "digit has moved the centre of mass in its sixth. Change μ in its third digit, and compare the last bounces.",
  },
  {
    name: "A landing without speed",
    scene: { L: "1", c: "1", mu: "1", r: "0", g: "1", top: "free", n: 9 },
    story: "At t = 31 the end touches the ground with the speed zero, and stays until t = 34. Such a landing is a "
      + "double root, which no number of digits can tell from a near miss, and exact roots can. Then the rod "
      + "flies without any vibration, and at t = 36 the whole motion begins anew.",
  },
];

/** Returns a body in TOML. */
const bar = (name, values) => {
  const lines = Object.entries(values).map(([key, x]) => `${key} = ${x}`);
  return ["[[body]]", `name = "${name}"`, ...lines, "", ""].join("\n");
};
// The wave speed is 5076 m/s.
const steel = (length, area) => ({ length, modulus: "200973052800", density: 7800, area });
const unit = { length: 1, wave_speed: 1, impedance: 1 };

// Chains of bars, each as a scene.
export const CHAINS = [
  {
    name: "Two bars",
    text: 'title = "Two dissimilar bars"\nunits = "other"\n\n'
      + bar("striker", { length: 10, modulus: 49, density: 0.01, velocity: 0.1 })
      + bar("target", { length: 10, modulus: 100, density: 0.01, gap: 0.01 }) + "[run]\ntime = 0.5\n",
    story: "The lower bar is the softer one, and its wave needs longer. It comes back as tension when the wave of the "
      + "upper bar has long returned, and is split at the joint: the force falls from 7/170 to 21/2890, and the bars part "
      + "at t = 27/70 only. Equal bars would exchange their velocities within one round trip. This is test 7.1.2 of "
      + "OpenFOAM's contact paper.",
  },
  {
    name: "Rod cradle",
    text: 'title = "Newton\'s cradle of rods"\nunits = "other"\n\n'
      + bar("first", { ...unit, velocity: 1 }) + bar("second", { ...unit, gap: 0.5 })
      + bar("third", { ...unit, gap: 0.25 }) + "[run]\ntime = 6\n",
    story: "Three equal rods: each hands its whole velocity on to the next. A contact lasts 2L/c, while the wave runs to "
      + "the far end of the rod that was hit and back. Rods in a row do what the balls of the cradle do, without any "
      + "vibration left behind. The impulse of every contact is that of the first rod.",
  },
  {
    name: "Hopkinson bar",
    text: 'title = "A split Hopkinson bar"\n\n' + bar("output bar", steel(3.1, "7.0685835e-4"))
      + bar("specimen", { ...steel(0.05, "4.9087385e-4"), modulus: "160770480000" })
      + bar("input bar", steel(3, "7.0685835e-4"))
      + bar("striker", { ...steel(0.6, "6.1575216e-4"), velocity: -5 }) + "[run]\ntime = 1.2e-3\n",
    story: "A steel striker from above sends a pulse of twice its travel time down the input bar. At the short specimen "
      + "a part of it turns back, and the rest climbs over in steps, one for each round trip in the specimen, until both "
      + "faces carry nearly the same force. From the reflected and the transmitted pulse one reads strain and stress of "
      + "the specimen.",
  },
];
