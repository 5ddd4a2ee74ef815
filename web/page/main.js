// The page: connects the engine, the pictures, the sliders and the link.
import { CHAINS, PRESETS } from "./presets.js";
import { chainFragment, command, fragment, read, readChain, scene, toml, value } from "./scene.js";
import { Engine } from "./engine.js";
import { joined } from "./module.js";
import { Diagram, sized } from "./diagram.js";
import { Sliders } from "./sliders.js";

/** Time limits of a scene in milliseconds, in doubles and in longer numbers, and the rest before the latter begin. */
const [MOST, LONGER, REST] = [1000, 5000, 200];
const COLUMNS = ["contact from", "to", "t_b", "e_P", "e_E²", "E", "E_h", "E_z"];
const JOINT_COLUMNS = ["joint", "contact from", "to", "duration", "impulse", "greatest force"];

const $ = (id) => document.getElementById(id);
const engine = new Engine();
const diagram = new Diagram($("diagram"), engine);
/** Solved scene, time of the cursor, times that are shown, whether the motion plays, time and id of its last frame. */
let [shot, now, view, playing, last, frame] = [null, 0, null, false, 0, 0];
/** Scene to be solved next, number of the last one, whether the cursor has moved, and the running tasks. */
let [wanted, number, moved, solving, posing, doing] = [null, 0, false, null, null, 0];
/** Sentences about results that are not settled. */
let doubts = [];
/** Index of the chain that is shown, or −1. */
let chain = -1;

/**
 * Solves the scene and shows it; `another` scene is shown from its start. While a scene is being solved, only the
 * newest of the following ones is kept.
 */
function solve(another = false) {
  const round = (2 * value(scene.L)) / value(scene.c);
  wanted = { text: toml(), fixed: scene.top === "fixed", round, another: another || wanted?.another };
  $("scene").textContent = wanted.text;
  $("command").textContent = command();
  return (solving ??= busily(async () => {
    while (wanted) {
      const next = wanted;
      wanted = null;
      const fresh = await solved(next, false);
      document.querySelector("main").classList.toggle("stale", !fresh);
      if (fresh) await show(fresh);
      if (doubts.length) await settleDoubts(next, fresh);
    }
    solving = null;
  }));
}

/** Solves a scene that doubles do not settle in longer numbers, and shows it, if no other scene is wanted. */
async function settleDoubts(scene, shown) {
  await new Promise((rested) => setTimeout(rested, REST));
  if (wanted) return;
  const settled = await solved(scene, true);
  if (!settled) return;
  document.querySelector("main").classList.remove("stale");
  await show(shown ? { ...settled, another: false } : settled);
}

/** Runs a task, during which the page is marked as busy. */
async function busily(act) {
  doing += 1;
  document.documentElement.dataset.busy = "";
  try {
    await act();
  } catch (error) {
    refused(error);
  }
  doing -= 1;
  if (doing === 0) delete document.documentElement.dataset.busy;
}

/** Spans that the pictures can show: the whole run, the default of `plot`, the first flight. */
const SPANS = {
  all: () => ({ from: 0, to: shot.end }),
  contacts: () => ({ from: shot.span[0], to: shot.span[1] }),
  flight: () => ({ from: shot.events[1] ?? 0, to: shot.events[2] ?? shot.end }),
};

/** Returns the span that is chosen first: not the whole run if the contact is shorter than a fiftieth of it. */
const natural = () => (shot.events[1] < shot.end / 50 ? "contacts" : "all");

function show(fresh) {
  // A span chosen for another rod is not kept.
  const span = fresh.another || !view || $("span").value === natural() ? null : $("span").value;
  shot = fresh;
  now = fresh.another ? 0 : within(now);
  if (span !== "") setSpan(span ?? natural());
  if (span === null && now > view.to) now = rounded(0.3 * view.to);
  else if (view.to > shot.end) setSpan("all");
  sliders.ratios(shot.parameters);
  $("status").textContent = `c = ${shot.parameters[0]}, t₁ = ${shot.parameters[1]}; ${shot.ending}`;
  fillContacts();
  return draw();
}

/** Returns the answer to a scene, in doubles or in longer numbers; null, after showing the reason, if there is none. */
async function solved({ text, ...rest }, longer) {
  try {
    performance.mark("asked");
    number += 1;
    const found = await engine.ask("solve", number, text, longer ? LONGER : MOST, longer);
    if (!longer) performance.measure("solve", "asked");
    say("", found.doubts, longer);
    return { ...found, ...rest };
  } catch (error) {
    if (longer && !error.failed) say("", doubts);
    else refused(error, longer);
    return null;
  }
}

/** Shows the reason for which there is no answer. */
function refused(error, last = true) {
  const [, beyond] = error.message.match(/^not settled: ([^]*)/) ?? [];
  const failed = "The engine has failed at this scene; please report it, and load the page again";
  say(beyond ? "" : error.failed ? failed : named(error.message), beyond ? [beyond] : [], last);
}

/** Splits a text such as `E_h` into parts, of which every other one is a subscript. */
const withSubscripts = (text) => text.split(/_([A-Za-z])/).map((part, k) => {
  if (k % 2 === 0) return part;
  return Object.assign(document.createElement("sub"), { textContent: part });
});

/**
 * Shows a mistake, or the doubts: sentences about results that are not settled. They are the `last` word where longer
 * numbers do not settle them either; then the command is shown too.
 */
function say(mistake, found, last = true) {
  doubts = found;
  const text = mistake || doubts.map((doubt) => `Not settled: ${doubt}.`).join(" ");
  $("doubt").textContent = text;
  $("doubt").hidden = text === "";
  if (chain >= 0 && text) $("status").textContent = text;
  $("beyond").hidden = doubts.length === 0 || !last;
}

/** Shows a span by its name, which stays selected until another span is shown. */
function setSpan(name) {
  view = SPANS[name]();
  $("span").value = name;
}

/** Describes the pictures for readers who do not see them. */
function describe() {
  const shown = `from t = ${Number(view.from.toPrecision(4))} to ${Number(view.to.toPrecision(4))}`;
  const strain = Number(shot.strain.toPrecision(3));
  $("diagram").setAttribute("aria-label", `Over time, ${shown}: the strain along the rod, up to ${strain}; the strain at `
    + `the ground; the energies of the centre of mass and of the vibration. ${shot.contacts.length / COLUMNS.length} `
    + `contacts in the whole run, which ends at t = ${Number(shot.end.toPrecision(6))}.`);
  $("rod").setAttribute("aria-label", `The rod at t = ${$("now").value}, `
    + `${shot.events.filter((time) => time <= now).length % 2 ? "on the ground" : "in flight"}.`);
}

/** Draws the pictures over time, then moves the cursor to its place in them and draws the rod in their colours. */
const draw = () => busily(async () => {
  describe();
  if (!await diagram.show(shot, view)) return;
  performance.mark("drawn");
  await moveTo(now);
});

function schedule() {
  frame ||= requestAnimationFrame(tick);
}

function tick(time) {
  frame = 0;
  if (!playing) return;
  // The frame may have begun before the key was pressed.
  const passed = Math.min(Math.max(time - last, 0), 100) / 1000;
  const next = now + passed * Number($("speed").value) * 0.75 * shot.round;
  if (next >= shot.end) play(false);
  follow(within(next));
  moveTo(next);
  last = time;
  schedule();
}

/** Shows the following or the previous span if a time is outside the pictures. */
function follow(time) {
  const wide = view.to - view.from;
  if (time <= view.to && time >= view.from) return;
  const from = Math.max(0, Math.min(time - 0.1 * wide, shot.end - wide));
  view = { from, to: from + wide };
  $("span").value = "";
  draw();
}

function play(on) {
  if (on && now > 0.999 * shot.end) {
    now = 0;
    follow(now);
  }
  playing = on;
  last = performance.now();
  $("play").textContent = on ? "❚❚ Pause" : "▶ Play";
  if (on) schedule();
  else settle();
}

/** Returns the enlargement of displacements, relative to the one that fits; undefined draws them to scale. */
const enlarged = () => ($("drawn").value === "true" ? undefined : Number($("drawn").value));

const within = (time) => Math.max(0, Math.min(time, shot.end));

/** Moves the cursor to a time, and shows the rod and the values there. */
function moveTo(time) {
  now = within(time);
  $("now").value = now.toFixed(places());
  const place = diagram.at(now);
  $("cursor").style.transform = `translateX(${place - 1}px)`;
  $("cursor").hidden = now < view.from || now > view.to;
  $("time").value = (now - view.from) / (view.to - view.from);
  $("time").setAttribute("aria-valuetext", `t = ${$("now").value}`);
  showContact();
  return pose();
}

/** Asks for the rod and the values at the cursor. Meanwhile only the newest place of the cursor is kept. */
function pose() {
  moved = true;
  return (posing ??= (async () => {
    while (moved) {
      moved = false;
      const look = [...sized($("rod"), 176), enlarged(), diagram.colorLimit];
      const found = await engine.ask("at", shot.number, now, ...look).catch(refused);
      if (!found) continue;
      const [h, E, E_h, E_z, end, strain] = found.values;
      fill($("values"), { h, E_h, E_z, E, "v(0,t)": end, "v_x(0,t)": strain });
      $("rod").innerHTML = found.rod;
    }
    posing = null;
  })());
}

/** Returns the decimals that distinguish two thousand times of the span. */
const places = () => Math.max(0, Math.min(12, 4 - Math.floor(Math.log10(view.to - view.from))));

/** Rounds a time as it is shown, so that the link and the command can repeat it. */
const rounded = (time) => Number(time.toFixed(places()));

/** Returns the first rounded time that is not before an event. */
const justAfter = (time) => rounded(time + (rounded(time) < time - 1e-12 * shot.end ? 10 ** -places() : 0));

/** Updates the link and the spoken text after the cursor has come to rest. */
const settle = () => busily(async () => {
  const there = moveTo(rounded(now));
  history.replaceState(null, "", fragment($("now").value));
  await there;
  describe();
  const words = (id) => [...$(id).children].map((part) => part.dataset.name ?? part.textContent).join(" ");
  $("spoken").textContent = `t = ${$("now").value}. ${words("values")}. ${$("which").textContent}: ${words("bounce")}`;
});

function stepTo(time) {
  play(false);
  follow(within(time));
  now = within(time);
  settle();
}

function fill(list, values) {
  const texts = Object.entries(values);
  if (list.children.length !== 2 * texts.length) {
    list.replaceChildren(...texts.flatMap(([name]) => {
      const term = document.createElement("dt");
      const swatch = { E_h: "translation", E_z: "vibration" }[name];
      if (swatch) {
        const box = document.createElement("span");
        box.className = "swatch";
        box.style.background = `var(--${swatch})`;
        term.append(box);
      }
      term.append(...withSubscripts(name));
      term.dataset.name = name;
      return [term, document.createElement("dd")];
    }));
  }
  texts.forEach(([, text], k) => { list.children[2 * k + 1].textContent = text.replace("-", "−"); });
}

/** Names of the fields of the page by the keys of the scene. */
const NAMES = { length: "L", wave_speed: "c", damping: "r", speed: "μ", acceleration: "g" };
/** Replaces the key in a mistake by the name of the field. */
const named = (mistake) => mistake.replace(/^found (\w+)(?= = )/, (all, key) => `found ${NAMES[key] ?? key}`);

/** Shows the contact at the cursor, or the one before it. */
function showContact() {
  let k = 0;
  while (shot.events[2 * k + 2] <= now) k += 1;
  const rows = [...$("contacts").tBodies[0].rows];
  if (rows[k]?.getAttribute("aria-current") !== "true") {
    rows.forEach((row) => row.removeAttribute("aria-current"));
    rows[k]?.setAttribute("aria-current", "true");
    // The table is scrolled, and the page is not.
    $("contacts").parentElement.scrollTop = rows[k] ? rows[k].offsetTop - 2 * rows[k].offsetHeight : 0;
  }
  if (rows.length === 0) {
    $("which").textContent = "No contact";
    return fill($("bounce"), {});
  }
  const [, , t_b, e_P, e_E] = shot.contacts.slice(k * COLUMNS.length);
  $("which").textContent = `Contact ${k + 1} of ${rows.length}`;
  fill($("bounce"), { t_b, e_P, "e_E²": e_E });
}

/** Returns a row of a table. */
function row(cells, tag) {
  const made = document.createElement("tr");
  made.append(...cells.map((cell) => {
    const place = document.createElement(tag);
    place.append(...(typeof cell === "string" ? withSubscripts(cell) : [cell]));
    return place;
  }));
  return made;
}

const signed = (text) => text.replace("-", "−");

function fillContacts() {
  const go = (k) => {
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: k + 1 });
    button.setAttribute("aria-label", `Go to contact ${k + 1}`);
    button.addEventListener("click", () => stepTo(justAfter(shot.events[2 * k])));
    return button;
  };
  const table = $("contacts");
  table.createTHead().replaceChildren(row(["", ...COLUMNS], "th"));
  const body = table.tBodies[0] ?? table.createTBody();
  const count = shot.contacts.length / COLUMNS.length;
  body.replaceChildren(...Array.from({ length: count }, (_, k) => {
    const cells = shot.contacts.slice(k * COLUMNS.length, (k + 1) * COLUMNS.length);
    return row([go(k), ...cells.map(signed)], "td");
  }));
}

/** Changes the span by a factor, around a time. */
function zoom(factor, around = now) {
  const wide = Math.min(Math.max((view.to - view.from) * factor, shot.end / 1000), shot.end);
  const part = (around - view.from) / (view.to - view.from);
  const from = Math.max(0, Math.min(around - wide * Math.min(Math.max(part, 0), 1), shot.end - wide));
  view = { from, to: from + wide };
  $("span").value = wide === shot.end ? "all" : "";
  draw();
}

/** Shows the rod, or with an index a chain of bars in its place. */
function turnTo(k) {
  chain = k;
  document.querySelector("main").hidden = k >= 0;
  $("chain").hidden = k < 0;
  if (k >= 0) play(false);
}

/** Solves the chain and shows it. */
const showChain = () => busily(async () => {
  const { text, story } = CHAINS[chain];
  $("story").replaceChildren(...withSubscripts(story));
  $("scene").textContent = text;
  $("command").textContent = command(text);
  say("", []);
  mark();
  const asked = chain;
  const found = await engine.ask("chain", text, ...sized($("stack"), 760));
  if (asked !== chain) return;
  $("stack").innerHTML = found.svg;
  const count = found.contacts.length / JOINT_COLUMNS.length;
  $("status").textContent = `${count} ${count === 1 ? "contact" : "contacts"} up to t = ${found.end}`;
  const table = $("joints");
  table.createTHead().replaceChildren(row(JOINT_COLUMNS, "th"));
  (table.tBodies[0] ?? table.createTBody()).replaceChildren(...Array.from({ length: count }, (_, k) => (
    row(found.contacts.slice(k * JOINT_COLUMNS.length, (k + 1) * JOINT_COLUMNS.length).map(signed), "td"))));
  performance.mark("drawn");
});

/** Shows a chain, and notes it in the link. */
function chooseChain(k) {
  turnTo(k);
  history.replaceState(null, "", chainFragment(k));
  return showChain();
}

async function choose(k) {
  if (k >= PRESETS.length) return chooseChain(k - PRESETS.length);
  turnTo(-1);
  Object.assign(scene, PRESETS[k].scene);
  $("story").replaceChildren(...withSubscripts(PRESETS[k].story));
  sliders.refit();
  mark();
  await solve(true);
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  if (shot) play(!still);
}

/** Marks the story whose scene is shown, if there is one. */
function mark() {
  const same = (story) => Object.entries(story.scene).every(([name, text]) => String(scene[name]) === String(text));
  const found = chain < 0 ? PRESETS.findIndex(same) : -1;
  const pressed = chain < 0 ? found : PRESETS.length + chain;
  buttons.forEach((button, k) => button.setAttribute("aria-pressed", String(k === pressed)));
  if (chain < 0) $("story").replaceChildren(...(found >= 0 ? withSubscripts(PRESETS[found].story) : []));
}

function setTheme(dark) {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  $("theme").textContent = dark ? "Light" : "Dark";
  if (chain < 0 && shot) draw();
}

async function copy(text, what) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const field = document.createElement("textarea");
    field.value = text;
    document.body.append(field);
    field.select();
    document.execCommand("copy");
    field.remove();
  }
  $("done").value = `${what} copied`;
}

/** Saves data as a file. */
function keep(blob, name) {
  const link = document.createElement("a");
  Object.assign(link, { href: URL.createObjectURL(blob), download: name }).click();
  URL.revokeObjectURL(link.href);
  $("done").value = `${name} saved`;
}

/** Returns the pictures of the span as the SVG that `dalembert plot` writes. */
async function sheet() {
  if (chain >= 0) return new Blob([(await engine.ask("chain", CHAINS[chain].text)).svg], { type: "image/svg+xml" });
  const span = $("span").value === "contacts" ? [] : [view.from, view.to];
  const found = await engine.ask("page", shot.number, ...span);
  return found && new Blob([found.svg], { type: "image/svg+xml" });
}

async function saveSvg() {
  const blob = await sheet();
  if (blob) keep(blob, "dalembert.svg");
}

/** Saves the same picture as PNG with 300 pixels an inch. */
async function savePng() {
  const blob = await sheet();
  if (!blob) return;
  const image = new Image();
  image.src = URL.createObjectURL(blob);
  await image.decode();
  const [width, height] = [image.width, image.height].map((side) => Math.round(side * (300 / 96)));
  const paper = new OffscreenCanvas(width, height);
  paper.getContext("2d").drawImage(image, 0, 0, width, height);
  URL.revokeObjectURL(image.src);
  keep(await paper.convertToBlob({ type: "image/png" }), "dalembert.png");
}

const nextEvent = () => stepTo(shot.events.map(justAfter).find((time) => time > now) ?? shot.end);
const eventBefore = () => stepTo(shot.events.map(justAfter).findLast((time) => time < now) ?? 0);
const KEYS = {
  " ": () => play(!playing), n: nextEvent, p: eventBefore, "+": () => zoom(0.5), "-": () => zoom(2),
  0: () => zoom(Infinity), d: () => $("theme").click(), Home: () => stepTo(0), End: () => stepTo(shot.end),
  ArrowLeft: (wide) => stepTo(now - step(wide)), ArrowRight: (wide) => stepTo(now + step(wide)),
};
const step = (wide) => ((view.to - view.from) / 200) * (wide ? 10 : 1);

function listen() {
  document.addEventListener("keydown", (event) => {
    const { target, key } = event;
    if (event.ctrlKey || event.altKey || event.metaKey || !(shot || chain >= 0)) return;
    if (target.matches("input[type=text], select")) return;
    if (target.matches("input[type=range]:not(#time)") && /^(Arrow|Home|End)/.test(key)) return;
    if (target.matches("button, summary") && key === " ") return;
    const story = buttons[key - 1] && (() => choose(key - 1));
    const act = chain >= 0 && key !== "d" ? story : KEYS[key] ?? story;
    if (!act) return;
    event.preventDefault();
    act(event.shiftKey);
  });
  $("play").addEventListener("click", () => play(!playing));
  $("before").addEventListener("click", eventBefore);
  $("after").addEventListener("click", nextEvent);
  $("in").addEventListener("click", () => zoom(0.5));
  $("out").addEventListener("click", () => zoom(2));
  $("span").addEventListener("change", () => {
    setSpan($("span").value);
    if (now < view.from || now > view.to) stepTo(view.from);
    draw();
  });
  $("drawn").addEventListener("change", () => moveTo(now));
  $("time").addEventListener("input", () => stepTo(view.from + $("time").value * (view.to - view.from)));
  const scrub = (event) => {
    if (event.buttons) stepTo(Math.min(Math.max(diagram.time(event.offsetX), view.from), view.to));
  };
  $("diagram").addEventListener("pointerdown", scrub);
  $("diagram").addEventListener("pointermove", scrub);
  $("diagram").addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(event.deltaY > 0 ? 1.25 : 0.8, diagram.time(event.offsetX));
  }, { passive: false });
  $("theme").addEventListener("click", () => setTheme(document.documentElement.dataset.theme === "light"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) => setTheme(event.matches));
  $("copy-scene").addEventListener("click", () => copy($("scene").textContent, "scene"));
  $("copy-command").addEventListener("click", () => copy($("command").textContent, "command"));
  $("copy-link").addEventListener("click", () => copy(
    location.href.split("#")[0] + (chain < 0 ? fragment($("now").value) : chainFragment(chain)), "link"));
  $("save").addEventListener("click", () => busily(saveSvg));
  $("save-png").addEventListener("click", () => busily(savePng));
  addEventListener("hashchange", open);
  new ResizeObserver(() => chain < 0 && shot && draw()).observe($("pictures"));
  new ResizeObserver(() => chain >= 0 && showChain()).observe($("stack"));
}

/** Shows the scene and the time of the link. */
async function open() {
  const asked = readChain(location.hash);
  turnTo(asked);
  if (asked >= 0) {
    await showChain();
    performance.mark("shown");
    return;
  }
  const time = read(location.hash);
  sliders.refit();
  mark();
  await solve(true);
  if (!shot) {
    // The scene of the link cannot be shown: the first story takes its place, and the mistake stays. For a scene beyond
    // doubles the fields and the command, which settles it, stay too.
    const [mistake, beyond, asked] = [$("doubt").textContent, !$("beyond").hidden, { ...scene }];
    Object.assign(scene, PRESETS[0].scene);
    sliders.refit();
    mark();
    await solve(true);
    if (beyond) {
      Object.assign(scene, asked);
      sliders.refit();
      mark();
      $("command").textContent = command();
    }
    say(`The scene of the link is not shown: ${mistake}`, []);
    $("beyond").hidden = !beyond;
  }
  if (shot) await moveTo(time ?? rounded(0.3 * (view.to < shot.end ? view.to : shot.round)));
  performance.mark("shown");
}

const buttons = [...PRESETS, ...CHAINS].map(({ name }, k) => {
  const button = Object.assign(document.createElement("button"), { type: "button", textContent: name });
  button.addEventListener("click", () => choose(k));
  $(k < PRESETS.length ? "presets" : "chains").append(button);
  return button;
});
setTheme(matchMedia("(prefers-color-scheme: dark)").matches);
const sliders = new Sliders($("sliders"), async () => {
  mark();
  await solve();
  if (shot && !playing) settle();
});
try {
  await engine.load(joined(unpacked.parts), unpacked.glue);
  await open();
  listen();
} catch (error) {
  say(`This browser cannot run the page, which needs WebAssembly: ${error.message}`, []);
}
