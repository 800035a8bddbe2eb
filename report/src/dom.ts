// Elements of the page in one call each.

type Child = Node | string | null | undefined;

/** An element with attributes; those with a function are listeners. */
export function h<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Record<string, string | boolean | ((event: Event) => void)> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(key, value);
    else if (typeof value === "string") element.setAttribute(key, value);
    else if (value) element.setAttribute(key, "");
  }
  for (const child of children) if (child !== null && child !== undefined) element.append(child);
  return element;
}

/** A part of the page with a heading, reached from the list of parts. */
export function section(id: string, title: string, ...children: Child[]): HTMLElement {
  return h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), ...children);
}

/** A table; cells of numbers stand to the right. */
export function table(caption: string, head: string[], rows: Child[][], numeric: number[] = []): HTMLElement {
  const cell = (kind: "td" | "th", content: Child, k: number) =>
    h(kind, numeric.includes(k) ? { class: "number" } : {}, content);
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      {},
      h("caption", { class: "hidden" }, caption),
      h("thead", {}, h("tr", {}, ...head.map((t, k) => cell("th", t, k)))),
      h("tbody", {}, ...rows.map((row) => h("tr", {}, ...row.map((c, k) => cell("td", c, k))))),
    ),
  );
}

/** A choice with a label. */
export function chooser(
  label: string,
  options: { value: string; text: string }[],
  chosen: string,
  change: (value: string) => void,
): { element: HTMLElement; select: HTMLSelectElement } {
  const select = h(
    "select",
    { change: () => change(select.value) },
    ...options.map((o) => h("option", { value: o.value }, o.text)),
  );
  select.value = chosen;
  return { element: h("label", { class: "field" }, h("span", {}, label), select), select };
}

/** The value of a colour of the style sheet. */
export function cssColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
