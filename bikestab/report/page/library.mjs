// plotly, which the page holds compressed: unpacked and run when the first answer is on the screen.

import { element } from "./elements.mjs";
import { bytes } from "./volumes.mjs";

/** @returns {any} plotly, once ``unpacked`` is done */
export const plotly = () => /** @type {any} */ (globalThis).Plotly;

/** Run the library. Its text is compiled aside, so that sliders answer meanwhile. */
export async function unpacked() {
  const packed = new Blob([bytes(element("library").textContent ?? "")]).stream();
  const text = await new Response(packed.pipeThrough(new DecompressionStream("deflate"))).text();
  const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  const script = document.createElement("script");
  await new Promise((resolve, reject) => {
    Object.assign(script, { src: address, onload: resolve, onerror: reject });
    document.head.append(script);
  });
  URL.revokeObjectURL(address);
}
