// Eigenvalues against speed, root locus and motion, drawn by plotly.

import { layout, react, style } from "./charts.mjs";
import { plotly } from "./library.mjs";

/** @typedef {import("./modes.mjs").Modes} Modes */
/** @typedef {import("./motion.mjs").Motion} Motion */
/** @typedef {import("./intervals.mjs").Interval} Interval */
/** @typedef {import("./volumes.mjs").Shown} Shown */
/** @typedef {import("./charts.mjs").Chosen} Chosen */

// Okabe and Ito 2008, as in the pictures of eigen, whose castering is so dark that it could not be seen on a dark page
const COLOURS = /** @type {Record<string, string>} */ ({
  weave: "#0072b2", capsize: "#e69f00", castering: "#009e73", "real pair": "#56b4e9", real: "#7b5ea7",
  "pair 2": "#cc79a7", "weave 2": "#6a8caf", "capsize 2": "#d55e00",
});
const NAMES = Object.keys(COLOURS);
const GREY = "#808080"; // of a line of any colour

/** Points of one name along all branches, with gaps between. @param {Modes} modes @param {string} name
 * @param {(s: [number, number], V: number) => [number, number] | null} point */
function along({ V, s, names }, name, point) {
  /** @type {(number | null)[]} */
  const x = [];
  /** @type {(number | null)[]} */
  const y = [];
  s.forEach((branch, b) => {
    branch.forEach((value, i) => {
      // a line goes on to the first point of the next name, so that no gap is left
      const at = names[b][i] === name || (i > 0 && names[b][i - 1] === name) ? point(value, V[i]) : null;
      x.push(at ? at[0] : null);
      y.push(at ? at[1] : null);
    });
    x.push(null);
    y.push(null);
  });
  return { x, y };
}

/** @param {Interval[]} intervals @param {number} V @param {number} top */
const bands = (intervals, V, top) => [
  ...intervals.map((x) => ({ type: "rect", xref: "x", yref: "paper", x0: x.V1, x1: x.V2 ?? top, y0: 0, y1: 1, fillcolor: style("--stable"), line: { width: 0 }, layer: "below" })),
  { type: "line", xref: "x", yref: "paper", x0: V, x1: V, y0: 0, y1: 1, line: { color: style("--ink"), width: 2, dash: "dash" } },
];

/** @param {Modes} modes */
function modeTraces(modes) {
  return [
    ...NAMES.map((name) => along(modes, name, ([re], V) => [V, re])),
    ...NAMES.map((name) => along(modes, name, ([, im], V) => (im > 0 ? [V, im] : null))),
  ];
}

/** @param {HTMLElement} at @param {Modes} modes @param {Chosen} chosen @param {Shown} shown @param {number} high */
export async function drawModes(at, modes, chosen, shown, high) {
  const traces = modeTraces(modes).map(({ x, y }, i) => {
    const name = NAMES[i % NAMES.length];
    const growth = i < NAMES.length;
    const some = y.some((value) => value !== null);
    return {
      type: "scatter", mode: "lines", name, legendgroup: name, x, y, showlegend: growth && some,
      line: { color: COLOURS[name], width: growth ? 2.6 : 1.4, dash: growth ? "solid" : "dot" }, connectgaps: false,
      hovertemplate: `${name} ${growth ? "growth rate" : "frequency"} %{y:.3f} ${growth ? "s⁻¹" : "rad/s"} at %{x:.3f} m/s<extra></extra>`,
    };
  });
  const kinds = /** @type {const} */ ([
    ["growth rate", "solid", 2.6, GREY], ["angular frequency", "dot", 1.4, GREY], ["chosen speed", "dash", 2, style("--ink")],
  ]).map(([name, dash, width, color]) => ({ type: "scatter", mode: "lines", name, x: [null], y: [null], line: { color, width, dash } }));
  await react(at, [...traces, ...kinds], layout({
    shapes: bands(chosen.intervals, chosen.V, shown.box.V[1]),
    xaxis: { title: { text: "speed V [m/s]" }, range: shown.box.V },
    yaxis: { title: { text: "growth rate [s⁻¹], frequency [rad/s]" }, range: [-high, high], zeroline: true, zerolinewidth: 2 },
  }));
}

/** @param {HTMLElement} at @param {Modes} modes @param {Chosen} chosen @param {Shown} shown */
export function moveModes(at, modes, chosen, shown) {
  const traces = modeTraces(modes);
  const some = traces.map(({ y }) => y.some((value) => value !== null));
  return plotly().update(at, {
    x: traces.map((trace) => trace.x), y: traces.map((trace) => trace.y),
    showlegend: some.map((has, i) => has && i < NAMES.length),
  }, { shapes: bands(chosen.intervals, chosen.V, shown.box.V[1]) }, [...traces.keys()]);
}

const EVERY = 30; // points of the root locus to an arrowhead, which points to higher speeds
const POINTS = [...Array(4096).keys()];
const ARROWS = {
  angleref: "previous", opacity: 1, line: { width: 0 }, symbol: POINTS.map((i) => (i % EVERY === EVERY / 2 ? "arrow" : "circle")),
  size: POINTS.map((i) => (i % EVERY === EVERY / 2 ? 10 : 2)),
};

/** @param {Modes} modes @param {[number, number][]} now */
function locusTraces(modes, now) {
  return [
    ...NAMES.map((name) => along(modes, name, ([re, im]) => [re, im])),
    { x: now.map(([re]) => re), y: now.map(([, im]) => im) },
  ];
}

/** @param {HTMLElement} at @param {Modes} modes @param {[number, number][]} now @param {number} high */
export async function drawLocus(at, modes, now, high) {
  const traces = locusTraces(modes, now).map(({ x, y }, i) => (i < NAMES.length
    ? { type: "scatter", mode: "lines+markers", name: NAMES[i], x, y, showlegend: y.some((value) => value !== null), line: { color: COLOURS[NAMES[i]], width: 2 }, marker: { ...ARROWS, color: COLOURS[NAMES[i]] }, hoverinfo: "skip" }
    : { type: "scatter", mode: "markers", name: "at this speed", x, y, marker: { size: 12, color: style("--ink"), symbol: "circle-open", line: { width: 3 } }, hovertemplate: "%{x:.4f} ± %{y:.4f}i<extra></extra>" }));
  await react(at, traces, layout({
    xaxis: { title: { text: "real part [s⁻¹]" }, range: [-high, high], zeroline: true, zerolinewidth: 2 },
    yaxis: { title: { text: "imaginary part [rad/s]" }, range: [-high, high], zeroline: true },
  }));
}

/** @param {HTMLElement} at @param {Modes} modes @param {[number, number][]} now */
export function moveLocus(at, modes, now) {
  const traces = locusTraces(modes, now);
  return plotly().restyle(at, {
    x: traces.map((trace) => trace.x), y: traces.map((trace) => trace.y),
    showlegend: traces.map(({ y }, i) => i === NAMES.length || y.some((value) => value !== null)),
  });
}

const DEGREES = 180 / Math.PI;

/** @param {Motion} motion */
const motionTraces = (motion) => [motion.roll, motion.steer].map((values) => ({ x: motion.t, y: values.map((value) => value * DEGREES) }));

/** @param {HTMLElement} at @param {Motion} motion */
export async function drawMotion(at, motion) {
  const [roll, steer] = motionTraces(motion);
  await react(at, [
    { type: "scatter", mode: "lines", name: "roll", ...roll, line: { color: "#0072b2", width: 2.6 }, hovertemplate: "roll %{y:.2f}° at %{x:.2f} s<extra></extra>" },
    { type: "scatter", mode: "lines", name: "steer", ...steer, line: { color: "#d55e00", width: 2.6, dash: "dash" }, hovertemplate: "steer %{y:.2f}° at %{x:.2f} s<extra></extra>" },
  ], layout({
    xaxis: { title: { text: "time after the push [s]" }, range: [0, motion.t[motion.t.length - 1]] },
    yaxis: { title: { text: "angle [°]" }, zeroline: true, zerolinewidth: 2 },
  }));
}

/** @param {HTMLElement} at @param {Motion} motion */
export function moveMotion(at, motion) {
  const traces = motionTraces(motion);
  return plotly().restyle(at, { x: traces.map((trace) => trace.x), y: traces.map((trace) => trace.y) });
}

