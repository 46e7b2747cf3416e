// (machine, λ, σ, V) → the motion after a push: roll, steer and path, by the matrix exponential.
//
// M q'' + (C0 + V C1) q' + (K0 + V² K2) q = 0 with q = (roll, steer) in the signs of Meijaard et al. (2007), and
// what feedback adds.

import { evaluated, powersOf } from "./table.mjs";

/** @typedef {import("./table.mjs").Machine} Machine */
/** @typedef {{ t: number[], roll: number[], steer: number[], x: number[], y: number[], yaw: number[] }} Motion */

/**
 * The matrix A of (roll, steer, roll rate, steer rate)' = A (…).
 * @param {Machine} machine @param {number} lam @param {number} sigma @param {number} V @returns {number[][]}
 */
export function stateMatrix(machine, lam, sigma, V) {
  const powers = powersOf(lam, sigma);
  const found = Object.entries(machine.motion).map(([name, matrix]) =>
    /** @type {const} */ ([name, matrix.map((row) => row.map((formula) => evaluated(formula, powers)[0]))]));
  /** @param {string} kind */
  const sum = (kind) => found.filter(([name]) => name[0] === kind).reduce((total, [name, matrix]) =>
    total.map((row, i) => row.map((x, j) => x + V ** Number(name.slice(1)) * matrix[i][j])), [[0, 0], [0, 0]]);
  const [M, C, K] = [sum("M"), sum("C"), sum("K")];
  const det = M[0][0] * M[1][1] - M[0][1] * M[1][0];
  const inverse = [[M[1][1] / det, -M[0][1] / det], [-M[1][0] / det, M[0][0] / det]];
  const lower = inverse.map((row) => [K, C].flatMap((X) => [0, 1].map((j) => -(row[0] * X[0][j] + row[1] * X[1][j]))));
  return [[0, 0, 1, 0], [0, 0, 0, 1], ...lower];
}

/** @param {number[][]} A @param {number[][]} B */
const product = (A, B) => A.map((row) => B[0].map((_, j) => row.reduce((sum, x, k) => sum + x * B[k][j], 0)));

/** exp(A), by its series of A halved until it is small. @param {number[][]} A @returns {number[][]} */
export function exponential(A) {
  const norm = Math.max(...A.map((row) => row.reduce((sum, x) => sum + Math.abs(x), 0)));
  const halvings = Math.max(0, Math.ceil(Math.log2(norm || 1)) + 4);
  const small = A.map((row) => row.map((x) => x / 2 ** halvings));
  let term = A.map((row, i) => row.map((_, j) => Number(i === j)));
  let total = term;
  for (let k = 1; k < 14; k += 1) {
    term = product(term, small).map((row) => row.map((x) => x / k));
    total = total.map((row, i) => row.map((x, j) => x + term[i][j]));
  }
  for (let k = 0; k < halvings; k += 1) total = product(total, total);
  return total;
}

/**
 * @param {Machine} machine @param {number} lam [rad] @param {number} sigma @param {number} V [m/s]
 * @param {number} rollRate of the push [rad/s] @param {number} end [s] @param {number} steps
 * @returns {Motion}
 */
export function pushed(machine, lam, sigma, V, rollRate, end = 5, steps = 250) {
  const dt = end / steps;
  // the yaw and both coordinates on the road go along as further states: their rates are linear too
  const A = stateMatrix(machine, lam, sigma, V);
  const turn = Math.cos(lam) / machine.c;
  const whole = [
    ...A.map((row) => [...row, 0, 0]),
    [0, V * turn, 0, sigma * machine.c * turn, 0, 0],
    [0, 0, 0, 0, V, 0],
  ];
  const step = exponential(whole.map((row) => row.map((x) => x * dt)));
  let state = [0, 0, rollRate, 0, 0, 0];
  /** @type {Motion} */
  const out = { t: [], roll: [], steer: [], x: [], y: [], yaw: [] };
  for (let i = 0; i <= steps; i += 1) {
    out.t.push(i * dt);
    out.roll.push(state[0]);
    out.steer.push(state[1]);
    out.yaw.push(state[4]);
    out.x.push(i * dt * V);
    out.y.push(state[5]);
    state = step.map((row) => row.reduce((sum, x, k) => sum + x * state[k], 0));
  }
  return out;
}
