// The page's arithmetic against exact fractions of whole numbers, and polynomials with known zeros.

import assert from "node:assert/strict";
import { test } from "node:test";

import { eigenvaluesAt, quarticRoots } from "../../bikestab/report/page/eigenvalues.mjs";
import { exponential } from "../../bikestab/report/page/motion.mjs";
import { positiveRoots } from "../../bikestab/report/page/roots.mjs";
import { add, divide, multiply, sineCosine, subtract, twofold, value } from "../../bikestab/report/page/twofold.mjs";

const SCALE = 2n ** 200n;

/** A double as a whole number of 2^-200. */
function whole(x) {
  if (x === 0) return 0n;
  const power = Math.floor(Math.log2(Math.abs(x))) - 53;
  const mantissa = BigInt(x * 2 ** -power);
  return power + 200 >= 0 ? mantissa * 2n ** BigInt(power + 200) : mantissa / 2n ** BigInt(-power - 200);
}
const pair = ([a, b]) => whole(a) + whole(b);
const size = (x) => (x < 0n ? -x : x);

/** Numbers that are the same in every run (Lehmer 1951). */
function* random(seed) {
  for (let x = seed; ;) {
    x = (x * 48271) % 2147483647;
    yield (x / 2147483647 - 0.5) * 2 ** ((x % 9) - 4);
  }
}

test("sums, products and quotients of pairs are right to 1e-31", () => {
  const numbers = random(7);
  const next = () => /** @type {number} */ (numbers.next().value);
  for (let i = 0; i < 3000; i += 1) {
    const a = add(twofold(next()), twofold(next() * 1e-17));
    const b = add(twofold(next()), twofold(next() * 1e-17));
    const [x, y] = [pair(a), pair(b)];
    const cases = [
      [add(a, b), x + y, size(x) + size(y)],
      [subtract(a, b), x - y, size(x) + size(y)],
      [multiply(a, b), (x * y) / SCALE, size(x * y) / SCALE],
      [divide(a, b), (x * SCALE) / y, size((x * SCALE) / y)],
    ];
    for (const [got, right, terms] of cases) {
      assert.ok(size(pair(got) - right) * 10n ** 31n <= terms + 10n ** 31n, `${i}`);
    }
  }
});

test("sine and cosine have squares that add up to one, and the doubles that Math has", () => {
  for (let angle = -1.4; angle <= 1.4; angle += 0.0173) {
    const { sin, cos } = sineCosine(angle);
    const one = subtract(add(multiply(sin, sin), multiply(cos, cos)), twofold(1));
    assert.ok(Math.abs(one[0]) < 1e-31);
    assert.ok(Math.abs(sin[0] - Math.sin(angle)) < 2e-16 && Math.abs(cos[0] - Math.cos(angle)) < 2e-16);
  }
  // 50 digits of mpmath: sin 0.5 = 0.47942553860420300027328793521557138808180336794060
  const half = sineCosine(0.5).sin;
  assert.equal(half[0], 0.479425538604203);
});

/** Π (x − z) as pairs. */
function product(zeros) {
  let a = [twofold(1)];
  for (const z of zeros) {
    const out = Array.from({ length: a.length + 1 }, () => twofold(0));
    a.forEach((x, i) => {
      out[i] = subtract(out[i], multiply(x, twofold(z)));
      out[i + 1] = add(out[i + 1], x);
    });
    a = out;
  }
  return a;
}

test("positive zeros are found, however near to each other", () => {
  const cases = [
    [1, 2, 3, 4, 5, 6], [-3, -1, 0.5, 7], [1e-3, 1, 1e3], [1, 1 + 1e-12, 5], [2, 2 + 1e-7, 2 + 2e-7, 9],
    [0.1, 0.2, 1e6],
  ];
  for (const zeros of cases) {
    const found = positiveRoots(product(zeros)).map((x) => x[0]);
    const right = zeros.filter((z) => z > 0);
    assert.equal(found.length, right.length, `${zeros}`);
    found.forEach((x, i) => assert.ok(Math.abs(x - right[i]) <= 2e-15 * right[i], `${x} for ${right[i]}`));
  }
});

test("what touches zero, vanishes or has no zero gives none", () => {
  const square = product([2, 2]);
  assert.deepEqual(positiveRoots(square), []);
  assert.deepEqual(positiveRoots([twofold(0), twofold(0)]), []);
  assert.deepEqual(positiveRoots([twofold(1), twofold(0), twofold(1)]), []);
  assert.equal(positiveRoots([twofold(0), twofold(-2), twofold(1)])[0][0], 2);
});

test("eigenvalues that meet are right to the last digits", () => {
  const cases = [[-1, -1, -3, -4], [-2, -2, -2, 5], [-1, -1 - 1e-10, 3, 4], [-0.5, 0.5, 1, -1e-8]];
  for (const zeros of cases) {
    const found = eigenvaluesAt(product(zeros));
    const right = [...zeros].sort((a, b) => a - b);
    const largest = Math.max(...zeros.map(Math.abs));
    found.forEach(([re, im], i) => {
      assert.ok(Math.abs(re - right[i]) < 1e-10 * largest && Math.abs(im) < 1e-10 * largest, `${re} ${im} for ${zeros}`);
    });
  }
});

test("the quick roots multiply to the quartic again", () => {
  const numbers = random(11);
  const next = () => /** @type {number} */ (numbers.next().value);
  for (let i = 0; i < 2000; i += 1) {
    const a = [next(), next(), next(), next(), 1];
    for (const [x, y] of quarticRoots(a)) {
      let [re, im, terms] = [0, 0, 0];
      for (const coefficient of [...a].reverse()) {
        [re, im] = [re * x - im * y + coefficient, re * y + im * x];
        terms = terms * Math.hypot(x, y) + Math.abs(coefficient);
      }
      assert.ok(Math.hypot(re, im) < 1e-12 * terms, `${a}`);
    }
  }
});

test("the exponential of a rotation turns", () => {
  for (const angle of [0.1, 1, 30]) {
    const turned = exponential([[0, -angle], [angle, 0]]);
    assert.ok(Math.abs(turned[0][0] - Math.cos(angle)) < 1e-12 && Math.abs(turned[1][0] - Math.sin(angle)) < 1e-12);
  }
  assert.ok(Math.abs(value([twofold(1), twofold(2)], twofold(3))[0] - 7) < 1e-15);
});
