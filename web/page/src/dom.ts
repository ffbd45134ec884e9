//! Elements in one expression.

type Attribute = string | number | boolean | undefined;
type Listener = (event: Event) => void;
export type Child = Node | string | null | undefined | false;

/** Attributes of an element; what begins with `on` is a listener. */
export type Attributes = Record<string, Attribute | Listener>;

function set(element: Element, name: string, value: Attribute | Listener): void {
  if (typeof value === "function") {
    element.addEventListener(name.slice(2), value);
  } else if (value === true) {
    element.setAttribute(name, "");
  } else if (value !== false && value !== undefined) {
    element.setAttribute(name, String(value));
  }
}

/** An element with its attributes and what is in it. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) set(element, name, value);
  put(element, ...children);
  return element;
}

/** Adds to what is in an element. */
export function put(element: Element, ...children: Child[]): void {
  for (const child of children) {
    if (child !== null && child !== undefined && child !== false) element.append(child);
  }
}

/** Puts this in the place of what is in an element. */
export function replace(element: Element, ...children: Child[]): void {
  element.replaceChildren();
  put(element, ...children);
}

const SVG = "http://www.w3.org/2000/svg";

/** A picture of 20 by 20 in lines of the text's colour. */
export function icon(paths: string, filled = ""): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  set(svg, "viewBox", "0 0 20 20");
  set(svg, "aria-hidden", "true");
  set(svg, "class", "icon");
  const add = (d: string, kind: string): void => {
    if (d === "") return;
    const path = document.createElementNS(SVG, "path");
    set(path, "d", d);
    set(path, "class", kind);
    svg.append(path);
  };
  add(paths, "line");
  add(filled, "area");
  return svg;
}

/** The element that the page's own text has under this id. */
export function byId(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (element === null) throw new Error(`the page has no #${id}`);
  return element;
}
