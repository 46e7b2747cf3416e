// The stable region in three dimensions: by plotly, and as the picture that is there at once.

import { CONFIG, layout, style } from "./charts.mjs";
import { plotly } from "./library.mjs";

/** @typedef {import("./volumes.mjs").Shown} Shown */
/** @typedef {import("./charts.mjs").Chosen} Chosen */

const KINDS = /** @type {const} */ ([[1, "weave", "#0072b2"], [2, "capsize", "#e69f00"], [0, "both", "#888888"]]);
const [WIDE, HIGH] = [640, 560]; // of the picture, as in its viewBox

/** @param {Shown} shown @param {Chosen} chosen */
function column(shown, { lam, sigma, V, intervals }) {
  const [low, high] = shown.box.V;
  const z = intervals.filter((x) => x.V1 < high && (x.V2 ?? high) > low)
    .flatMap((x) => [Math.max(x.V1, low), Math.min(x.V2 ?? high, high), NaN]);
  return [
    { x: z.map(() => lam), y: z.map(() => sigma), z: z.map((value) => (Number.isNaN(value) ? null : value)) },
    { x: [lam], y: [sigma], z: [V] },
  ];
}

/** Round numbers beside an axis, without those at corners, where they would meet others; with the ``first``.
 * @param {number[]} ends @param {boolean} first */
function ticks([low, high], first) {
  const rough = (high - low) / 4;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5].find((x) => x * power >= 0.8 * rough) ?? 10);
  const tickvals = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step < high - 0.3 * step; k += 1) tickvals.push(k * step);
  if (!first && tickvals[0] < low + 0.3 * step) tickvals.shift();
  return { tickmode: "array", tickvals, ticktext: tickvals.map((x) => String(Number(x.toPrecision(6))).replace("-", "−")) };
}

/** @param {HTMLElement} at @param {Shown} shown @param {Chosen} chosen */
export async function drawRegion(at, shown, chosen) {
  const { points, triangles, kind } = shown.mesh;
  const [x, y, z] = [0, 1, 2].map((k) => points.filter((_, i) => i % 3 === k));
  const sheets = KINDS.map(([value, name, color]) => {
    const some = [...kind.keys()].filter((i) => kind[i] === value);
    const [i, j, k] = [0, 1, 2].map((corner) => Int32Array.from(some, (t) => triangles[3 * t + corner]));
    return {
      type: "mesh3d", name: `${name} boundary`, x, y, z, i, j, k, color, opacity: 0.6, flatshading: false, hoverinfo: "none",
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
  await plotly().react(at, traces, layout({
    margin: { l: 0, r: 0, t: 0, b: 0 }, dragmode: "turntable", uirevision: "same",
    scene: {
      aspectmode: "cube", camera: { eye: { x: -1.65, y: -1.55, z: 0.85 }, center: { x: 0, y: 0, z: -0.12 } }, uirevision: "same",
      xaxis: { ...axis, title: { text: "λ [rad]" }, range: shown.box.lam, ...ticks(shown.box.lam, true) },
      yaxis: { ...axis, title: { text: "σ" }, range: shown.box.sigma, ...ticks(shown.box.sigma, false) },
      zaxis: { ...axis, title: { text: "V [m/s]" }, range: shown.box.V, ...ticks(shown.box.V, true) },
    },
  }), { ...CONFIG, scrollZoom: true });
}

/** @param {HTMLElement} at @param {Shown} shown @param {Chosen} chosen */
export function moveRegion(at, shown, chosen) {
  const [line, dot] = column(shown, chosen);
  return plotly().restyle(at, { x: [line.x, dot.x], y: [line.y, dot.y], z: [line.z, dot.z] }, [KINDS.length, KINDS.length + 1]);
}

/** Take what is clicked on the surface, but not where a turn of it begins.
 * @param {HTMLElement} at @param {import("./controls.mjs").Choose} choose */
export function picking(at, choose) {
  const events = /** @type {any} */ (at);
  let under = /** @type {import("./controls.mjs").Design | null} */ (null);
  let from = [0, 0];
  events.on("plotly_hover", (/** @type {{ points: { x: number, y: number, z: number }[] }} */ { points: [{ x, y, z }] }) => {
    under = { lam: x, sigma: y, V: z };
  });
  events.on("plotly_unhover", () => { under = null; });
  at.addEventListener("pointerdown", ({ clientX, clientY }) => { from = [clientX, clientY]; }, true);
  at.addEventListener("pointerup", ({ clientX, clientY }) => {
    if (under && Math.hypot(clientX - from[0], clientY - from[1]) < 4) choose(under);
  }, true);
}

/**
 * The chosen design in the picture of the same surface.
 * @param {SVGElement} svg over the picture @param {number[][]} view (λ, σ, V, 1) → shares, times their divisor
 * @param {Shown} shown @param {Chosen} chosen
 */
export function drawOver(svg, view, shown, chosen) {
  const [line] = column(shown, chosen);
  /** @param {number} V */
  const place = (V) => {
    const [x, y, w] = view.map((row) => row[0] * chosen.lam + row[1] * chosen.sigma + row[2] * V + row[3]);
    return [(WIDE * x) / w, HIGH - (HIGH * y) / w];
  };
  const path = line.z.map((V, i) => (V === null ? "" : `${i % 3 ? "L" : "M"}${place(V).join(" ")}`)).join("");
  const [cx, cy] = place(chosen.V);
  svg.innerHTML = `<path d="${path}" fill="none" stroke="#000" stroke-width="6" stroke-linecap="round" />`
    + `<circle cx="${cx}" cy="${cy}" r="7" fill="#000" stroke="#fff" stroke-width="2" />`;
}

/** Whether the browser can draw in three dimensions. */
export function hasWebGL() {
  try {
    return Boolean(document.createElement("canvas").getContext("webgl"));
  } catch {
    return false;
  }
}
