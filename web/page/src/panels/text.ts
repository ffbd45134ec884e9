//! The text of the language: a box that carries it out, what it said, and the journal.

import { h, replace } from "../dom.ts";
import type { Answer, Entry, Said } from "../engine/protocol.ts";
import type { Page } from "../page.ts";
import { Colours } from "./colours.ts";
import { Offers } from "./offers.ts";

/** The journal shows so many of its last lines. */
const MOST_LINES = 1000;
/** A statement that takes longer than this may be stopped, ms. */
const LONG = 400;

export class TextPanel {
  readonly box: HTMLTextAreaElement;
  private readonly answer = h("pre", { id: "answer", role: "status", tabindex: "0" });
  private readonly journal = h("ol", { id: "journal", role: "log", "aria-label": "Journal" });
  private readonly runs = h(
    "button",
    { class: "main", type: "button", id: "run", onclick: () => this.press() },
    "Run",
  );
  private readonly offers: Offers;
  /** What was typed, the last at the end; and how far back the arrows have gone. */
  private readonly typed: string[] = [];
  private back = 0;
  /** What the journal holds, for a link to it. */
  readonly entries: Entry[] = [];

  constructor(
    private readonly page: Page,
    place: HTMLElement,
    buttons: readonly HTMLElement[],
  ) {
    this.box = h("textarea", {
      id: "text",
      "aria-label": "Statements",
      placeholder: "length A B = 3",
      spellcheck: "false",
      autocomplete: "off",
      autocapitalize: "off",
      onkeydown: (event) => this.key(event as KeyboardEvent),
    });
    const colours = new Colours(this.box);
    this.offers = new Offers(page, this.box, colours);
    const writing = h("div", { class: "writing" }, colours.element, this.box);
    const left = h(
      "div",
      {},
      h("h2", {}, "Text", h("span", { class: "gap" }), ...buttons, this.runs),
      writing,
      this.answer,
    );
    const right = h("div", {}, h("h2", {}, "Journal"), this.journal);
    replace(place, left, right);
    page.client.wrote.listen((entries) => this.write(entries));
    page.client.said.listen((said) => this.say(said));
    page.client.greeted.listen(() => {
      this.entries.length = 0;
      this.journal.replaceChildren();
      this.say([]);
    });
    page.answered.listen((said) => this.say(said));
    page.written.listen((text) => this.insert(text));
  }

  focus(): void {
    this.box.focus();
  }

  /** Puts a text into the box. */
  hold(text: string): void {
    this.box.value = text;
    this.offers.changed();
  }

  /** Carries out what the box holds; what went well leaves it, unless it is to stay. */
  async run(stays = false): Promise<Answer | undefined> {
    this.offers.close();
    const text = this.box.value;
    if (text.trim() === "") return undefined;
    const answer = await this.waited(this.page.client.exec(text));
    this.say(answer.said ?? []);
    this.typed.push(text);
    this.back = 0;
    const wrong = answer.said?.find(({ kind, from }) => kind === "error" && from !== undefined);
    if (answer.ok && !stays) this.hold("");
    if (wrong?.from !== undefined) {
      this.box.focus();
      this.box.setSelectionRange(wrong.from, wrong.to ?? wrong.from);
    }
    this.box.setAttribute("aria-invalid", String(!answer.ok));
    return answer;
  }

  /** Waits for an answer; one that takes long can be stopped. */
  private async waited(asked: Promise<Answer>): Promise<Answer> {
    this.box.setAttribute("aria-busy", "true");
    const timer = setTimeout(() => {
      this.runs.textContent = "Stop";
    }, LONG);
    const answer = await asked;
    clearTimeout(timer);
    this.runs.textContent = "Run";
    this.box.removeAttribute("aria-busy");
    return answer;
  }

  private press(): void {
    if (this.box.getAttribute("aria-busy") !== "true") void this.run();
    else this.page.client.stop();
  }

  private say(said: readonly Said[]): void {
    const line = ({ kind, text }: Said): HTMLElement =>
      h("span", { class: kind === "error" ? "wrong" : kind === "line" ? "" : "said" }, `${text}\n`);
    replace(this.answer, ...said.map(line));
  }

  private write(entries: readonly Entry[]): void {
    // Who connects again is told what is there already.
    const first = entries[0]?.number;
    if (first !== undefined) {
      const known = this.entries.findIndex(({ number }) => number >= first);
      if (known >= 0) {
        this.entries.length = known;
        while (this.journal.children.length > known) this.journal.lastElementChild?.remove();
      }
    }
    const isAtEnd =
      this.journal.scrollHeight - this.journal.scrollTop - this.journal.clientHeight < 40;
    for (const entry of entries) {
      this.entries.push(entry);
      this.journal.append(this.line(entry));
    }
    while (this.journal.children.length > MOST_LINES) {
      this.journal.firstElementChild?.remove();
      this.entries.shift();
    }
    if (isAtEnd) this.journal.scrollTop = this.journal.scrollHeight;
  }

  private line({ text, by }: Entry): HTMLElement {
    const from = by === "page" ? "" : `${by}: `;
    const again = (): void => {
      this.hold(text);
      this.focus();
    };
    return h(
      "li",
      {},
      h(
        "button",
        { type: "button", title: "Into the box", onclick: again },
        h("span", { class: "origin" }, from),
        text,
      ),
    );
  }

  private insert(text: string): void {
    const { selectionStart, selectionEnd, value } = this.box;
    const before = value.slice(0, selectionStart);
    const gap = before === "" || /\s$/.test(before) ? "" : " ";
    this.box.focus();
    this.box.setRangeText(`${gap}${text}`, selectionStart, selectionEnd, "end");
    this.offers.changed();
  }

  private key(event: KeyboardEvent): void {
    if (this.offers.key(event)) return;
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
      event.preventDefault();
      void this.run();
    } else if (event.key === "Enter" && !event.shiftKey && this.isOneLine()) {
      event.preventDefault();
      void this.enter();
    } else if (event.key === "ArrowUp" && this.isOneLine()) {
      event.preventDefault();
      this.recall(1);
    } else if (event.key === "ArrowDown" && this.isOneLine()) {
      event.preventDefault();
      this.recall(-1);
    } else if (event.key === "Escape") {
      this.box.blur();
    }
  }

  /** Carries out a lone line that is complete; one that is not goes on in the next. */
  private async enter(): Promise<void> {
    const { value } = this.box;
    const goesOn = await this.offers.goesOn();
    if (this.box.value !== value) return;
    if (goesOn) this.insertBreak();
    else void this.run();
  }

  private insertBreak(): void {
    const { selectionStart, selectionEnd } = this.box;
    this.box.setRangeText("\n", selectionStart, selectionEnd, "end");
    this.box.dispatchEvent(new Event("input"));
  }

  private isOneLine(): boolean {
    return !this.box.value.includes("\n");
  }

  private recall(by: number): void {
    const back = Math.min(Math.max(this.back + by, 0), this.typed.length);
    if (back === this.back) return;
    this.back = back;
    this.hold(back === 0 ? "" : (this.typed.at(-back) ?? ""));
  }
}
