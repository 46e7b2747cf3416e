// What the page does: one chosen design and speed, and everything that follows from it.

import * as charts from "./charts.mjs";
import { drawRear, drawSide } from "./drawings.mjs";
import { eigenvaluesAt } from "./eigenvalues.mjs";
import { measures, sigmaOfOffset } from "./geometry.mjs";
import { intervalsOf, quarticAt } from "./intervals.mjs";
import { follow } from "./modes.mjs";
import { pushed } from "./motion.mjs";
import { tableOf } from "./table.mjs";

/** @typedef {import("./table.mjs").Machine} Machine */
/** @typedef {import("./intervals.mjs").Interval} Interval */

/**
 * @typedef {Machine & { own: number[] | null, delta: number, source: string, picture: string,
 *   parameters: Record<string, number | null>, plane: { lam: number[], sigma: number[], width: string },
 *   curves: { name: string, lam: number[], sigma: number[] }[],
 *   mesh: { points: string, triangles: string, kind: string } }} Entry
 */
/**
 * @typedef {{ title: string, model: string, version: string, warnings: string[],
 *   box: { lam: number[], sigma: number[], V: number[] },
 *   sweep: { name: string, unit: string, values: number[] }[], machines: Entry[] }} Volume
 */

const PUSH = 0.2; // rad/s of roll
const SPEEDS = 181; // of a curve of eigenvalues
const SECONDS = 5;
const PAUSE = 120; // ms without a change before the surface's marks follow: three dimensions draw slowly

/** @type {{ version: string, cite: string, volumes: Volume[] }} */
const data = JSON.parse(element("data").textContent ?? "");

/** @param {string} id */
function element(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no element ${id}`);
  return found;
}
/** @param {string} id */
const input = (id) => /** @type {HTMLInputElement} */ (element(id));
/** @param {string} text @returns {ArrayBuffer} */
const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;

const state = { volume: 0, sweep: /** @type {number[]} */ ([]), lam: 0, sigma: 0, V: 0, playing: false, time: 0 };
/** @type {Map<Entry, import("./charts.mjs").Shown>} */
const drawn = new Map();
let motion = /** @type {import("./motion.mjs").Motion | null} */ (null);
let high = 10;

const volume = () => data.volumes[state.volume];

/** The machine at the sliders of a sweep, whose last axis runs fastest. */
function machine(which = volume(), sweep = state.sweep) {
  const index = which.sweep.reduce((sum, axis, i) => sum * axis.values.length + (sweep[i] ?? 0), 0);
  return which.machines[index];
}

function shown() {
  const one = machine();
  let found = drawn.get(one);
  if (!found) {
    const { box } = volume();
    const line = { lam: /** @type {number[]} */ ([]), sigma: /** @type {number[]} */ ([]) };
    for (let i = 0; i <= 100; i += 1) {
      const lam = box.lam[0] + (i / 100) * (box.lam[1] - box.lam[0]);
      const sigma = sigmaOfOffset(one, lam, 0);
      if (sigma >= box.sigma[0] && sigma <= box.sigma[1]) {
        line.lam.push(lam);
        line.sigma.push(sigma);
      }
    }
    found = {
      box, curves: one.curves, own: one.own, straight: line,
      plane: { ...one.plane, width: new Float32Array(bytes(one.plane.width)) },
      mesh: {
        points: Float32Array.from(new Uint16Array(bytes(one.mesh.points)), (step, i) => {
          const [low, top] = [box.lam, box.sigma, box.V][i % 3];
          return low + ((top - low) * step) / 65535;
        }),
        triangles: new Int32Array(bytes(one.mesh.triangles)),
        kind: new Uint8Array(bytes(one.mesh.kind)),
      },
    };
    drawn.set(one, found);
  }
  return found;
}

/** Everything that follows from the choice. */
function computed() {
  const one = machine();
  const table = tableOf(one, state.lam, state.sigma);
  const intervals = intervalsOf(table);
  const [low, top] = volume().box.V;
  const speeds = Array.from({ length: SPEEDS }, (_, i) => Math.max(low + ((top - low) * i) / (SPEEDS - 1), 1e-6));
  const modes = follow(table, intervals, speeds);
  const now = eigenvaluesAt(quarticAt(table, [state.V, 0]));
  return { table, intervals, modes, now, chosen: { lam: state.lam, sigma: state.sigma, V: state.V, intervals } };
}

/** @param {number} x */
const fixed = (x, digits = 3) => x.toFixed(digits).replace("-", "−");

/** @param {Interval[]} intervals */
function inWords(intervals) {
  if (!intervals.length) return "no stable speed";
  return intervals.map(({ V1, V2, lower, upper }) => {
    const from = lower === "rest" ? "from rest" : `from ${fixed(V1)} m/s (${lower})`;
    return V2 === null ? `${from}, no upper limit` : `${from} to ${fixed(V2)} m/s (${upper})`;
  }).join(" and ");
}

/** What happens at the speed now. @param {Interval[]} intervals @param {[number, number][]} now */
function nowInWords(intervals, now) {
  const worst = now.reduce((a, b) => (a[0] >= b[0] ? a : b));
  const [rate, frequency] = [worst[0], Math.abs(worst[1])];
  const stable = intervals.some((x) => state.V > x.V1 && state.V < (x.V2 ?? Infinity));
  const motionWord = frequency > 0 ? `an oscillation of ${fixed(frequency / (2 * Math.PI), 2)} Hz` : "a motion without oscillation";
  const pace = Math.abs(rate) < 1e-9 ? "neither grows nor dies out"
    : rate > 0 ? `doubles in ${fixed(Math.LN2 / rate, 2)} s` : `halves in ${fixed(-Math.LN2 / rate, 2)} s`;
  return `At ${fixed(state.V, 2)} m/s (${fixed(3.6 * state.V, 1)} km/h): ${stable ? "stable" : "not stable"}; ${motionWord} ${pace}.`;
}

function words(/** @type {ReturnType<typeof computed>} */ { intervals, now }) {
  const one = machine();
  const { headAngle, trail, offset } = measures(one, state.lam, state.sigma);
  element("design").textContent = `Head angle ${fixed(headAngle, 2)}°, trail ${fixed(1000 * trail, 1)} mm, fork offset ${fixed(1000 * offset, 1)} mm: `;
  element("intervals").textContent = inWords(intervals);
  element("now").textContent = nowInWords(intervals, now);
  element("lam-words").textContent = `${fixed(state.lam, 4)} rad = ${fixed((state.lam * 180) / Math.PI, 2)}°`;
  element("sigma-words").textContent = `${fixed(state.sigma, 4)} = ${fixed(1000 * trail, 1)} mm`;
  element("V-words").textContent = `${fixed(state.V, 2)} m/s = ${fixed(3.6 * state.V, 1)} km/h`;
  for (const [id, value, digits] of /** @type {const} */ ([["head-angle", headAngle, 2], ["trail", 1000 * trail, 1], ["offset", 1000 * offset, 1]])) {
    if (document.activeElement !== element(id)) input(id).value = value.toFixed(digits);
  }
  input("lam").setAttribute("aria-valuetext", `${fixed(state.lam, 4)} rad, head angle ${fixed(headAngle, 2)} degrees`);
  input("sigma").setAttribute("aria-valuetext", `${fixed(state.sigma, 4)}, trail ${fixed(1000 * trail, 1)} millimetres`);
  input("V").setAttribute("aria-valuetext", `${fixed(state.V, 2)} metres per second`);
  element("command").firstElementChild?.replaceChildren(command());
  element("push-words").textContent = `Someone nudges it sideways (${PUSH} rad/s of roll) at ${fixed(state.V, 2)} m/s.`;
  const told = inWords(intervals);
  element("plane").setAttribute("aria-label", `Map of designs, tilt against trail; chosen: tilt ${fixed(state.lam, 3)} rad, trail ${fixed(state.sigma, 3)}; stable ${told}.`);
  element("region").setAttribute("aria-label", `Surface around the stable region of tilt, trail and speed; at the chosen design stable ${told}.`);
  element("modes").setAttribute("aria-label", `Growth rates and frequencies of the four modes against speed; stable ${told}.`);
  element("motion").setAttribute("aria-label", `Roll and steer angle for ${SECONDS} s after the push at ${fixed(state.V, 2)} m/s.`);
  element("locus").setAttribute("aria-label", `Root locus; at ${fixed(state.V, 2)} m/s the eigenvalues are ${now.map(([x, y]) => `${fixed(x, 2)} ${y < 0 ? "−" : "+"} ${fixed(Math.abs(y), 2)} i`).join(", ")}.`);
}

const command = () => `bikestab vrange ${machine().command} --lam ${state.lam} --sigma=${state.sigma}`;

/** @type {number} */
let waiting = 0;
/** @type {ReturnType<typeof setTimeout> | undefined} */
let turning;
const solid = charts.hasWebGL();
/** How long the computation of the last frame took [ms]; the charts' drawing is not in it. */
let spent = 0;

function update() {
  if (waiting) return;
  waiting = requestAnimationFrame(() => {
    waiting = 0;
    const start = performance.now();
    const found = computed();
    motion = pushed(machine(), state.lam, state.sigma, state.V, PUSH, SECONDS);
    spent = performance.now() - start;
    words(found);
    const { chosen, modes, now } = found;
    charts.movePlane(element("plane"), chosen);
    charts.moveModes(element("modes"), modes, chosen, shown());
    charts.moveLocus(element("locus"), modes, now);
    charts.moveMotion(element("motion"), motion);
    clearTimeout(turning);
    if (solid) turning = setTimeout(() => charts.moveRegion(element("region"), shown(), chosen), PAUSE);
    side();
    rear();
    table();
  });
}

const side = () => drawSide(/** @type {any} */ (element("side")), machine(), state.lam, state.sigma);

/** The machine from behind at the clock's time, its angles enlarged to be seen. */
function rear() {
  if (!motion) return;
  const i = Math.min(Math.round((state.time / SECONDS) * (motion.t.length - 1)), motion.t.length - 1);
  const largest = Math.max(...motion.roll.slice(0, 60).map(Math.abs), 1e-9);
  const larger = 0.25 / largest;
  /** @param {number} x */
  const limited = (x) => Math.max(-1.2, Math.min(1.2, larger * x));
  drawRear(/** @type {any} */ (element("rear")), machine(), limited(motion.roll[i]), limited(motion.steer[i]));
  element("clock").textContent = `${fixed(state.time, 1)} s after the push`;
}

function table() {
  if (data.volumes.length < 2 && volume().machines.length < 2) return;
  element("compare").hidden = false;
  const rows = data.volumes.flatMap((each) => each.machines.map((one, i) => {
    const values = each.sweep.map((axis, k) => {
      const below = each.sweep.slice(k + 1).reduce((n, other) => n * other.values.length, 1);
      return `${axis.name} = ${axis.values[Math.floor(i / below) % axis.values.length]}`;
    });
    return [each.title, [one.name, ...values].join(", "), inWords(intervalsOf(tableOf(one, state.lam, state.sigma)))];
  }));
  const body = element("compare").querySelector("tbody");
  body?.replaceChildren(...rows.map((row) => {
    const tr = document.createElement("tr");
    tr.append(...row.map((text) => Object.assign(document.createElement("td"), { textContent: text })));
    return tr;
  }));
}

/** All charts anew, for another machine or other colours. */
async function draw() {
  const found = computed();
  const { chosen, modes, now } = found;
  motion = pushed(machine(), state.lam, state.sigma, state.V, PUSH, SECONDS);
  words(found);
  const frequencies = modes.s.flat().map(([, im]) => im).filter(Number.isFinite).sort((a, b) => a - b);
  high = Math.min(Math.max(1.3 * (frequencies[Math.floor(0.97 * frequencies.length)] ?? 0), 4), 60);
  side();
  rear();
  table();
  await charts.drawPlane(element("plane"), shown(), chosen);
  await charts.drawModes(element("modes"), modes, chosen, shown(), high);
  await charts.drawLocus(element("locus"), modes, now, high);
  await charts.drawMotion(element("motion"), motion);
  if (solid) {
    await charts.drawRegion(element("region"), shown(), chosen);
  } else {
    element("region").hidden = true;
    const picture = /** @type {HTMLImageElement} */ (element("region-picture"));
    picture.hidden = false;
    picture.src = `data:image/png;base64,${machine().picture}`;
    picture.alt = "The surface around the stable region; this browser draws no three dimensions, so it does not turn.";
  }
}

/** Take a design, kept within the box. @param {Partial<{ lam: number, sigma: number, V: number }>} given */
function choose(given) {
  element("limit").textContent = "";
  for (const name of /** @type {const} */ (["lam", "sigma", "V"])) {
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
  const { box, sweep, warnings, title, model, version } = volume();
  element("title").textContent = title;
  for (const name of /** @type {const} */ (["lam", "sigma", "V"])) {
    input(name).min = String(box[name][0]);
    input(name).max = String(box[name][1]);
  }
  for (const old of document.querySelectorAll(".sweep")) old.remove();
  sweep.forEach((axis, i) => {
    const slider = document.createElement("div");
    slider.className = "slider sweep";
    const id = `sweep-${axis.name.replace(/[^A-Za-z0-9_-]/g, "-")}`;
    const label = Object.assign(document.createElement("label"), { htmlFor: id, textContent: axis.name });
    const range = Object.assign(document.createElement("input"), { type: "range", id, min: "0", max: String(axis.values.length - 1), step: "1", value: "0" });
    const output = document.createElement("output");
    const tell = () => {
      output.textContent = `${axis.values[state.sweep[i]]} ${axis.unit}`.trim();
      range.setAttribute("aria-valuetext", output.textContent);
    };
    range.addEventListener("input", () => {
      state.sweep[i] = Number(range.value);
      tell();
      about(model, version, warnings);
      draw();
    });
    tell();
    slider.append(label, range, output);
    element("sliders").append(slider);
  });
  const { own } = machine();
  const inside = own && own[0] >= box.lam[0] && own[0] <= box.lam[1] && own[1] >= box.sigma[0] && own[1] <= box.sigma[1];
  [state.lam, state.sigma] = own && inside ? own : [0.5 * (box.lam[0] + box.lam[1]), 0.5 * (box.sigma[0] + box.sigma[1])];
  element("own").hidden = !inside;
  const [first] = intervalsOf(tableOf(machine(), state.lam, state.sigma));
  const middle = first ? 0.5 * (first.V1 + Math.min(first.V2 ?? Infinity, box.V[1])) : 0.5 * (box.V[0] + box.V[1]);
  state.V = Math.min(Math.max(middle, box.V[0]), box.V[1]);
  for (const name of /** @type {const} */ (["lam", "sigma", "V"])) input(name).value = String(state[name]);
  about(model, version, warnings);
}

/** @param {string} model @param {string} version @param {string[]} warnings */
function about(model, version, warnings) {
  const one = machine();
  const damping = one.delta ? `damping ${one.delta} kg m²/s` : "no damping";
  element("subtitle").textContent = `${one.name}, ${model} model, ${damping}`;
  element("warnings").replaceChildren(...warnings.map((text) => Object.assign(document.createElement("p"), { textContent: `Warning: ${text}` })));
  const body = element("parameters").querySelector("tbody");
  body?.replaceChildren(...Object.entries(one.parameters).filter(([, value]) => value !== null).map(([name, value]) => {
    const tr = document.createElement("tr");
    const th = Object.assign(document.createElement("th"), { textContent: name, scope: "row" });
    tr.append(th, Object.assign(document.createElement("td"), { textContent: String(value) }));
    return tr;
  }));
  element("cite").textContent = `Computed with bikestab ${data.version} (volume: ${version}). The machine: ${one.source || "given by its user"}. The model: ${data.cite}; and bikestab ${data.version}.`;
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
  for (const name of /** @type {const} */ (["lam", "sigma", "V"])) {
    input(name).addEventListener("input", () => choose({ [name]: input(name).valueAsNumber }));
  }
  const typed = /** @type {const} */ ({
    "head-angle": (/** @type {number} */ x) => ({ lam: ((90 - x) * Math.PI) / 180 }),
    trail: (/** @type {number} */ x) => ({ sigma: x / 1000 / machine().c }),
    offset: (/** @type {number} */ x) => ({ sigma: sigmaOfOffset(machine(), state.lam, x / 1000) }),
  });
  for (const [id, meant] of Object.entries(typed)) {
    input(id).addEventListener("change", () => {
      const wanted = meant(input(id).valueAsNumber);
      choose(wanted);
      // what lies outside of the box is cut to it, and the field says what it was cut to
      input(id).blur();
      const [[name, value]] = Object.entries(wanted);
      const [low, top] = volume().box[/** @type {"lam" | "sigma"} */ (name)];
      element("limit").textContent = value < low || value > top ? "that is outside of this volume's box: its limit is shown" : "";
    });
  }
  element("own").addEventListener("click", () => {
    const { own } = machine();
    if (own) choose({ lam: own[0], sigma: own[1] });
  });
  const plane = element("plane");
  let dragging = false;
  plane.addEventListener("pointerdown", (event) => {
    const design = charts.designAt(plane, event, shown());
    dragging = design !== null;
    if (design) choose(design);
  });
  plane.addEventListener("pointermove", (event) => {
    const design = dragging && event.buttons ? charts.designAt(plane, event, shown()) : null;
    if (design) choose(design);
  });
  globalThis.addEventListener("pointerup", () => { dragging = false; });
  element("play").addEventListener("click", () => {
    state.playing = !state.playing;
    element("play").textContent = state.playing ? "Pause" : "Play";
    element("play").setAttribute("aria-pressed", String(state.playing));
    if (state.playing) play(performance.now());
  });
  element("copy").addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(command());
      element("copied").textContent = "copied";
    } catch {
      getSelection()?.selectAllChildren(/** @type {Node} */ (element("command").firstElementChild));
      element("copied").textContent = "selected: copy it with the keyboard";
    }
  });
  for (const format of /** @type {const} */ (["png", "svg"])) {
    element(format).addEventListener("click", () => charts.save(element("modes"), format, "bikestab-eigenvalues"));
  }
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  for (const event of ["beforeprint", "afterprint"]) globalThis.addEventListener(event, draw);
  const tabs = element("tabs");
  if (data.volumes.length > 1) {
    tabs.hidden = false;
    tabs.append(...data.volumes.map((each, i) => {
      const tab = Object.assign(document.createElement("button"), { type: "button", textContent: each.title });
      tab.setAttribute("role", "tab");
      tab.setAttribute("aria-selected", String(i === 0));
      tab.addEventListener("click", () => {
        for (const [k, other] of [...tabs.children].entries()) other.setAttribute("aria-selected", String(k === i));
        open(i);
        draw();
      });
      return tab;
    }));
  }
}

open(0);
listen();
const ready = draw();

/** @type {any} */ (globalThis).bikestab = {
  intervals: (/** @type {number} */ lam, /** @type {number} */ sigma) => intervalsOf(tableOf(machine(), lam, sigma)),
  eigenvalues: (/** @type {number} */ lam, /** @type {number} */ sigma, /** @type {number} */ V) =>
    eigenvaluesAt(quarticAt(tableOf(machine(), lam, sigma), [V, 0])),
  modes: (/** @type {number} */ lam, /** @type {number} */ sigma, /** @type {number[]} */ speeds) => {
    const found = tableOf(machine(), lam, sigma);
    return follow(found, intervalsOf(found), speeds);
  },
  spent: () => spent,
  ready,
};
