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
    name: "Chaos at μ = 3/2",
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
