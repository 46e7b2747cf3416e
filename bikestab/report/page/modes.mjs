// (table, speeds) → four continuous branches of eigenvalues, each with the name of its motion.
//
// A mode bears the name of the edge that it makes: the pair that crosses the imaginary axis at a weave end of
// the stable speeds is weave, the real eigenvalue that crosses zero at a capsize end is capsize, as far up and
// down as they meet no other. What makes no edge is named after the highest speeds with exactly one pair.

import { quarticRoots } from "./eigenvalues.mjs";

/** @typedef {import("./eigenvalues.mjs").Complex} Complex */
/** @typedef {import("./twofold.mjs").Twofold} Twofold */
/** @typedef {import("./intervals.mjs").Interval} Interval */
/** @typedef {{ V: number[], s: Complex[][], names: string[][] }} Modes s and names are [branch][speed] */

const ORDERS = permutations([0, 1, 2, 3]);
const FAR = 48; // speeds above those wanted, to 1000 times as fast, which only give names

/** @param {number[]} items @returns {number[][]} */
function permutations(items) {
  if (items.length < 2) return [items];
  return items.flatMap((x, i) => permutations(items.toSpliced(i, 1)).map((rest) => [x, ...rest]));
}

/** @param {Twofold[][]} table @param {number} V */
const quartic = (table, V) => table.map((row) => row.reduceRight((sum, x) => sum * V + x[0], 0));

/**
 * @param {Twofold[][]} table
 * @param {Interval[]} intervals the stable ones, whose ends give the names
 * @param {number[]} speeds ascending [m/s]
 * @returns {Modes}
 */
export function follow(table, intervals, speeds) {
  const top = Math.max(speeds[speeds.length - 1], 1);
  const V = [...speeds, ...Array.from({ length: FAR }, (_, i) => top * 1000 ** ((i + 1) / FAR))];
  /** @type {Complex[][]} */
  const at = [];
  for (const speed of V) {
    const last = at[at.length - 1];
    const roots = quarticRoots(quartic(table, speed), last);
    at.push(last ? nearest(last, at[at.length - 2] ?? last, roots) : roots);
  }
  const names = named(V, at, intervals);
  const wanted = speeds.length;
  return {
    V: speeds,
    s: [0, 1, 2, 3].map((b) => at.slice(0, wanted).map((z) => z[b])),
    names: [0, 1, 2, 3].map((b) => names.slice(0, wanted).map((z) => z[b])),
  };
}

const CLOSER = 10; // points on both sides of a speed where two eigenvalues meet, each four times as near

/** Speeds with more where two eigenvalues meet, beside which curves are steep. @param {Twofold[][]} table
 * @param {number[]} speeds ascending [m/s] */
export function closer(table, speeds) {
  /** @param {number} V */
  const pairs = (V) => quarticRoots(quartic(table, V), undefined).filter(([, y]) => y > 0).length;
  const number = speeds.map(pairs);
  const more = speeds.slice(1).flatMap((high, i) => {
    if (number[i] === number[i + 1]) return [];
    let [a, b] = [speeds[i], high];
    for (let k = 0; k < 40; k += 1) {
      const middle = (a + b) / 2;
      if (pairs(middle) === number[i]) a = middle;
      else b = middle;
    }
    const away = Array.from({ length: CLOSER }, (_, k) => (high - speeds[i]) * 4 ** (-k - 1));
    return [a, b, ...away.flatMap((x) => [a - x, b + x])].filter((V) => V > speeds[i] && V < high);
  });
  return [...speeds, ...more].sort((a, b) => a - b);
}

/** The roots in the order in which they go on from the last ones. @param {Complex[]} last
 * @param {Complex[]} before @param {Complex[]} roots @returns {Complex[]} */
function nearest(last, before, roots) {
  const cost = last.map(([x, y], i) => {
    const [u, v] = before[i];
    // a branch goes on straight, unless it was just turned by a coalescence
    const kind = (y === 0) === (v === 0) ? 1 : 0;
    return roots.map(([a, b]) => Math.hypot(a - x - kind * (x - u), b - y - kind * (y - v)));
  });
  let best = ORDERS[0];
  let least = Infinity;
  for (const order of ORDERS) {
    const total = order.reduce((sum, k, i) => sum + cost[i][k], 0);
    if (total < least) [best, least] = [order, total];
  }
  return best.map((k) => roots[k]);
}

/** @param {number[]} V @param {Complex[][]} at [speed][branch] @param {Interval[]} intervals */
function named(V, at, intervals) {
  const names = at.map(own(at));
  /** @type {[number, string][]} */
  const ends = intervals.flatMap((x) => [[x.V1, x.lower], [x.V2 ?? NaN, x.upper]]);
  /** @type {Map<string, Set<string>>} */
  const made = new Map();
  for (const [speed, kind] of ends.filter(([, name]) => name === "weave" || name === "capsize").sort((a, b) => a[0] - b[0])) {
    const pair = kind === "weave";
    let i = V.findIndex((x) => x >= speed);
    if (i < 0) continue;
    if (i > 0 && !has(at[i], pair)) i -= 1;
    if (!has(at[i], pair)) continue;
    const fit = [0, 1, 2, 3].filter((b) => (at[i][b][1] !== 0) === pair);
    const near = fit.sort((a, b) => size(at[i][a], pair) - size(at[i][b], pair)).slice(0, pair ? 2 : 1);
    for (const step of [-1, 1]) {
      for (let k = i; k >= 0 && k < V.length && near.every((b) => (at[k][b][1] !== 0) === pair); k += step) {
        const taken = [0, 1, 2, 3].some((b) => !near.includes(b) && made.get(String(k))?.has(`${kind} ${b}`));
        const name = taken ? `${kind} 2` : kind;
        [0, 1, 2, 3].forEach((b) => {
          if (near.includes(b)) names[k][b] = name;
          else if (names[k][b] === kind && !made.get(String(k))?.has(`${kind} ${b}`)) names[k][b] = `${kind} 2`;
        });
        const marks = made.get(String(k)) ?? new Set();
        near.forEach((b) => marks.add(`${kind} ${b}`));
        made.set(String(k), marks);
      }
    }
  }
  return names;
}

/** @param {Complex[]} s @param {boolean} pair */
const has = (s, pair) => s.some(([, y]) => (y !== 0) === pair);
/** @param {Complex} s @param {boolean} pair */
const size = ([x, y], pair) => (pair ? Math.abs(x) : Math.hypot(x, y));

/** Names after the highest speeds with exactly one pair. @param {Complex[][]} at
 * @returns {(s: Complex[]) => string[]} */
function own(at) {
  const last = at.findLast((s) => s.filter(([, y]) => y !== 0).length === 2) ?? at[at.length - 1];
  let real = [0, 1, 2, 3].filter((b) => last[b][1] === 0).sort((a, b) => Math.abs(last[a][0]) - Math.abs(last[b][0]));
  if (real.length < 2) {
    real = [0, 1, 2, 3].sort((a, b) => Math.abs(last[a][1]) - Math.abs(last[b][1])).slice(0, 2);
  }
  const [capsize, castering] = [real[0], real[real.length - 1]];
  const weave = [0, 1, 2, 3].filter((b) => b !== capsize && b !== castering);
  return (s) => {
    const oscillates = s.map(([, y]) => y !== 0);
    const together = weave.every((b) => oscillates[b]) && Math.abs(s[weave[0]][1] + s[weave[1]][1]) <= 1e-9 * Math.hypot(...s[weave[0]]);
    return s.map((_, b) => {
      if (oscillates[b]) return weave.includes(b) && together ? "weave" : "pair 2";
      if (b === capsize) return "capsize";
      if (b === castering) return "castering";
      return weave.some((k) => oscillates[k]) ? "real" : "real pair";
    });
  };
}
