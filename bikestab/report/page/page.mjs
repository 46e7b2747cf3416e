// What the page does: one chosen design and speed, and everything that follows from it.

import * as charts from "./charts.mjs";
import * as controls from "./controls.mjs";
import * as curves from "./curves.mjs";
import { drawRear, drawSide } from "./drawings.mjs";
import { eigenvaluesAt } from "./eigenvalues.mjs";
import { element, input } from "./elements.mjs";
import { intervalsOf, quarticAt } from "./intervals.mjs";
import { about, answer, around, command } from "./labels.mjs";
import { unpacked } from "./library.mjs";
import { closer, follow } from "./modes.mjs";
import { pushed } from "./motion.mjs";
import { opening } from "./opening.mjs";
import * as region from "./region.mjs";
import { save } from "./saving.mjs";
import { tableOf } from "./table.mjs";
import { machineAt, shownOf, within } from "./volumes.mjs";
import { fixed } from "./words.mjs";

const PUSH = 0.2; // rad/s of roll
const SPEEDS = 181; // of a curve of eigenvalues
const SECONDS = 5;
const PAUSE = 120; // ms without a change before tables and the surface's marks follow: they take long

/** @type {import("./volumes.mjs").Data} */
const data = JSON.parse(element("data").textContent ?? "");
const state = { volume: 0, sweep: /** @type {number[]} */ ([]), lam: 0, sigma: 0, V: 0, playing: false, time: 0 };
let motion = /** @type {import("./motion.mjs").Motion | null} */ (null);
let charted = false; // once the drawing library is there
let high = 10; // of the axes of eigenvalues
/** How long the computation of the last frame took [ms]; the charts' drawing is not in it. */
let spent = 0;

const volume = () => data.volumes[state.volume];
const machine = () => machineAt(volume(), state.sweep);
const shown = () => shownOf(machine(), volume().box);
const solid = region.hasWebGL();
/** @param {string} id @returns {SVGElement} */
const drawing = (id) => /** @type {any} */ (element(id));

/** Everything that follows from the choice. */
function computed() {
  const start = performance.now();
  const { lam, sigma, V } = state;
  const table = tableOf(machine(), lam, sigma);
  const intervals = intervalsOf(table);
  const [low, top] = volume().box.V;
  const speeds = Array.from({ length: SPEEDS }, (_, i) => Math.max(low + ((top - low) * i) / (SPEEDS - 1), 1e-6));
  const modes = follow(table, intervals, closer(table, speeds));
  const now = eigenvaluesAt(quarticAt(table, [V, 0]));
  motion = pushed(machine(), lam, sigma, V, PUSH, SECONDS);
  spent = performance.now() - start;
  return { table, modes, now, motion, chosen: { lam, sigma, V, intervals } };
}

/** What needs no library. @param {ReturnType<typeof computed>} found */
function atOnce(found) {
  answer(machine(), found, `${PUSH} rad/s of roll`);
  drawSide(drawing("side"), machine(), state.lam, state.sigma);
  region.drawOver(drawing("region-chosen"), machine().view, shown(), found.chosen);
  rear();
}

let waiting = 0;
/** @type {ReturnType<typeof setTimeout> | undefined} */
let later;

function update() {
  waiting ||= requestAnimationFrame(() => {
    waiting = 0;
    const found = computed();
    atOnce(found);
    if (charted) {
      charts.movePlane(element("plane"), found.chosen);
      curves.moveModes(element("modes"), found.modes, found.chosen, shown());
      curves.moveLocus(element("locus"), found.modes, found.now);
      curves.moveMotion(element("motion"), found.motion);
    }
    clearTimeout(later);
    later = setTimeout(() => {
      around(machine(), found, data.volumes);
      if (charted && solid) region.moveRegion(element("region"), shown(), found.chosen);
    }, PAUSE);
  });
}

/** The machine from behind at the clock's time, its angles enlarged to be seen. */
function rear() {
  if (!motion) return;
  const i = Math.min(Math.round((state.time / SECONDS) * (motion.t.length - 1)), motion.t.length - 1);
  const largest = Math.max(...motion.roll.slice(0, 60).map(Math.abs), 1e-9);
  /** @param {number} x */
  const limited = (x) => Math.max(-1.2, Math.min(1.2, (0.25 / largest) * x));
  drawRear(drawing("rear"), machine(), limited(motion.roll[i]), limited(motion.steer[i]));
  element("clock").textContent = `${fixed(state.time, 1)} s after the push`;
}

/** The first answer for a machine, and the picture of its region. */
function begin() {
  const found = computed();
  const picture = /** @type {HTMLImageElement} */ (element("region-picture"));
  picture.src = `data:image/png;base64,${machine().picture}`;
  atOnce(found);
  around(machine(), found, data.volumes);
  return found;
}

/** All charts anew, for another machine or other colours. */
async function draw() {
  const { modes, now, chosen, motion: pushedNow } = begin();
  if (!charted) return;
  const frequencies = modes.s.flat().map(([, im]) => im).filter(Number.isFinite).sort((a, b) => a - b);
  high = Math.min(Math.max(1.3 * (frequencies[Math.floor(0.97 * frequencies.length)] ?? 0), 4), 60);
  await charts.drawPlane(element("plane"), shown(), chosen);
  await curves.drawModes(element("modes"), modes, chosen, shown(), high);
  await curves.drawLocus(element("locus"), modes, now, high);
  await curves.drawMotion(element("motion"), pushedNow);
  if (solid) {
    element("region").hidden = false;
    element("region-still").classList.add("covered");
    await region.drawRegion(element("region"), shown(), chosen);
  }
}

/** Take a design, kept within the box. @param {import("./controls.mjs").Design} given */
function choose(given) {
  element("limit").textContent = "";
  for (const name of controls.AXES) {
    const value = given[name];
    if (value === undefined || !Number.isFinite(value)) continue;
    const [low, top] = volume().box[name];
    state[name] = Math.min(Math.max(value, low), top);
    if (input(name).valueAsNumber !== state[name]) input(name).value = String(state[name]);
  }
  update();
}

/** The texts, sliders and first design of a volume. @param {number} index */
function open(index) {
  state.volume = index;
  state.sweep = volume().sweep.map(() => 0);
  const { box } = volume();
  const { own } = machine();
  element("own").hidden = !(own && within(box, own[0], own[1]));
  const { lam, sigma, words } = opening(machine(), shown());
  [state.lam, state.sigma] = [lam, sigma];
  element("limit").textContent = words;
  const [first] = intervalsOf(tableOf(machine(), state.lam, state.sigma));
  const middle = first ? 0.5 * (first.V1 + Math.min(first.V2 ?? Infinity, box.V[1])) : 0.5 * (box.V[0] + box.V[1]);
  state.V = Math.min(Math.max(middle, box.V[0]), box.V[1]);
  for (const name of controls.AXES) {
    [input(name).min, input(name).max] = box[name].map(String);
    input(name).value = String(state[name]);
  }
  about(volume(), machine(), data);
  controls.sweepSliders(volume(), state.sweep, () => {
    about(volume(), machine(), data);
    draw();
  });
}

/** @param {number} last */
function play(last) {
  requestAnimationFrame((time) => {
    if (!state.playing) return;
    state.time = (state.time + Math.min((time - last) / 1000, 0.1)) % SECONDS;
    rear();
    play(time);
  });
}

function listen() {
  controls.sliders(machine, volume, () => state, choose);
  controls.pointer(shown, choose);
  controls.copying(() => command(machine(), { ...state, intervals: [] }));
  controls.tabs(data.volumes, (index) => {
    open(index);
    draw();
  });
  element("play").addEventListener("click", () => {
    state.playing = !state.playing;
    element("play").textContent = state.playing ? "Pause" : "Play";
    element("play").setAttribute("aria-pressed", String(state.playing));
    if (state.playing) play(performance.now());
  });
  for (const format of /** @type {const} */ (["png", "svg"])) {
    element(format).addEventListener("click", () => save(format));
  }
  charts.printing();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
}

const painted = () => new Promise((done) => { requestAnimationFrame(() => setTimeout(done, 0)); });

/** The answer first, then the library and its charts. */
async function start() {
  open(0);
  listen();
  begin();
  await painted();
  await unpacked();
  charted = true;
  await draw();
  if (solid) region.picking(element("region"), choose);
}

/** @type {any} */ (globalThis).bikestab = {
  intervals: (/** @type {number} */ lam, /** @type {number} */ sigma) => intervalsOf(tableOf(machine(), lam, sigma)),
  eigenvalues: (/** @type {number} */ lam, /** @type {number} */ sigma, /** @type {number} */ V) =>
    eigenvaluesAt(quarticAt(tableOf(machine(), lam, sigma), [V, 0])),
  modes: (/** @type {number} */ lam, /** @type {number} */ sigma, /** @type {number[]} */ speeds) => {
    const found = tableOf(machine(), lam, sigma);
    return follow(found, intervalsOf(found), speeds);
  },
  spent: () => spent,
  ready: start(),
};
