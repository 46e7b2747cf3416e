// (machine, λ, σ) → the table P[k][j] of its characteristic polynomial Σ P[k][j] s^k V^j.

import { add, multiply, sineCosine, twofold } from "./twofold.mjs";

/** @typedef {import("./twofold.mjs").Twofold} Twofold */
/** A term: the powers of sin λ, cos λ and σ, and its coefficient as two doubles.
 * @typedef {[number, number, number, number, number]} Term */
/** @typedef {Term[]} Formula */
/**
 * @typedef {object} Machine
 * @property {string} name
 * @property {string} command options of the command line that mean this machine
 * @property {Formula[][]} table [k][j]
 * @property {Record<string, Formula[][]>} motion M, and Cn and Kn: what is times V^n and the rates or angles
 * @property {number} c wheelbase [m]
 * @property {number} R1 rear wheel's radius [m]
 * @property {number} R2 front wheel's radius [m]
 * @property {{ m: number, l: number, h: number }[]} parts masses [kg] and centres of mass [m], rear and front
 */

/** The values of sin λ, cos λ and σ to some powers. @param {number} lam [rad] @param {number} sigma */
export function powersOf(lam, sigma) {
  const { sin, cos } = sineCosine(lam);
  return [sin, cos, twofold(sigma)].map((x) => {
    const powers = [twofold(1)];
    for (let i = 1; i < 9; i += 1) powers.push(multiply(powers[i - 1], x));
    return powers;
  });
}

/** @param {Formula} formula @param {Twofold[][]} powers @returns {Twofold} */
export function evaluated(formula, powers) {
  let total = twofold(0);
  for (const [i, j, k, value, rest] of formula) {
    const term = multiply(multiply(powers[0][i], powers[1][j]), powers[2][k]);
    total = add(total, multiply(term, [value, rest]));
  }
  return total;
}

/** @param {Machine} machine @param {number} lam [rad] @param {number} sigma @returns {Twofold[][]} */
export function tableOf(machine, lam, sigma) {
  const powers = powersOf(lam, sigma);
  return machine.table.map((row) => row.map((formula) => evaluated(formula, powers)));
}
