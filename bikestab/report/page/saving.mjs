// Charts and drawings → files.

import { style } from "./charts.mjs";
import { element, input } from "./elements.mjs";
import { plotly } from "./library.mjs";

const SIZE = { width: 1000, height: 700 };

/** Save what is selected. @param {"png" | "svg"} format */
export async function save(format) {
  const what = /** @type {HTMLSelectElement} */ (/** @type {unknown} */ (input("which"))).value;
  const filename = `bikestab-${what}`;
  if (what !== "side") {
    const { data, layout } = /** @type {any} */ (element(what));
    const opaque = { ...layout, paper_bgcolor: style("--ground") }; // a chart lets the page's ground through
    plotly().downloadImage({ data, layout: opaque }, { ...SIZE, format, filename, scale: format === "png" ? 2 : 1 });
    return;
  }
  const address = URL.createObjectURL(new Blob([drawing()], { type: "image/svg+xml" }));
  Object.assign(document.createElement("a"), {
    href: format === "svg" ? address : await painted(address), download: `${filename}.${format}`,
  }).click();
  URL.revokeObjectURL(address);
}

/** The machine as a picture of its own, black on white. */
function drawing() {
  const svg = /** @type {SVGElement} */ (element("side").cloneNode(true));
  for (const [name, value] of Object.entries({ ...SIZE, xmlns: "http://www.w3.org/2000/svg", color: "#000", style: "background: #fff; font-family: sans-serif" })) {
    svg.setAttribute(name, String(value));
  }
  return new XMLSerializer().serializeToString(svg);
}

/** @param {string} address of a picture @returns {Promise<string>} the same in pixels */
async function painted(address) {
  const image = new Image();
  image.src = address;
  await image.decode();
  const canvas = Object.assign(document.createElement("canvas"), { width: 2 * SIZE.width, height: 2 * SIZE.height });
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas.toDataURL("image/png");
}
