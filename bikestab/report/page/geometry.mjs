// A design in the words of builders: head angle, trail, fork offset; and the machine seen from its side.

/** @typedef {import("./table.mjs").Machine} Machine */

/** @param {Machine} machine @param {number} lam [rad] @param {number} sigma */
export function measures(machine, lam, sigma) {
  const trail = sigma * machine.c;
  return {
    headAngle: 90 - (lam * 180) / Math.PI,
    trail,
    offset: machine.R2 * Math.sin(lam) - trail * Math.cos(lam), // the paper's b
  };
}

/** σ at which the fork's offset is this. @param {Machine} machine @param {number} lam @param {number} offset [m] */
export const sigmaOfOffset = (machine, lam, offset) =>
  (machine.R2 * Math.sin(lam) - offset) / (machine.c * Math.cos(lam));
