/** Elements without a framework: `h("div.card", { title: "x" }, child, "text")`. */

type Child = Node | string | null | undefined | false;
type Props = Record<string, unknown>;

export function h<E extends HTMLElement = HTMLElement>(spec: string, ...rest: (Props | Child | Child[])[]): E {
  const [tag, ...classes] = spec.split(".");
  const element = document.createElement(tag || "div") as E;
  if (classes.length) element.className = classes.join(" ");
  for (const item of rest) {
    if (item && typeof item === "object" && !(item instanceof Node) && !Array.isArray(item)) assign(element, item);
    else for (const child of Array.isArray(item) ? item : [item as Child]) if (child || child === "") element.append(child);
  }
  return element;
}

function assign(element: HTMLElement, props: Props): void {
  for (const [name, value] of Object.entries(props)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value as EventListener);
    else if (name === "style") for (const [key, item] of Object.entries(value as Props)) element.style.setProperty(key, String(item));
    else if (name in element && !name.startsWith("aria")) (element as unknown as Props)[name] = value;
    else element.setAttribute(name, value === true ? "" : String(value));
  }
}

export function svg<E extends SVGElement = SVGElement>(tag: string, attributes: Props, ...children: (Node | string)[]): E {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag) as E;
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

const ICONS: Record<string, string> = {
  play: "M7 4.5v15l12-7.5z",
  pause: "M7 5h4v14H7zM13.5 5h4v14h-4z",
  start: "M6 5h2.5v14H6zM19 5v14L9.5 12z",
  theme: "M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",
  hold: "M8 5h3v14H8zM13 5h3v14h-3z",
  land: "M12 3v11m-5-5 5 5 5-5M5 20h14",
  go: "M12 21s7-6.2 7-11.2A7 7 0 0 0 5 9.8C5 14.8 12 21 12 21zM12 12.4a2.6 2.6 0 1 0 0-5.2 2.6 2.6 0 0 0 0 5.2z",
};

/** A line icon of 24 units, in the text's colour. */
export function icon(name: string): SVGElement {
  const filled = ["play", "pause", "start", "hold"].includes(name);
  return svg("svg", { viewBox: "0 0 24 24", width: 18, height: 18, "aria-hidden": "true", class: "icon" },
    svg("path", filled ? { d: ICONS[name], fill: "currentColor" }
      : { d: ICONS[name], fill: "none", stroke: "currentColor", "stroke-width": 1.8, "stroke-linejoin": "round", "stroke-linecap": "round" }));
}

const colours = new Map<string, string>();

/** A colour of the present theme. */
export function colour(name: string): string {
  let value = colours.get(name);
  if (value === undefined) colours.set(name, (value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim()));
  return value;
}

/** "light" or "dark", from now on. */
export function setTheme(theme: string): void {
  document.documentElement.dataset.theme = theme;
  colours.clear();
}
