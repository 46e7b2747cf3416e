// What Python wrote into the page: volumes with their machines; and what is drawn of one machine.

import { sigmaOfOffset } from "./geometry.mjs";

/** @typedef {import("./table.mjs").Machine} Machine */
/**
 * @typedef {Machine & { own: number[] | null, delta: number, source: string, picture: string, view: number[][],
 *   parameters: Record<string, number | null>, plane: { lam: number[], sigma: number[], step: number, width: string },
 *   curves: { name: string, lam: number[], sigma: number[] }[],
 *   mesh: { points: string, triangles: string, kind: string } }} Entry view: (λ, σ, V, 1) → the picture's shares
 */
/** @typedef {{ name: string, meaning: string, unit: string, values: number[] }} Axis of a sweep */
/** @typedef {{ lam: number[], sigma: number[], V: number[] }} Box */
/**
 * @typedef {{ title: string, model: string, version: string, warnings: string[], box: Box, sweep: Axis[],
 *   machines: Entry[], samples: number }} Volume samples: machines of its ensemble, which the page leaves out
 */
/** @typedef {{ version: string, cite: string, volumes: Volume[] }} Data */
/**
 * @typedef {object} Shown what is drawn, for one machine
 * @property {Box} box
 * @property {{ lam: number[], sigma: number[], width: Float32Array }} plane
 * @property {{ name: string, lam: number[], sigma: number[] }[]} curves
 * @property {{ points: Float32Array, triangles: Int32Array, kind: Uint8Array }} mesh
 * @property {{ lam: number[], sigma: number[] }} straight designs whose fork offset is zero
 * @property {number[] | null} own
 */

/** @param {string} text of base64 */
export function bytes(text) {
  const letters = atob(text);
  const out = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i += 1) out[i] = letters.charCodeAt(i);
  return out;
}

/** The machine at positions of a sweep, whose last axis runs fastest. @param {Volume} volume @param {number[]} sweep */
export const machineAt = ({ sweep: axes, machines }, sweep) =>
  machines[axes.reduce((sum, axis, i) => sum * axis.values.length + (sweep[i] ?? 0), 0)];

/** What of a sweep the machine of this number is. @param {Volume} volume @param {number} number */
export const swept = ({ sweep }, number) => sweep.map((axis, k) => {
  const below = sweep.slice(k + 1).reduce((n, other) => n * other.values.length, 1);
  return `${axis.name} = ${axis.values[Math.floor(number / below) % axis.values.length]}`;
});

/** @param {Box} box @param {number} lam @param {number} sigma */
export const within = (box, lam, sigma) =>
  lam >= box.lam[0] && lam <= box.lam[1] && sigma >= box.sigma[0] && sigma <= box.sigma[1];

/** @type {Map<Entry, Shown>} */
const known = new Map();

/** @param {Entry} machine @param {Box} box */
export function shownOf(machine, box) {
  const found = known.get(machine) ?? decoded(machine, box);
  known.set(machine, found);
  return found;
}

/** @param {Entry} machine @param {Box} box @returns {Shown} */
function decoded(machine, box) {
  const { curves, own, plane, mesh } = machine;
  const tilts = Array.from({ length: 101 }, (_, i) => box.lam[0] + (i / 100) * (box.lam[1] - box.lam[0]));
  const straight = tilts.map((lam) => [lam, sigmaOfOffset(machine, lam, 0)]).filter(([lam, sigma]) => within(box, lam, sigma));
  const steps = new Uint16Array(bytes(mesh.points).buffer);
  const ends = [box.lam, box.sigma, box.V];
  return {
    box, curves, own,
    straight: { lam: straight.map(([lam]) => lam), sigma: straight.map(([, sigma]) => sigma) },
    plane: { ...plane, width: Float32Array.from(new Uint16Array(bytes(plane.width).buffer), (step) => step * plane.step) },
    mesh: {
      points: Float32Array.from(steps, (step, i) => {
        const [low, top] = ends[i % 3];
        return low + ((top - low) * step) / 65535;
      }),
      triangles: Int32Array.from(new (steps.length <= 3 * 65535 ? Uint16Array : Uint32Array)(bytes(mesh.triangles).buffer)),
      kind: bytes(mesh.kind),
    },
  };
}
