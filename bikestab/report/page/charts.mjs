// The charts, drawn by plotly; colours come from the page's style, so that light, dark and print fit.

/** @typedef {import("./modes.mjs").Modes} Modes */
/** @typedef {import("./motion.mjs").Motion} Motion */
/** @typedef {import("./intervals.mjs").Interval} Interval */
/**
 * @typedef {object} Shown what is drawn, for one machine
 * @property {{ lam: number[], sigma: number[], V: number[] }} box
 * @property {{ lam: number[], sigma: number[], width: Float32Array }} plane
 * @property {{ name: string, lam: number[], sigma: number[] }[]} curves
 * @property {{ points: Float32Array, triangles: Int32Array, kind: Uint8Array }} mesh
 * @property {{ lam: number[], sigma: number[] }} straight designs whose fork offset is zero
 * @property {number[] | null} own
 */
/** @typedef {{ lam: number, sigma: number, V: number, intervals: Interval[] }} Chosen */

const Plotly = /** @type {any} */ (globalThis).Plotly;
// Okabe and Ito 2008; each name has a dash of its own too
const COLOURS = /** @type {Record<string, string>} */ ({
  weave: "#0072b2", capsize: "#e69f00", castering: "#009e73", "real pair": "#56b4e9", real: "#56b4e9",
  "pair 2": "#cc79a7", "weave 2": "#56b4e9", "capsize 2": "#d55e00",
});
export const NAMES = Object.keys(COLOURS);
const KINDS = /** @type {const} */ ([[1, "weave", "#0072b2"], [2, "capsize", "#e69f00"], [0, "both", "#888888"]]);
const CONFIG = { displayModeBar: false, responsive: true, scrollZoom: false, doubleClick: false };

/** @param {string} name */
const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** @param {Record<string, any>} more */
function layout(more) {
  const axis = { gridcolor: style("--line"), zerolinecolor: style("--soft"), linecolor: style("--soft"), color: style("--ink"), fixedrange: true, automargin: true };
  const { xaxis = {}, yaxis = {}, ...rest } = more;
  return {
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", font: { color: style("--ink"), size: 13 },
    margin: { l: 55, r: 12, t: 8, b: 45 }, showlegend: true, dragmode: false, hovermode: "closest",
    legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, font: { size: 12 } },
    xaxis: { ...axis, ...xaxis }, yaxis: { ...axis, ...yaxis }, ...rest,
  };
}

/** @param {Shown} shown @param {Chosen} chosen */
function column(shown, { lam, sigma, V, intervals }) {
  const [low, high] = shown.box.V;
  const z = intervals.flatMap((x) => [Math.max(x.V1, low), Math.min(x.V2 ?? Infinity, high), NaN]);
  return [
    { x: z.map(() => lam), y: z.map(() => sigma), z: z.map((value) => (Number.isNaN(value) ? null : value)) },
    { x: [lam], y: [sigma], z: [V] },
  ];
}

/** @param {HTMLElement} at @param {Shown} shown @param {Chosen} chosen */
export async function drawRegion(at, shown, chosen) {
  const { points, triangles, kind } = shown.mesh;
  const [x, y, z] = [0, 1, 2].map((k) => points.filter((_, i) => i % 3 === k));
  const sheets = KINDS.map(([value, name, color]) => {
    const some = [...kind.keys()].filter((i) => kind[i] === value);
    const [i, j, k] = [0, 1, 2].map((corner) => Int32Array.from(some, (t) => triangles[3 * t + corner]));
    return {
      type: "mesh3d", name: `${name} boundary`, x, y, z, i, j, k, color, opacity: 1, flatshading: false, hoverinfo: "skip",
      showlegend: some.length > 0, visible: some.length > 0,
      lighting: { ambient: 0.55, diffuse: 0.6, specular: 0.1 }, lightposition: { x: -200, y: -300, z: 400 },
    };
  });
  const [line, dot] = column(shown, chosen);
  const ink = style("--ink");
  const traces = [
    ...sheets,
    { type: "scatter3d", mode: "lines", name: "stable speeds", ...line, line: { color: ink, width: 8 }, hoverinfo: "skip" },
    { type: "scatter3d", mode: "markers", name: "chosen", ...dot, marker: { color: ink, size: 6 }, showlegend: false, hoverinfo: "skip" },
  ];
  const axis = { color: ink, gridcolor: style("--line"), backgroundcolor: "rgba(0,0,0,0)", showspikes: false };
  await Plotly.react(at, traces, layout({
    margin: { l: 0, r: 0, t: 0, b: 0 }, dragmode: "turntable", uirevision: "same",
    scene: {
      aspectmode: "cube", camera: { eye: { x: -1.65, y: -1.55, z: 0.85 }, center: { x: 0, y: 0, z: -0.12 } }, uirevision: "same",
      xaxis: { ...axis, title: { text: "λ [rad]" }, range: shown.box.lam },
      yaxis: { ...axis, title: { text: "σ" }, range: shown.box.sigma },
      zaxis: { ...axis, title: { text: "V [m/s]" }, range: shown.box.V },
    },
  }), { ...CONFIG, scrollZoom: true });
}

/** @param {HTMLElement} at @param {Shown} shown @param {Chosen} chosen */
export function moveRegion(at, shown, chosen) {
  const [line, dot] = column(shown, chosen);
  return Plotly.restyle(at, { x: [line.x, dot.x], y: [line.y, dot.y], z: [line.z, dot.z] }, [KINDS.length, KINDS.length + 1]);
}

/** @param {HTMLElement} at @param {Shown} shown @param {Chosen} chosen */
export async function drawPlane(at, shown, chosen) {
  const { lam, sigma, width } = shown.plane;
  const z = sigma.map((_, j) => lam.map((__, i) => width[j * lam.length + i] || null));
  const ink = style("--ink");
  const first = new Set();
  const curves = shown.curves.map(({ name, lam: x, sigma: y }) => {
    const showlegend = !first.has(name);
    first.add(name);
    const dash = ["solid", "dot", "dash", "longdash", "dashdot", "longdashdot"][[...first].indexOf(name) % 6];
    return { type: "scatter", mode: "lines", name, legendgroup: name, showlegend, x, y, line: { color: ink, width: 1.6, dash }, hoverinfo: "skip" };
  });
  const straight = shown.straight.lam.length
    ? [{ type: "scatter", mode: "lines", name: "fork offset 0", x: shown.straight.lam, y: shown.straight.sigma, line: { color: "#d55e00", width: 2, dash: "dash" }, hoverinfo: "skip" }]
    : [];
  const own = shown.own
    ? [{ type: "scatter", mode: "markers", name: "its own design", x: [shown.own[0]], y: [shown.own[1]], marker: { symbol: "diamond-open", size: 13, color: "#d55e00", line: { width: 3 } }, hoverinfo: "skip" }]
    : [];
  await Plotly.react(at, [
    { type: "scatter", mode: "markers", name: "chosen", x: [chosen.lam], y: [chosen.sigma], marker: { symbol: "cross-thin", size: 22, color: ink, line: { width: 3, color: ink } }, hoverinfo: "skip" },
    { type: "heatmap", x: lam, y: sigma, z, colorscale: "Cividis", reversescale: true, zmin: 0, hovertemplate: "λ %{x:.4f} rad, σ %{y:.4f}: %{z:.2f} m/s stable<extra></extra>", colorbar: { title: { text: "stable [m/s]", side: "right" }, thickness: 12 } },
    ...curves, ...straight, ...own,
  ], layout({
    legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, font: { size: 11 } },
    xaxis: { title: { text: "tilt λ [rad]" }, range: shown.box.lam, showgrid: false },
    yaxis: { title: { text: "trail σ [wheelbases]" }, range: shown.box.sigma, showgrid: false },
  }), CONFIG);
}

/** @param {HTMLElement} at @param {Chosen} chosen */
export const movePlane = (at, { lam, sigma }) => Plotly.restyle(at, { x: [[lam]], y: [[sigma]] }, [0]);

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
  { type: "line", xref: "x", yref: "paper", x0: V, x1: V, y0: 0, y1: 1, line: { color: style("--ink"), width: 2 } },
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
      hovertemplate: `${name} ${growth ? "growth rate" : "frequency"} %{y:.3f} ${growth ? "1/s" : "rad/s"} at %{x:.3f} m/s<extra></extra>`,
    };
  });
  await Plotly.react(at, traces, layout({
    shapes: bands(chosen.intervals, chosen.V, shown.box.V[1]),
    xaxis: { title: { text: "speed V [m/s]" }, range: shown.box.V },
    yaxis: { title: { text: "growth rate [1/s], frequency [rad/s]" }, range: [-high, high], zeroline: true, zerolinewidth: 2 },
  }), CONFIG);
}

/** @param {HTMLElement} at @param {Modes} modes @param {Chosen} chosen @param {Shown} shown */
export function moveModes(at, modes, chosen, shown) {
  const traces = modeTraces(modes);
  const some = traces.map(({ y }) => y.some((value) => value !== null));
  return Plotly.update(at, {
    x: traces.map((trace) => trace.x), y: traces.map((trace) => trace.y),
    showlegend: some.map((has, i) => has && i < NAMES.length),
  }, { shapes: bands(chosen.intervals, chosen.V, shown.box.V[1]) });
}

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
    ? { type: "scatter", mode: "lines+markers", name: NAMES[i], x, y, showlegend: y.some((value) => value !== null), line: { color: COLOURS[NAMES[i]], width: 1 }, marker: { size: 4, color: COLOURS[NAMES[i]] }, hoverinfo: "skip" }
    : { type: "scatter", mode: "markers", name: "at this speed", x, y, marker: { size: 12, color: style("--ink"), symbol: "circle-open", line: { width: 3 } }, hovertemplate: "%{x:.4f} ± %{y:.4f}i<extra></extra>" }));
  await Plotly.react(at, traces, layout({
    xaxis: { title: { text: "real part [1/s]" }, range: [-high, high], zeroline: true, zerolinewidth: 2 },
    yaxis: { title: { text: "imaginary part [rad/s]" }, range: [-high, high], zeroline: true },
  }), CONFIG);
}

/** @param {HTMLElement} at @param {Modes} modes @param {[number, number][]} now */
export function moveLocus(at, modes, now) {
  const traces = locusTraces(modes, now);
  return Plotly.restyle(at, {
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
  await Plotly.react(at, [
    { type: "scatter", mode: "lines", name: "roll", ...roll, line: { color: "#0072b2", width: 2.6 }, hovertemplate: "roll %{y:.2f}° at %{x:.2f} s<extra></extra>" },
    { type: "scatter", mode: "lines", name: "steer", ...steer, line: { color: "#d55e00", width: 2.6, dash: "dash" }, hovertemplate: "steer %{y:.2f}° at %{x:.2f} s<extra></extra>" },
  ], layout({
    xaxis: { title: { text: "time after the push [s]" }, range: [0, motion.t[motion.t.length - 1]] },
    yaxis: { title: { text: "angle [°]" }, zeroline: true, zerolinewidth: 2 },
  }), CONFIG);
}

/** @param {HTMLElement} at @param {Motion} motion */
export function moveMotion(at, motion) {
  const traces = motionTraces(motion);
  return Plotly.restyle(at, { x: traces.map((trace) => trace.x), y: traces.map((trace) => trace.y) });
}

/**
 * Where on the plane a pointer is, within the box; null outside of the axes.
 * @param {HTMLElement} at @param {PointerEvent} event @param {Shown} shown
 */
export function designAt(at, event, shown) {
  const { _size: size } = /** @type {any} */ (at)._fullLayout;
  const rect = at.getBoundingClientRect();
  const [u, v] = [(event.clientX - rect.left - size.l) / size.w, (rect.bottom - event.clientY - size.b) / size.h];
  if (u < -0.02 || u > 1.02 || v < -0.02 || v > 1.02) return null;
  /** @param {number[]} ends @param {number} share */
  const within = ([low, high], share) => low + Math.min(Math.max(share, 0), 1) * (high - low);
  return { lam: within(shown.box.lam, u), sigma: within(shown.box.sigma, v) };
}

/** @param {HTMLElement} at @param {"png" | "svg"} format @param {string} filename */
export const save = (at, format, filename) =>
  Plotly.downloadImage(at, { format, filename, width: 1000, height: 700, scale: format === "png" ? 2 : 1 });

/** Whether the browser can draw in three dimensions. */
export function hasWebGL() {
  try {
    return Boolean(document.createElement("canvas").getContext("webgl"));
  } catch {
    return false;
  }
}
