//! Completion: what may stand where the cursor is.

import { h, replace } from "../dom.ts";
import type { Completion } from "../engine/protocol.ts";
import type { Page } from "../page.ts";
import type { Colours } from "./colours.ts";

/** More candidates than this are not read. */
const MOST = 40;

/** A question has to fit into a message on a socket: of a longer text it is the last lines. */
const CONTEXT = 600;

export class Offers {
  private readonly list = h("ul", { class: "offers", role: "listbox", id: "offers", hidden: true });
  private completion: Completion | undefined;
  /** Where the text that was asked begins. */
  private base = 0;
  private chosen = -1;
  private nAsked = 0;

  constructor(
    private readonly page: Page,
    private readonly box: HTMLTextAreaElement,
    private readonly colours: Colours,
  ) {
    document.body.append(this.list);
    box.setAttribute("aria-controls", "offers");
    box.setAttribute("aria-autocomplete", "list");
    box.addEventListener("input", () => void this.ask(false));
    box.addEventListener("blur", () => this.close());
  }

  close(): void {
    this.list.hidden = true;
    this.completion = undefined;
    this.chosen = -1;
    this.box.removeAttribute("aria-activedescendant");
  }

  /** Whether a key was for the list. */
  key(event: KeyboardEvent): boolean {
    if (event.key === " " && event.ctrlKey) {
      void this.ask(true);
    } else if (this.list.hidden) {
      return false;
    } else if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      this.choose(this.chosen + (event.key === "ArrowDown" ? 1 : -1));
    } else if (event.key === "Tab" && !event.shiftKey) {
      this.accept(Math.max(this.chosen, 0));
    } else if (event.key === "Enter" && this.chosen >= 0) {
      this.accept(this.chosen);
    } else if (event.key === "Escape") {
      this.close();
    } else {
      return false;
    }
    event.preventDefault();
    event.stopPropagation();
    return true;
  }

  /** Whether the statement in the box goes on in the next line. */
  async goesOn(): Promise<boolean> {
    const { value } = this.box;
    const text = this.page.client.canRestart ? value : value.slice(-CONTEXT);
    const { incomplete } = await this.page.client.complete(text, text.length);
    return incomplete === true;
  }

  /** The box was given another text: its colours are asked for. */
  changed(): void {
    this.colours.follow();
    this.close();
    void this.ask(false, true);
  }

  /** Asks what may stand here; unasked for, only within a word. */
  private async ask(isWanted: boolean, isSilent = false): Promise<void> {
    this.nAsked += 1;
    const number = this.nAsked;
    const at = this.box.selectionStart;
    const { value } = this.box;
    const isWhole = this.page.client.canRestart || value.length <= CONTEXT;
    const lineStart = value.lastIndexOf("\n", at - 1) + 1;
    const base = isWhole ? 0 : Math.max(at - CONTEXT, lineStart);
    const text = isWhole ? value : value.slice(base, at);
    const completion = await this.page.client.complete(text, at - base);
    // Somebody who types is ahead of the answer.
    if (number !== this.nAsked || completion.candidates === undefined) return;
    this.base = base;
    if (isWhole)
      this.colours.paint(
        value,
        completion.pieces,
        at === value.length ? (completion.hint ?? "") : "",
      );
    const word = text.slice(completion.start, at - base);
    const others = completion.candidates.filter((candidate) => candidate.text.trim() !== word);
    if (isSilent || others.length === 0 || (!isWanted && word === "")) this.close();
    else this.show({ ...completion, candidates: others.slice(0, MOST) });
  }

  private show(completion: Completion): void {
    this.completion = completion;
    this.chosen = -1;
    const item = ({ shown }: { shown: string }, k: number): HTMLElement =>
      h(
        "li",
        {
          role: "option",
          id: `offer-${k}`,
          onpointerdown: (event) => {
            event.preventDefault();
            this.accept(k);
          },
        },
        shown,
      );
    replace(this.list, ...completion.candidates.map(item));
    this.list.hidden = false;
    const { left, top } = this.box.getBoundingClientRect();
    this.list.style.left = `${Math.round(left)}px`;
    this.list.style.top = `${Math.round(Math.max(top - this.list.offsetHeight - 4, 4))}px`;
  }

  private choose(idx: number): void {
    const n = this.list.children.length;
    this.chosen = (idx + n) % n;
    for (const [k, item] of [...this.list.children].entries()) {
      item.setAttribute("aria-selected", String(k === this.chosen));
      if (k === this.chosen) item.scrollIntoView({ block: "nearest" });
    }
    this.box.setAttribute("aria-activedescendant", `offer-${this.chosen}`);
  }

  private accept(idx: number): void {
    const candidate = this.completion?.candidates[idx];
    if (this.completion === undefined || candidate === undefined) return;
    const from = this.base + this.completion.start;
    this.box.setRangeText(candidate.text, from, this.box.selectionStart, "end");
    this.close();
    this.box.dispatchEvent(new Event("input"));
  }
}
