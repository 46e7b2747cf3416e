// The page's elements, by their ids.

/** @param {string} id */
export function element(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no element ${id}`);
  return found;
}

/** @param {string} id */
export const input = (id) => /** @type {HTMLInputElement} */ (element(id));

/** Put rows into a table, the first cell of each as its head. @param {Element} table @param {string[][]} rows */
export function fill(table, rows) {
  table.querySelector("tbody")?.replaceChildren(...rows.map(([head, ...cells]) => {
    const row = document.createElement("tr");
    const th = Object.assign(document.createElement("th"), { textContent: head, scope: "row" });
    row.append(th, ...cells.map((text) => Object.assign(document.createElement("td"), { textContent: text })));
    return row;
  }));
}

/** Paragraphs or items of text. @param {string} id @param {string} tag @param {string[]} texts */
export const tell = (id, tag, texts) =>
  element(id).replaceChildren(...texts.map((text) => Object.assign(document.createElement(tag), { textContent: text })));
