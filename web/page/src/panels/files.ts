//! What can be taken home: script, pictures, numbers.

import { h, put, replace } from "../dom.ts";
import type { FileAnswer } from "../engine/protocol.ts";
import type { Page } from "../page.ts";

/** Files that are texts: no others are given to pages. */
const TEXT = /\.(svg|csv|link|dxf|json)$/;
/** Of files that statements wrote so many are offered. */
const MOST_WRITTEN = 12;

/** Hands a text to the browser as a file. */
export function download(name: string, mime: string, text: string): void {
  const address = URL.createObjectURL(new Blob([text], { type: mime }));
  const link = h("a", { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Takes a file home, or says why there is none. */
function take(page: Page, answer: FileAnswer): void {
  if (answer.ok && answer.text !== undefined) {
    download(answer.name ?? "linkwork.txt", answer.mime ?? "text/plain", answer.text);
    page.hint(`${answer.name ?? "The file"} is downloaded.`);
  } else {
    page.report("", { ok: false, said: answer.said ?? [] });
  }
}

export function filesPanel(page: Page): HTMLElement {
  const frames = h("input", {
    id: "frames",
    type: "number",
    min: "1",
    max: "100000",
    value: "240",
  });
  const button = (kind: string, label: string, title: string): HTMLElement =>
    h(
      "button",
      {
        type: "button",
        title,
        "data-file": kind,
        onclick: () => {
          const more = { frames: Math.max(1, Math.round(Number(frames.value) || 240)) };
          page.client.file(kind, more).then((answer) => take(page, answer));
        },
      },
      label,
    );
  const panel = h("section", { class: "panel", "data-tab": "files" }, h("h2", {}, "Files"));
  put(
    panel,
    h(
      "div",
      { class: "buttons" },
      button("script", "Script", "A script that brings all of this back to the last bit"),
      button("svg", "SVG", "The picture as it is now"),
      button("animation", "Animation", "An SVG that moves: the frames that would come next"),
      button("csv", "CSV", "Paths of the traced points over the frames that would come next"),
    ),
    h(
      "div",
      { class: "row setting" },
      h("label", { for: "frames", class: "quiet" }, "frames of animation and CSV"),
      frames,
    ),
  );
  const written = h("p", { class: "quiet" });
  put(panel, written, writtenFiles(page));
  page.client.greeted.listen(({ engine }) => {
    written.textContent =
      engine === "socket"
        ? "What a statement writes is in the output folder of the session, and here."
        : "What a statement writes is here.";
  });
  return panel;
}

/** Files that statements wrote, the last of them. */
function writtenFiles(page: Page): HTMLElement {
  const element = h("div", { class: "buttons" });
  let names: string[] = [];
  const show = (): void => replace(element, ...names.map((name) => button(name)));
  const button = (name: string): HTMLElement => {
    const ask = (): Promise<void> =>
      page.client.file("written", { name }).then((answer) => take(page, answer));
    const label = name.slice(name.lastIndexOf("/") + 1);
    return h("button", { type: "button", title: name, "data-file": label, onclick: ask }, label);
  };
  page.client.filed.listen((wrote) => {
    const texts = wrote.filter((name) => TEXT.test(name));
    names = [...new Set([...names, ...texts].reverse())].slice(0, MOST_WRITTEN).reverse();
    show();
  });
  page.client.greeted.listen(() => {
    names = [];
    show();
  });
  return element;
}
