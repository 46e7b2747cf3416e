// table → its stable speeds, by the Routh–Hurwitz conditions p4 … p0 > 0 and hurwitz3 > 0.

import { positiveRoots } from "./roots.mjs";
import { add, multiply, subtract, twofold, value } from "./twofold.mjs";

/** @typedef {import("./twofold.mjs").Twofold} Twofold */
/** @typedef {{ V1: number, V2: number | null, lower: string, upper: string }} Interval */

/** Σ over products. @param {Twofold[]} a @param {Twofold[]} b @returns {Twofold[]} */
function times(a, b) {
  const out = Array.from({ length: a.length + b.length - 1 }, () => twofold(0));
  a.forEach((x, i) => b.forEach((y, j) => { out[i + j] = add(out[i + j], multiply(x, y)); }));
  return out;
}

/** a − b. @param {Twofold[]} a @param {Twofold[]} b @returns {Twofold[]} */
function minus(a, b) {
  const longer = Array.from({ length: Math.max(a.length, b.length) }, () => twofold(0));
  return longer.map((zero, i) => subtract(a[i] ?? zero, b[i] ?? zero));
}

/** hurwitz3 = p1 p2 p3 − p0 p3² − p4 p1², as a polynomial in V. @param {Twofold[][]} p */
export function hurwitz3([p0, p1, p2, p3, p4]) {
  return minus(minus(times(times(p1, p2), p3), times(p0, times(p3, p3))), times(p4, times(p1, p1)));
}

/**
 * Ascending; V2 is null where there is no upper end.
 * @param {Twofold[][]} table @returns {Interval[]}
 */
export function intervalsOf(table) {
  const conditions = [...table, hurwitz3(table)];
  const ends = [
    ...positiveRoots(conditions[5]).map((V) => ({ V, kind: "weave" })),
    ...positiveRoots(table[0]).map((V) => ({ V, kind: "capsize" })),
  ].sort((a, b) => subtract(a.V, b.V)[0]);
  const low = [{ V: twofold(0), kind: "rest" }, ...ends];
  /** @type {Interval[]} */
  const found = [];
  low.forEach((lower, i) => {
    const upper = ends[i];
    const inside = upper ? multiply(add(lower.V, upper.V), [0.5, 0]) : add(multiply(lower.V, [2, 0]), [1, 0]);
    if (!conditions.every((a) => value(a, inside)[0] > 0)) return;
    found.push({
      V1: lower.V[0], V2: upper ? upper.V[0] : null, lower: lower.kind, upper: upper ? upper.kind : "unbounded",
    });
  });
  return found;
}

/** The coefficients of s⁰ … s⁴ at a speed. @param {Twofold[][]} table @param {Twofold} V */
export const quarticAt = (table, V) => table.map((row) => value(row, V));
