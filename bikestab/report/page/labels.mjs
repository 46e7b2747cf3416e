// What is chosen and what follows from it → the page's texts and labels.

import { element, fill, input, tell } from "./elements.mjs";
import { measures } from "./geometry.mjs";
import { intervalsOf } from "./intervals.mjs";
import { tableOf } from "./table.mjs";
import { swept } from "./volumes.mjs";
import { changes, endsInWords, fixed, inShort, inWords, nowInWords } from "./words.mjs";

/** @typedef {import("./volumes.mjs").Entry} Entry */
/** @typedef {import("./volumes.mjs").Volume} Volume */
/** @typedef {import("./intervals.mjs").Interval} Interval */
/** @typedef {import("./charts.mjs").Chosen} Chosen */
/** @typedef {{ table: import("./twofold.mjs").Twofold[][], now: [number, number][], chosen: Chosen }} Found */

/** @param {Entry} machine @param {Chosen} chosen */
export const command = (machine, { lam, sigma }) => `bikestab vrange ${machine.command} --lam=${lam} --sigma=${sigma}`;

/** @param {Interval[]} intervals */
const told = (intervals) => `${intervals.length ? "stable " : ""}${inWords(intervals)}`;

/** The answer, and what the sliders and charts say. @param {Entry} machine @param {Found} found @param {string} push */
export function answer(machine, { now, chosen }, push) {
  const { lam, sigma, V, intervals } = chosen;
  const { headAngle, trail, offset } = measures(machine, lam, sigma);
  const mm = fixed(1000 * trail, 1);
  element("design").textContent = `Head angle ${fixed(headAngle, 2)}°, trail ${mm} mm, fork offset ${fixed(1000 * offset, 1)} mm:`;
  element("verdict").textContent = intervals.length ? "stable" : "";
  element("intervals").textContent = inWords(intervals);
  element("now").textContent = nowInWords(intervals, now, V);
  element("lam-words").textContent = `${fixed(lam, 4)} rad = ${fixed((lam * 180) / Math.PI, 2)}°`;
  element("sigma-words").textContent = `${fixed(sigma, 4)} = ${mm} mm`;
  element("V-words").textContent = `${fixed(V, 2)} m/s = ${fixed(3.6 * V, 1)} km/h`;
  for (const [id, value, digits] of /** @type {const} */ ([["head-angle", headAngle, 2], ["trail", 1000 * trail, 1], ["offset", 1000 * offset, 1]])) {
    if (document.activeElement !== element(id)) input(id).value = value.toFixed(digits);
  }
  element("command").firstElementChild?.replaceChildren(command(machine, chosen));
  element("push-words").textContent = `Someone nudges it sideways (${push}) at ${fixed(V, 2)} m/s.`;
  const words = told(intervals);
  const s = now.map(([x, y]) => `${fixed(x, 2)} ${y < 0 ? "−" : "+"} ${fixed(Math.abs(y), 2)} i`).join(", ");
  for (const [id, name, text] of /** @type {const} */ ([
    ["lam", "aria-valuetext", `${fixed(lam, 4)} rad, head angle ${fixed(headAngle, 2)} degrees`],
    ["sigma", "aria-valuetext", `${fixed(sigma, 4)}, trail ${mm} millimetres`],
    ["V", "aria-valuetext", `${fixed(V, 2)} metres per second`],
    ["plane", "aria-label", `Map of designs, tilt against trail; chosen: tilt ${fixed(lam, 3)} rad, trail ${fixed(sigma, 3)}; ${words}.`],
    ["region", "aria-label", `Surface around the stable region of tilt, trail and speed; at the chosen design ${words}.`],
    ["modes", "aria-label", `Growth rates and frequencies of the four modes against speed; ${words}.`],
    ["motion", "aria-label", `Roll and steer angle after the push at ${fixed(V, 2)} m/s.`],
    ["locus", "aria-label", `Root locus; at ${fixed(V, 2)} m/s the eigenvalues are ${s}.`],
  ])) element(id).setAttribute(name, text);
}

/** What happens below and above, what small changes do, and all machines at this design.
 * @param {Entry} machine @param {Found} found @param {Volume[]} volumes */
export function around(machine, { table, chosen }, volumes) {
  const { lam, sigma, intervals } = chosen;
  const small = changes(machine, lam, sigma, intervals);
  const [, then, by] = small[0];
  const longer = `With a trail 10 mm longer: ${told(then)}${by ? `; ${by}` : ""}.`;
  tell("ends", "li", [...endsInWords(table, intervals), longer]);
  const rows = small.map(([what, speeds, difference]) => [what, inShort(speeds), difference]);
  fill(element("changes"), [["as it is", inShort(intervals), ""], ...rows]);
  if (volumes.length < 2 && volumes[0].machines.length < 2) return;
  element("compare").hidden = false;
  const alone = volumes.length < 2; // whose title and name every row would repeat
  element("compare").querySelector("th")?.toggleAttribute("hidden", alone);
  fill(element("compare"), volumes.flatMap((volume) => volume.machines.map((one, i) => [
    ...(alone ? [] : [volume.title]), [...(alone ? [] : [one.name]), ...swept(volume, i)].join(", "),
    inWords(intervalsOf(tableOf(one, lam, sigma))),
  ])));
}

/** Title, parameters, warnings and how to cite. @param {Volume} volume @param {Entry} machine
 * @param {{ version: string, cite: string }} by */
export function about(volume, machine, by) {
  const { title, model, version, warnings, samples } = volume;
  const damping = machine.delta ? `damping ${machine.delta} kg m²/s` : "no damping";
  element("title").textContent = title;
  const gains = Object.entries(machine.parameters).filter(([name]) => name.startsWith("k_"));
  const feedback = gains.length ? `, steer torque by feedback: ${gains.map(([name, value]) => `${name} = ${value}`).join(", ")}` : "";
  const other = swept(volume, volume.machines.indexOf(machine)).filter((text) => !/^(delta|k_\w+) =/.test(text));
  element("subtitle").textContent = [machine.name, ...other, `${model} model`, `${damping}${feedback}`].join(", ");
  const drawn = samples ? [`Of the ${samples} machines drawn at random, which this volume has too, bikestab slice --probability shows more; this page is of the machine as it stands.`] : [];
  tell("warnings", "p", [...warnings.map((text) => `Warning: ${text}`), ...drawn]);
  const known = Object.entries(machine.parameters).filter(([, value]) => value !== null);
  fill(element("parameters"), known.map(([name, value]) => [name, String(value)]));
  element("cite").textContent = `Computed with bikestab ${by.version} (volume: ${version}). The machine: ${machine.source || "given by its user"}. The model: ${by.cite}; and bikestab ${by.version}. Charts: plotly.js (MIT licence).`;
}
