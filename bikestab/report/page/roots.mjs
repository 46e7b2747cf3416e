// The positive zeros at which a polynomial changes its sign, in twice double precision.

import { derivative, divide, subtract, value } from "./twofold.mjs";

/** @typedef {import("./twofold.mjs").Twofold} Twofold */

/** Without the highest powers whose coefficients are zero. @param {Twofold[]} a */
export function trimmed(a) {
  let n = a.length;
  while (n > 0 && a[n - 1][0] === 0) n -= 1;
  return a.slice(0, n);
}

/**
 * Ascending. Between neighbouring zeros of the derivative a polynomial is monotonic and has one zero at most.
 * @param {Twofold[]} coefficients from the lowest power up
 * @returns {Twofold[]}
 */
export function positiveRoots(coefficients) {
  const a = trimmed(coefficients);
  const n = a.length - 1;
  if (n < 1) return [];
  const bound = beyond(a);
  /** @type {Twofold[]} */
  const cuts = [[0, 0], ...positiveRoots(derivative(a)), [bound, 0]];
  const found = [];
  for (let i = 0; i + 1 < cuts.length; i += 1) {
    const [low, high] = [cuts[i], cuts[i + 1]];
    if (high[0] < low[0]) continue;
    const below = value(a, low)[0] || (i === 0 ? firstSign(a) : 0);
    const above = value(a, high)[0];
    if (below * above < 0) found.push(between(a, low, high, Math.sign(below)));
  }
  return found;
}

/** The sign just above zero. @param {Twofold[]} a */
const firstSign = (a) => Math.sign((a.find((x) => x[0] !== 0) ?? [0])[0]);

/** A number above all zeros (Fujiwara 1916). @param {Twofold[]} a */
function beyond(a) {
  const n = a.length - 1;
  const sizes = a.slice(0, n).map((x, i) => Math.abs(x[0] / a[n][0]) ** (1 / (n - i)));
  return 2.01 * Math.max(...sizes, Number.MIN_VALUE);
}

/**
 * The zero between two numbers: halved to the last bit of a double, then Newton's steps with pairs.
 * @param {Twofold[]} a @param {Twofold} low @param {Twofold} high @param {number} sign that of a at low
 * @returns {Twofold}
 */
function between(a, low, high, sign) {
  let [x, y] = [low[0], high[0]];
  for (let i = 0; i < 1100; i += 1) {
    const middle = x > 0 && y > 4 * x ? Math.sqrt(x) * Math.sqrt(y) : 0.5 * (x + y);
    if (!(middle > x && middle < y)) break;
    if (Math.sign(value(a, [middle, 0])[0]) === sign) x = middle;
    else y = middle;
    if (x > 0 && y - x < 1e-9 * x) break;
  }
  const slope = derivative(a);
  /** @type {Twofold} */
  let root = [0.5 * (x + y), 0];
  for (let i = 0; i < 80; i += 1) {
    const down = value(slope, root);
    if (down[0] === 0) break;
    const next = subtract(root, divide(value(a, root), down));
    if (!(next[0] >= x && next[0] <= y)) return halved(a, x, y, sign);
    if (next[0] === root[0] && Math.abs(next[1] - root[1]) < 1e-28 * Math.abs(next[0])) break;
    root = next;
  }
  return root;
}

/** The zero to a double's last bit. @param {Twofold[]} a @param {number} x @param {number} y @param {number} sign */
function halved(a, x, y, sign) {
  for (;;) {
    const middle = 0.5 * (x + y);
    if (!(middle > x && middle < y)) return /** @type {Twofold} */ ([middle, 0]);
    if (Math.sign(value(a, [middle, 0])[0]) === sign) x = middle;
    else y = middle;
  }
}
