// Numbers in twice double precision: pairs [value, rest] whose sum is meant, rest at most half a unit of value.

/** @typedef {[number, number]} Twofold */

const SPLIT = 134217729; // 2^27 + 1 cuts a double into two halves (Dekker 1971)

/** @param {number} x @returns {Twofold} */
export const twofold = (x) => [x, 0];

/** The sum of doubles and its exact rest (Knuth). @param {number} a @param {number} b @returns {Twofold} */
function sum(a, b) {
  const s = a + b;
  const c = s - a;
  return [s, a - (s - c) + (b - c)];
}

/** The product of doubles and its exact rest. @param {number} a @param {number} b @returns {Twofold} */
function product(a, b) {
  const p = a * b;
  let t = SPLIT * a;
  const ah = t - (t - a);
  const al = a - ah;
  t = SPLIT * b;
  const bh = t - (t - b);
  const bl = b - bh;
  return [p, ah * bh - p + ah * bl + al * bh + al * bl];
}

/** @param {number} value @param {number} rest @returns {Twofold} */
function normal(value, rest) {
  const s = value + rest;
  return [s, rest - (s - value)];
}

/** @param {Twofold} a @param {Twofold} b @returns {Twofold} */
export function add(a, b) {
  const [s, r] = sum(a[0], b[0]);
  const [t, q] = sum(a[1], b[1]);
  const [u, v] = normal(s, r + t);
  return normal(u, v + q);
}

/** @param {Twofold} a @returns {Twofold} */
export const negative = (a) => [-a[0], -a[1]];

/** @param {Twofold} a @param {Twofold} b */
export const subtract = (a, b) => add(a, negative(b));

/** @param {Twofold} a @param {Twofold} b @returns {Twofold} */
export function multiply(a, b) {
  const [p, r] = product(a[0], b[0]);
  return normal(p, r + (a[0] * b[1] + a[1] * b[0]));
}

/** @param {Twofold} a @param {Twofold} b @returns {Twofold} */
export function divide(a, b) {
  const first = a[0] / b[0];
  const left = subtract(a, multiply(b, [first, 0]));
  const second = left[0] / b[0];
  const last = subtract(left, multiply(b, [second, 0]));
  return add(normal(first, second), [last[0] / b[0], 0]);
}

/** Σ a[i] x^i and its slope, from the highest power down. @param {Twofold[]} a @param {Twofold} x */
export function value(a, x) {
  let v = a[a.length - 1];
  for (let i = a.length - 2; i >= 0; i -= 1) v = add(multiply(v, x), a[i]);
  return v;
}

/** The coefficients of the derivative. @param {Twofold[]} a @returns {Twofold[]} */
export const derivative = (a) => a.slice(1).map((x, i) => multiply(x, [i + 1, 0]));

/**
 * Sine and cosine of a double of at most some units, by their series.
 * @param {number} angle [rad]
 * @returns {{ sin: Twofold, cos: Twofold }}
 */
export function sineCosine(angle) {
  const square = multiply([angle, 0], [angle, 0]);
  /** @type {Twofold} */
  let sin = [angle, 0];
  /** @type {Twofold} */
  let cos = [1, 0];
  let s = sin;
  let c = cos;
  for (let k = 1; Math.abs(s[0]) + Math.abs(c[0]) > 1e-36 && k < 60; k += 1) {
    c = divide(negative(multiply(c, square)), [(2 * k - 1) * (2 * k), 0]);
    s = divide(negative(multiply(s, square)), [2 * k * (2 * k + 1), 0]);
    cos = add(cos, c);
    sin = add(sin, s);
  }
  return { sin, cos };
}
