//! Boxes over the page: the keys, the gallery.

import { h, icon, put } from "../dom.ts";
import type { Example } from "../engine/protocol.ts";
import type { Tool } from "../hand/tool.ts";

function dialog(title: string): HTMLDialogElement {
  const element = h("dialog", { "aria-label": title });
  const close = h(
    "button",
    { class: "bare", type: "button", "aria-label": "Close", onclick: () => element.close() },
    icon("M5 5l10 10M15 5L5 15"),
  );
  put(element, h("h2", {}, title, close));
  element.addEventListener("click", (event) => {
    if (event.target === element) element.close();
  });
  document.body.append(element);
  return element;
}

const KEYS: readonly (readonly [string, string])[] = [
  ["Space", "play, pause"],
  ["S, R", "one frame; back to time 0"],
  ["U, Y", "undo, redo (or Ctrl+Z, Ctrl+Shift+Z)"],
  ["0, +, -", "show all, larger, smaller"],
  ["/", "to the text; Escape leaves it"],
  [". ,", "on the drawing: the next point, the one before"],
  ["arrows", "move the chosen point (finely with Shift), or else the view"],
  ["F, T, Enter", "freeze or thaw the chosen point, trace it, what else can be done"],
  ["Delete", "delete the chosen point and what uses it"],
  ["Escape", "give up what is under way"],
];

const HAND: readonly (readonly [string, string])[] = [
  ["drag a point", "a loose one is pulled, a frozen one goes where the mouse is"],
  ["click a point", "what can be done with it"],
  ["double click", "freezes, thaws"],
  ["drag beside points", "moves the view; so do two fingers"],
  ["wheel, two fingers", "larger, smaller"],
];

export function keysDialog(tools: readonly Tool[]): HTMLDialogElement {
  const element = dialog("Mouse and keys");
  const row = ([keys, what]: readonly [string, string]): HTMLElement =>
    h("tr", {}, h("td", {}, h("kbd", {}, keys)), h("td", {}, what));
  const hands = tools.map(({ key, help }) => [key.toUpperCase(), help] as const);
  put(
    element,
    h("table", { class: "keys" }, h("tbody", {}, ...[...HAND, ...hands, ...KEYS].map(row))),
  );
  return element;
}

/** Examples with their pictures; `choose` gets the script. */
export function galleryDialog(
  examples: readonly Example[],
  pictures: Readonly<Record<string, string>>,
  choose: (example: Example) => void,
): HTMLDialogElement {
  const element = dialog("Examples");
  const card = (example: Example): HTMLElement => {
    const picture = pictures[example.name];
    const image = picture === undefined ? null : h("img", { src: addressOf(picture), alt: "" });
    return h(
      "button",
      {
        type: "button",
        title: example.about,
        onclick: () => {
          element.close();
          choose(example);
        },
      },
      image,
      h("span", {}, example.name),
    );
  };
  put(element, h("div", { class: "gallery" }, ...examples.map(card)));
  return element;
}

function addressOf(svg: string): string {
  return URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
}
