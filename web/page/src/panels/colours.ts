//! Colours and a hint behind the letters of a text box: the box's own letters are transparent.

import { h, replace } from "../dom.ts";
import type { Piece } from "../engine/protocol.ts";

export class Colours {
  readonly element = h("pre", { class: "colours", "aria-hidden": "true" });
  private shown = "";
  private pieces: readonly Piece[] = [];

  constructor(private readonly box: HTMLTextAreaElement) {
    box.addEventListener("input", () => this.follow());
    box.addEventListener("scroll", () => this.scroll());
  }

  /** Shows what the box holds; what has not changed keeps its colours until others are known. */
  follow(): void {
    const text = this.box.value;
    let same = 0;
    while (same < text.length && text[same] === this.shown[same]) same += 1;
    this.show(
      text,
      this.pieces.filter(({ to }) => to < same),
      "",
    );
  }

  /** Shows a text in these colours, if it is still what the box holds. */
  paint(text: string, pieces: readonly Piece[], hint: string): void {
    if (text === this.box.value) this.show(text, pieces, hint);
  }

  private show(text: string, pieces: readonly Piece[], hint: string): void {
    this.shown = text;
    this.pieces = pieces;
    const parts: Node[] = [];
    let done = 0;
    for (const { from, to, class: kind, unknown } of pieces) {
      if (from < done) continue;
      parts.push(document.createTextNode(text.slice(done, from)));
      const name = `is-${kind}${unknown === true ? " is-unknown" : ""}`;
      parts.push(h("span", { class: name }, text.slice(from, to)));
      done = to;
    }
    parts.push(document.createTextNode(text.slice(done)));
    if (hint !== "") parts.push(h("span", { class: "is-hint" }, hint));
    // A last line that is empty has a height too.
    parts.push(document.createTextNode("\n"));
    replace(this.element, ...parts);
    this.scroll();
  }

  private scroll(): void {
    this.element.scrollTop = this.box.scrollTop;
    this.element.scrollLeft = this.box.scrollLeft;
  }
}
