// What all charts share, and the plane of designs. Colours come from the page's style, so that light and dark fit.

import { plotly } from "./library.mjs";

/** @typedef {import("./intervals.mjs").Interval} Interval */
/** @typedef {import("./volumes.mjs").Shown} Shown */
/** @typedef {{ lam: number, sigma: number, V: number, intervals: Interval[] }} Chosen */

export const CONFIG = { displayModeBar: false, responsive: true, scrollZoom: false, doubleClick: false };
// the upper part of cividis, as in the pictures of designs: dark is narrow, yellow is wide
const WIDTH = [[0, "#4f576c"], [0.125, "#646770"], [0.25, "#777776"], [0.375, "#8c8878"], [0.5, "#a19975"], [0.625, "#b9ab6d"], [0.75, "#d0be62"], [0.875, "#e9d34e"], [1, "#fee838"]];
const SHOWN = { "font.size": 13, "legend.font.size": 12 };
const PRINTED = { autosize: false, width: 334, height: 272, "font.size": 11.5, "legend.font.size": 10.5 }; // [CSS pixels] two beside each other on A4

/** @param {string} name */
export const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** @param {Record<string, any>} more */
export function layout(more) {
  const axis = { gridcolor: style("--line"), zerolinecolor: style("--soft"), linecolor: style("--soft"), color: style("--ink"), fixedrange: true, automargin: true };
  const { xaxis = {}, yaxis = {}, ...rest } = more;
  return {
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", font: { color: style("--ink"), size: SHOWN["font.size"] },
    margin: { l: 55, r: 12, t: 8, b: 45 }, showlegend: true, dragmode: false, hovermode: "closest",
    legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, font: { size: SHOWN["legend.font.size"] } },
    xaxis: { ...axis, ...xaxis }, yaxis: { ...axis, ...yaxis }, ...rest,
  };
}

/** @param {HTMLElement} at @param {object[]} traces @param {object} how @param {object} [config] */
export const react = (at, traces, how, config = CONFIG) => plotly().react(at, traces, how, config);

/** Charts with letters to be read on paper, for as long as they are printed; a browser waits for no promise there. */
export function printing() {
  const charts = () => /** @type {HTMLElement[]} */ ([...document.querySelectorAll(".plot.js-plotly-plot:not(#region)")]);
  globalThis.addEventListener("beforeprint", () => charts().forEach((at) => plotly().relayout(at, at.id === "plane" ? { ...PRINTED, height: 340 } : PRINTED)));
  globalThis.addEventListener("afterprint", () => charts().forEach((at) => plotly().relayout(at, { autosize: true, width: null, height: null, ...SHOWN })));
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
    ? [{ type: "scatter", mode: "lines", name: "fork offset 0", x: shown.straight.lam, y: shown.straight.sigma, line: { color: style("--soft"), width: 2, dash: "dashdot" }, hoverinfo: "skip" }]
    : [];
  const own = shown.own
    ? [{ type: "scatter", mode: "markers", name: "its own design", x: [shown.own[0]], y: [shown.own[1]], marker: { symbol: "star", size: 15, color: "#e8308a", line: { width: 1.4, color: "#000" } }, hoverinfo: "skip" }]
    : [];
  await react(at, [
    { type: "scatter", mode: "markers", name: "chosen", x: [chosen.lam], y: [chosen.sigma], marker: { symbol: "cross-thin", size: 22, color: ink, line: { width: 3, color: ink } }, hoverinfo: "skip" },
    { type: "heatmap", x: lam, y: sigma, z, colorscale: WIDTH, zmin: 0, hovertemplate: "λ %{x:.4f} rad, σ %{y:.4f}: %{z:.2f} m/s stable<extra></extra>", colorbar: { title: { text: "stable [m/s]", side: "right" }, thickness: 12 } },
    ...curves, ...straight, ...own,
  ], layout({
    xaxis: { title: { text: "tilt λ [rad]" }, range: shown.box.lam, showgrid: false },
    yaxis: { title: { text: "trail σ [wheelbases]" }, range: shown.box.sigma, showgrid: false },
  }));
}

/** @param {HTMLElement} at @param {Chosen} chosen */
export const movePlane = (at, { lam, sigma }) => plotly().restyle(at, { x: [[lam]], y: [[sigma]] }, [0]);

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
