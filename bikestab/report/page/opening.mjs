// A machine → the design that its page opens on, and why that one.

import { intervalsOf } from "./intervals.mjs";
import { tableOf } from "./table.mjs";
import { within } from "./volumes.mjs";

/** @typedef {import("./volumes.mjs").Entry} Entry */
/** @typedef {import("./volumes.mjs").Shown} Shown */

const ENOUGH = 0.1; // of the widest stable speeds of the plane: at its edge there are next to none

/** Its own design where that has stable speeds, else the nearest of the plane that has enough of them.
 * @param {Entry} machine @param {Shown} shown @returns {{ lam: number, sigma: number, words: string }} */
export function opening(machine, { box, plane }) {
  const { own } = machine;
  const inside = own !== null && within(box, own[0], own[1]);
  if (inside && intervalsOf(tableOf(machine, own[0], own[1])).length) return { lam: own[0], sigma: own[1], words: "" };
  const [lam, sigma] = own ?? [0.5 * (box.lam[0] + box.lam[1]), 0.5 * (box.sigma[0] + box.sigma[1])];
  const found = nearest(plane, lam, sigma, box);
  if (!found) {
    const [x, y] = [Math.min(Math.max(lam, box.lam[0]), box.lam[1]), Math.min(Math.max(sigma, box.sigma[0]), box.sigma[1])];
    return { lam: x, sigma: y, words: "No design on this page has a stable speed." };
  }
  const why = own === null ? "The machine has no design of its own: this is one with stable speeds."
    : inside ? "Its own design has no stable speed: this is one near it with stable speeds."
      : "Its own design is not within these tilts and trails: this is one near it with stable speeds.";
  return { ...found, words: why };
}

/** The nearest design of the plane with enough stable speeds, in parts of the box's sides.
 * @param {Shown["plane"]} plane @param {number} lam @param {number} sigma @param {Shown["box"]} box */
function nearest({ lam: tilts, sigma: trails, width }, lam, sigma, box) {
  const enough = ENOUGH * width.reduce((a, b) => Math.max(a, b), 0);
  let [best, least] = [-1, Infinity];
  width.forEach((some, k) => {
    const x = (tilts[k % tilts.length] - lam) / (box.lam[1] - box.lam[0]);
    const y = (trails[Math.floor(k / tilts.length)] - sigma) / (box.sigma[1] - box.sigma[0]);
    if (some > 0 && some >= enough && Math.hypot(x, y) < least) [best, least] = [k, Math.hypot(x, y)];
  });
  return best < 0 ? null : { lam: tilts[best % tilts.length], sigma: trails[Math.floor(best / tilts.length)] };
}
