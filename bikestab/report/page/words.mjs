// The answer in sentences: stable speeds, what happens below and above them, and what another trail would do.

import { eigenvaluesAt } from "./eigenvalues.mjs";
import { intervalsOf, quarticAt } from "./intervals.mjs";
import { tableOf } from "./table.mjs";

/** @typedef {import("./table.mjs").Machine} Machine */
/** @typedef {import("./twofold.mjs").Twofold} Twofold */
/** @typedef {import("./intervals.mjs").Interval} Interval */
/** @typedef {[number, number]} Complex */

/** @param {number} x */
export const fixed = (x, digits = 3) => x.toFixed(digits).replace("-", "−");
/** @param {number} V */
const road = (V) => `${fixed(V)} m/s (${fixed(3.6 * V, 1)} km/h)`;

/** @param {Interval[]} intervals */
export function inWords(intervals) {
  if (!intervals.length) return "no stable speed";
  return intervals.map(({ V1, V2, lower, upper }) => {
    const from = lower === "rest" ? "from rest" : `from ${fixed(V1)} m/s (${lower})`;
    return V2 === null ? `${from}, no upper limit` : `${from} to ${fixed(V2)} m/s (${upper})`;
  }).join(" and ");
}

/** The same for a table, without kinds. @param {Interval[]} intervals */
export const inShort = (intervals) => intervals.map(({ V1, V2, lower }) => {
  const from = lower === "rest" ? "rest" : fixed(V1);
  return V2 === null ? `${from} and faster` : `${from} to ${fixed(V2)}`;
}).join(", ") || "none";

/** @param {Complex[]} s */
const leastStable = (s) => s.reduce((a, b) => (a[0] >= b[0] ? a : b));

/** What happens at a speed. @param {Interval[]} intervals @param {Complex[]} now its eigenvalues @param {number} V */
export function nowInWords(intervals, now, V) {
  const [rate, frequency] = leastStable(now);
  const stable = intervals.some((x) => V > x.V1 && V < (x.V2 ?? Infinity));
  const motion = frequency === 0 ? "leaning to one side" : `swinging ${fixed(Math.abs(frequency) / (2 * Math.PI), 2)} times a second`;
  const what = stable ? `the motion that dies out last, ${motion},` : motion;
  const pace = Math.abs(rate) < 1e-9 ? "neither grows nor dies out"
    : rate > 0 ? `doubles in ${fixed(Math.LN2 / rate, 2)} s` : `halves in ${fixed(-Math.LN2 / rate, 2)} s`;
  return `At ${fixed(V, 2)} m/s (${fixed(3.6 * V, 1)} km/h): ${stable ? "stable" : "not stable"}; ${what} ${pace}.`;
}

const MOTIONS = /** @type {Record<string, string>} */ ({
  weave: "it weaves: it swings left and right, wider with every swing",
  capsize: "it capsizes: it leans over to one side, further and further",
});

/** What happens just outside of the stable speeds, one sentence an end.
 * @param {Twofold[][]} table @param {Interval[]} intervals @returns {string[]} */
export function endsInWords(table, intervals) {
  return intervals.flatMap(({ V1, V2, lower, upper }) => [
    lower === "rest" ? "It is stable from standstill on." : beyond(table, V1, lower, -1),
    V2 === null ? `There is no upper limit: faster than ${road(V1)} it is always stable.` : beyond(table, V2, upper, 1),
  ]);
}

/** @param {Twofold[][]} table @param {number} end [m/s] @param {string} kind @param {1 | -1} side */
function beyond(table, end, kind, side) {
  const first = `${side < 0 ? "Just below" : "Just above"} ${road(end)} ${MOTIONS[kind]}`;
  for (let step = 0.1; step > 1e-6; step /= 2) {
    const V = end * (1 + side * step);
    const [rate, frequency] = leastStable(eigenvaluesAt(quarticAt(table, [V, 0])));
    if (rate > 0 && (frequency !== 0) === (kind === "weave")) {
      const swings = frequency === 0 ? "twice as far" : `${fixed(Math.abs(frequency) / (2 * Math.PI), 2)} times a second, and twice as wide`;
      return `${first}; at ${fixed(V, 2)} m/s ${swings} after ${fixed(Math.LN2 / rate, 1)} s.`;
    }
  }
  return `${first}.`;
}

/** Neighbours of a design: what is changed, and the tilt [rad] and σ then.
 * @param {Machine} machine @param {number} lam @param {number} sigma @returns {[string, number, number][]} */
const neighbours = ({ c }, lam, sigma) => [
  ["trail 10 mm longer", lam, sigma + 0.01 / c],
  ["trail 10 mm shorter", lam, sigma - 0.01 / c],
  ["head angle 1° steeper", lam - Math.PI / 180, sigma],
  ["head angle 1° slacker", lam + Math.PI / 180, sigma],
];

/** What small changes of a design do: change, stable speeds then, and how they differ from the design's.
 * @param {Machine} machine @param {number} lam @param {number} sigma @param {Interval[]} intervals
 * @returns {[string, Interval[], string][]} */
export const changes = (machine, lam, sigma, intervals) => neighbours(machine, lam, sigma).map(([what, tilt, trail]) => {
  const then = intervalsOf(tableOf(machine, tilt, trail));
  return [what, then, compared(intervals, then)];
});

/** @param {Interval[]} before @param {Interval[]} then */
function compared(before, then) {
  if (before.length && !then.length) return "no longer stable at any speed";
  if (!before.length && then.length) return "stable then";
  if (before.length !== 1 || then.length !== 1) return "";
  const [[one], [other]] = [before, then];
  /** @param {number} by @param {string} more @param {string} less */
  const moved = (by, more, less) => `${fixed(Math.abs(by))} m/s ${by >= 0 ? more : less}`;
  const begins = one.lower === "rest" && other.lower === "rest" ? [] : [`begins ${moved(other.V1 - one.V1, "higher", "lower")}`];
  if (one.V2 === null || other.V2 === null) {
    return [...begins, ...(one.V2 === other.V2 ? [] : [other.V2 === null ? "no upper limit then" : "an upper limit then"])].join(", ");
  }
  const wider = other.V2 - other.V1 - (one.V2 - one.V1);
  const width = Math.abs(wider) < 5e-4 ? "as wide" : moved(wider, "wider", "narrower");
  return `${[...begins, `ends ${moved(other.V2 - one.V2, "higher", "lower")}`].join(", ")}: ${width}`;
}
