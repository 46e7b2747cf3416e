// Sliders, fields, tabs, buttons and the pointer → what they choose.

import { designAt } from "./charts.mjs";
import { element, input } from "./elements.mjs";
import { sigmaOfOffset } from "./geometry.mjs";

/** @typedef {import("./volumes.mjs").Entry} Entry */
/** @typedef {import("./volumes.mjs").Volume} Volume */
/** @typedef {Partial<{ lam: number, sigma: number, V: number }>} Design */
/** @typedef {(design: Design) => void} Choose */

export const AXES = /** @type {const} */ (["lam", "sigma", "V"]);

/** Sliders of a sweep, in place of those there were. @param {Volume} volume @param {number[]} at their positions
 * @param {() => void} moved */
export function sweepSliders({ sweep }, at, moved) {
  for (const old of document.querySelectorAll(".sweep")) old.remove();
  sweep.forEach((axis, i) => {
    const id = `sweep-${axis.name.replace(/[^A-Za-z0-9_-]/g, "-")}`;
    const slider = Object.assign(document.createElement("div"), { className: "slider sweep" });
    const label = Object.assign(document.createElement("label"), { htmlFor: id, textContent: `${axis.name}, ${axis.meaning}` });
    const range = Object.assign(document.createElement("input"), {
      type: "range", id, min: "0", max: String(axis.values.length - 1), step: "1", value: String(at[i]),
    });
    const output = document.createElement("output");
    const tell = () => {
      output.textContent = `${axis.values[at[i]]} ${axis.unit}`.trim();
      range.setAttribute("aria-valuetext", output.textContent);
    };
    range.addEventListener("input", () => {
      at[i] = Number(range.value);
      tell();
      moved();
    });
    tell();
    slider.append(label, range, output);
    element("sliders").append(slider);
  });
}

/** Tabs of the volumes, which arrow keys move between. @param {Volume[]} volumes @param {(index: number) => void} open */
export function tabs(volumes, open) {
  if (volumes.length < 2) return;
  const list = element("tabs");
  list.hidden = false;
  element("panel").setAttribute("role", "tabpanel");
  element("panel").setAttribute("aria-labelledby", "title");
  const all = volumes.map(({ title }) => {
    const tab = Object.assign(document.createElement("button"), { type: "button", textContent: title });
    tab.setAttribute("role", "tab");
    tab.setAttribute("aria-controls", "panel");
    return tab;
  });
  /** @param {number} index */
  const select = (index) => all.forEach((tab, k) => {
    tab.setAttribute("aria-selected", String(k === index));
    tab.tabIndex = k === index ? 0 : -1;
  });
  all.forEach((tab, i) => {
    tab.addEventListener("click", () => {
      select(i);
      open(i);
    });
    tab.addEventListener("keydown", ({ key }) => {
      const to = { ArrowRight: i + 1, ArrowLeft: i - 1, Home: 0, End: all.length - 1 }[key];
      if (to === undefined) return;
      const next = all[(to + all.length) % all.length];
      next.focus();
      next.click();
    });
  });
  select(0);
  list.append(...all);
}

/** @param {() => Entry} machine @param {() => Volume} volume @param {() => { lam: number }} design @param {Choose} choose */
export function sliders(machine, volume, design, choose) {
  for (const name of AXES) {
    input(name).addEventListener("input", () => choose({ [name]: input(name).valueAsNumber }));
  }
  const typed = /** @type {Record<string, (x: number) => Design>} */ ({
    "head-angle": (x) => ({ lam: ((90 - x) * Math.PI) / 180 }),
    trail: (x) => ({ sigma: x / 1000 / machine().c }),
    offset: (x) => ({ sigma: sigmaOfOffset(machine(), design().lam, x / 1000) }),
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
}

/** Clicks and drags on the plane of designs. @param {() => import("./volumes.mjs").Shown} shown @param {Choose} choose */
export function pointer(shown, choose) {
  const plane = element("plane");
  let dragging = false;
  /** @param {PointerEvent} event */
  const take = (event) => {
    const design = designAt(plane, event, shown());
    if (design) choose(design);
    return design !== null;
  };
  plane.addEventListener("pointerdown", (event) => { dragging = take(event); });
  plane.addEventListener("pointermove", (event) => { if (dragging && event.buttons) take(event); });
  globalThis.addEventListener("pointerup", () => { dragging = false; });
}

/** @param {() => string} command */
export function copying(command) {
  element("copy").addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(command());
      element("copied").textContent = "copied";
    } catch {
      getSelection()?.selectAllChildren(/** @type {Node} */ (element("command").firstElementChild));
      element("copied").textContent = "selected: copy it with the keyboard";
    }
  });
}
