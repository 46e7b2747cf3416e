// The machine from its side, to scale, and from behind, moving: small pictures of our own in SVG.

import { measures } from "./geometry.mjs";

/** @typedef {import("./table.mjs").Machine} Machine */

const REAR = "#0072b2";
const FRONT = "#d55e00";

/** @param {string} name @param {Record<string, string | number>} attributes @param {string} [text] */
function shape(name, attributes, text) {
  const words = Object.entries(attributes).map(([key, value]) => `${key}="${value}"`).join(" ");
  return `<${name} ${words}>${text ?? ""}</${name}>`;
}

/** @param {number} x */
const mm = (x) => `${(1000 * x).toFixed(0)} mm`.replace("-", "−");

/**
 * @param {SVGElement} svg @param {Machine} machine @param {number} lam [rad] @param {number} sigma
 */
export function drawSide(svg, machine, lam, sigma) {
  const { trail, offset } = measures(machine, lam, sigma);
  const { c, R1, R2, parts } = machine;
  const angle = (90 - (lam * 180) / Math.PI).toFixed(1);
  const high = 1.15 * Math.max(2 * R1, 2 * R2, ...parts.map((part) => part.h));
  const left = -Math.max(R1, 0.1 * c) - 0.05 * c;
  const right = Math.max(c + R2, c + trail) + 0.05 * c;
  const [thin, letter] = [0.004 * (right - left), 0.042 * (right - left)];
  const below = 5 * thin + 1.3 * letter; // the first line of text, free of the lines above it
  svg.setAttribute("viewBox", `${left} ${-high} ${right - left} ${high + below + 1.8 * letter}`);
  const foot = c + trail;
  const top = [foot - Math.tan(lam) * high, high];
  // the front axle's foot on the steering axis
  const on = [c - offset * Math.cos(lam), R2 - offset * Math.sin(lam)];
  const text = { "font-size": letter, "text-anchor": "middle" };
  const head = [top[0] + 0.22 * (foot - top[0]), 0.78 * high];
  svg.innerHTML = [
    shape("line", { x1: left, x2: right, y1: 0, y2: 0, stroke: "currentColor", "stroke-width": thin }),
    shape("circle", { cx: 0, cy: -R1, r: R1, fill: "none", stroke: REAR, "stroke-width": 2.5 * thin }),
    shape("circle", { cx: c, cy: -R2, r: R2, fill: "none", stroke: FRONT, "stroke-width": 2.5 * thin }),
    shape("path", { d: `M0 ${-R1} L${parts[0].l} ${-Math.min(parts[0].h, 0.7 * high)} L${head[0]} ${-head[1]} M0 ${-R1} L${0.36 * c} ${-1.05 * R1} L${head[0]} ${-head[1]}`, fill: "none", stroke: REAR, "stroke-width": 2 * thin, opacity: 0.55 }),
    shape("path", { d: `M${c} ${-R2} L${on[0]} ${-on[1]} L${head[0]} ${-head[1]}`, fill: "none", stroke: FRONT, "stroke-width": 2.2 * thin }),
    shape("line", { x1: foot, y1: 0, x2: top[0], y2: -top[1], stroke: "currentColor", "stroke-width": thin, "stroke-dasharray": `${8 * thin} ${4 * thin}` }),
    ...parts.map((part, i) => shape("circle", { cx: part.l, cy: -part.h, r: 6 * thin, fill: i ? FRONT : REAR, stroke: "currentColor", "stroke-width": thin })
      + shape("text", { ...text, "text-anchor": "start", x: part.l + 9 * thin, y: -part.h + (i ? 4 : -4) * thin }, `${part.m.toFixed(1)} kg`)),
    shape("line", { x1: c, x2: foot, y1: 5 * thin, y2: 5 * thin, stroke: "currentColor", "stroke-width": 3 * thin }),
    shape("text", { ...text, x: Math.min((c + foot) / 2, right - 0.2 * c), y: below }, `trail ${mm(trail)}`),
    shape("line", { x1: 0, x2: c, y1: 5 * thin, y2: 5 * thin, stroke: "currentColor", "stroke-width": thin }),
    shape("text", { ...text, x: 0.36 * c, y: below }, `wheelbase ${mm(c)}`),
    shape("text", { ...text, x: 0.5 * (left + right), y: below + 1.3 * letter }, `head angle ${angle}°, fork offset ${mm(offset)}`),
  ].join("");
  svg.setAttribute("aria-label", `The machine from its side: head angle ${angle} degrees, trail ${mm(trail)}, fork offset ${mm(offset)}, wheelbase ${mm(c)}.`);
}

/**
 * @param {SVGElement} svg @param {Machine} machine @param {number} roll [rad] @param {number} steer [rad]
 */
export function drawRear(svg, machine, roll, steer) {
  const high = 1.2 * Math.max(2 * machine.R1, machine.parts[0].h);
  const wide = 0.55 * high;
  svg.setAttribute("viewBox", `${-wide} ${-high} ${2 * wide} ${1.1 * high}`);
  const turn = (roll * 180) / Math.PI;
  const bar = 0.22 * high;
  const y = -0.72 * high;
  const [dx, dy] = [bar * Math.cos(steer), 0.35 * bar * Math.sin(steer)];
  const tyre = 0.03 * high;
  const front = tyre + machine.R2 * Math.abs(Math.sin(steer));
  svg.innerHTML = shape("line", { x1: -wide, x2: wide, y1: 0, y2: 0, stroke: "currentColor", "stroke-width": 0.006 * high })
    + shape("g", { transform: `rotate(${turn})` }, [
      shape("rect", { x: -front, y: -2 * machine.R2, width: 2 * front, height: 2 * machine.R2, rx: front, fill: "none", stroke: FRONT, "stroke-width": 0.01 * high }),
      shape("rect", { x: -tyre, y: -2 * machine.R1, width: 2 * tyre, height: 2 * machine.R1, rx: tyre, fill: REAR }),
      shape("line", { x1: 0, x2: 0, y1: -2 * machine.R1, y2: y, stroke: REAR, "stroke-width": 0.02 * high }),
      shape("line", { x1: -dx, x2: dx, y1: y + dy, y2: y - dy, stroke: FRONT, "stroke-width": 0.02 * high }),
      shape("circle", { cx: 0, cy: -machine.parts[0].h, r: 0.04 * high, fill: REAR, stroke: "currentColor", "stroke-width": 0.006 * high }),
    ].join(""));
}
