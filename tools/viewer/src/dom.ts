// Elements of the page. Text comes in as text alone, never as markup.

type Child = Node | string;

/** An element with attributes and content; strings become text. */
export function element<K extends keyof HTMLElementTagNameMap>(
    name: K, attributes: Record<string, string> = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

export function svg(name: string, attributes: Record<string, string | number>,
                    ...children: Child[]): SVGElement {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  made.append(...children);
  return made;
}

export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

/** A part of the side column. */
export function card(title: string, ...children: Child[]): HTMLElement {
  return element("section", { class: "card" }, element("h2", {}, title), ...children);
}

/** A table whose first column names the rows. */
export function table(head: string[], rows: Child[][]): HTMLTableElement {
  const made = element("table");
  if (head.length > 0) {
    made.append(element("thead", {}, element("tr", {},
      ...head.map((text) => element("th", { scope: "col" }, text)))));
  }
  made.append(element("tbody", {}, ...rows.map(([name, ...cells]) => element("tr", {},
    element("th", { scope: "row" }, name), ...cells.map((cell) => element("td", {}, cell))))));
  return made;
}

/** A number in so many significant digits, without an exponent where that is short. */
export function inDigits(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return value.toLocaleString("en");
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e9)) return value.toExponential(digits - 1);
  return String(Number(value.toPrecision(digits)));
}
