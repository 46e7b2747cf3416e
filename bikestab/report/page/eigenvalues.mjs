// The four roots of a real quartic: in double precision along a curve, in twice that for single speeds.

import { add, divide, multiply, negative, subtract, twofold } from "./twofold.mjs";

/** @typedef {import("./twofold.mjs").Twofold} Twofold */
/** @typedef {[number, number]} Complex */

/**
 * Roots of Σ a[k] s^k, all four improved at once (Ehrlich 1967, Aberth 1973).
 * @param {number[]} a a[4] ≠ 0
 * @param {Complex[]} [start] where to begin, for example the roots at a speed nearby
 * @returns {Complex[]}
 */
export function quarticRoots(a, start) {
  const [e, d, c, b] = a.slice(0, 4).map((x) => x / a[4]);
  const s = start ? apart(start) : circle([e, d, c, b]);
  for (let step = 0; step < 80; step += 1) {
    let moved = 0;
    for (let i = 0; i < 4; i += 1) {
      const [x, y] = s[i];
      // value and slope by Horner
      let [vr, vi, wr, wi] = [1, 0, 0, 0];
      for (const coefficient of [b, c, d, e]) {
        [wr, wi] = [wr * x - wi * y + vr, wr * y + wi * x + vi];
        [vr, vi] = [vr * x - vi * y + coefficient, vr * y + vi * x];
      }
      if (vr === 0 && vi === 0) continue;
      // step = 1/(slope/value − Σ 1/(s_i − s_k))
      const size = vr * vr + vi * vi;
      let qr = (wr * vr + wi * vi) / size;
      let qi = (wi * vr - wr * vi) / size;
      for (let k = 0; k < 4; k += 1) {
        if (k === i) continue;
        const [dx, dy] = [x - s[k][0], y - s[k][1]];
        const far = dx * dx + dy * dy || Number.MIN_VALUE;
        qr -= dx / far;
        qi += dy / far;
      }
      const under = qr * qr + qi * qi;
      if (!(under > 0) || !Number.isFinite(under)) continue;
      s[i] = [x - qr / under, y + qi / under];
      moved = Math.max(moved, 1 / Math.sqrt(under) / (Math.hypot(...s[i]) || 1));
    }
    if (moved < 1e-15) break;
  }
  return conjugate(s);
}

/** Four points around the roots' mean, as far as the roots may be. @param {number[]} a @returns {Complex[]} */
function circle([e, d, c, b]) {
  const radius = Math.max(Math.abs(b), Math.abs(c) ** 0.5, Math.abs(d) ** (1 / 3), Math.abs(e) ** 0.25) || 1;
  return [0, 1, 2, 3].map((k) => [
    -b / 4 + radius * Math.cos(0.4 + (k * Math.PI) / 2), radius * Math.sin(0.4 + (k * Math.PI) / 2),
  ]);
}

/** The same points, no two of them equal. @param {Complex[]} s @returns {Complex[]} */
const apart = (s) => s.map(([x, y], i) => [x * (1 + 1e-9 * i), y * (1 - 1e-9 * i) + 1e-12 * (i - 1.5)]);

/** With imaginary parts of rounding alone removed. @param {Complex[]} s @returns {Complex[]} */
function conjugate(s) {
  const size = Math.max(...s.map((z) => Math.hypot(...z)));
  return s.map(([x, y]) => [x, Math.abs(y) < 1e-13 * size ? 0 : y]);
}

/**
 * The same with coefficients in twice double precision, so that even two that meet are right to 1e-15.
 * @param {Twofold[]} p p[4] ≠ 0
 * @returns {Complex[]} ascending by real, then imaginary part
 */
export function eigenvaluesAt(p) {
  const a = [3, 2, 1, 0].map((k) => divide(p[k], p[4]));
  const rough = apart(quarticRoots(p.map((x) => x[0])));
  /** @type {[Twofold, Twofold][]} */
  const s = rough.map(([x, y]) => [twofold(x), twofold(y)]);
  for (let step = 0; step < 120; step += 1) {
    let moved = 0;
    for (let i = 0; i < 4; i += 1) {
      const z = s[i];
      let v = /** @type {[Twofold, Twofold]} */ ([twofold(1), twofold(0)]);
      let w = /** @type {[Twofold, Twofold]} */ ([twofold(0), twofold(0)]);
      for (const coefficient of a) {
        w = plus(times(w, z), v);
        v = plus(times(v, z), [coefficient, twofold(0)]);
      }
      if (v[0][0] === 0 && v[1][0] === 0) continue;
      let q = over(w, v);
      for (let k = 0; k < 4; k += 1) {
        if (k === i) continue;
        const gap = plus(z, [negative(s[k][0]), negative(s[k][1])]);
        if (Math.hypot(gap[0][0], gap[1][0]) <= 1e-40 * Math.hypot(z[0][0], z[1][0])) continue;
        q = plus(q, opposite(over([twofold(1), twofold(0)], gap)));
      }
      if (!(Math.hypot(q[0][0], q[1][0]) > 0) || !Number.isFinite(q[0][0] + q[1][0])) continue;
      const by = over([twofold(1), twofold(0)], q);
      if (!Number.isFinite(by[0][0] + by[1][0])) continue;
      s[i] = plus(z, opposite(by));
      moved = Math.max(moved, Math.hypot(by[0][0], by[1][0]) / (Math.hypot(s[i][0][0], s[i][1][0]) || 1));
    }
    if (moved < 1e-24) break;
  }
  const size = Math.max(...s.map(([x, y]) => Math.hypot(x[0], y[0])));
  return s
    .map(([x, y]) => /** @type {Complex} */ ([x[0], Math.abs(y[0]) < 1e-14 * size ? 0 : y[0]]))
    .sort((one, other) => one[0] - other[0] || one[1] - other[1]);
}

/** @typedef {[Twofold, Twofold]} Pair */
/** @param {Pair} a @param {Pair} b @returns {Pair} */
const plus = (a, b) => [add(a[0], b[0]), add(a[1], b[1])];
/** @param {Pair} a @returns {Pair} */
const opposite = (a) => [negative(a[0]), negative(a[1])];
/** @param {Pair} a @param {Pair} b @returns {Pair} */
const times = (a, b) => [
  subtract(multiply(a[0], b[0]), multiply(a[1], b[1])), add(multiply(a[0], b[1]), multiply(a[1], b[0])),
];
/** @param {Pair} a @param {Pair} b @returns {Pair} */
function over(a, b) {
  const size = add(multiply(b[0], b[0]), multiply(b[1], b[1]));
  const top = times(a, [b[0], negative(b[1])]);
  return [divide(top[0], size), divide(top[1], size)];
}
