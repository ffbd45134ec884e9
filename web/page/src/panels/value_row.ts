//! A value with a slider: on its way it is tried, let go it is kept.

import { h } from "../dom.ts";
import type { Page } from "../page.ts";

/** A number as typed, with the unit that is glued to it. */
interface Quantity {
  readonly number: number;
  readonly unit: string;
}

/** What a typed text says, if it is a lone number. */
export function quantity(text: string): Quantity | undefined {
  const parts = /^\s*(-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(deg|rad|rev|rpm|s|ms)?\s*$/i.exec(
    text,
  );
  return parts === null ? undefined : { number: Number(parts[1]), unit: parts[2] ?? "" };
}

/** The ends of a slider: from 0 to twice what it is, or to both sides. */
function rangeAround(number: number, isSigned: boolean): readonly [number, number] {
  const reach = 2 * Math.abs(number) || 1;
  if (isSigned || number === 0) return [-reach, reach];
  return number > 0 ? [0, reach] : [-reach, 0];
}

export interface ValueRowOptions {
  /** What stands before the value. */
  readonly label: string;
  /** Whether the slider reaches to both sides of 0. */
  readonly isSigned: boolean;
  /** The statement that gives it this value. */
  readonly statement: (text: string) => string;
}

export class ValueRow {
  readonly input: HTMLInputElement;
  readonly slider: HTMLInputElement;
  private unit = "";
  private range: readonly [number, number] | undefined;
  private isSliding = false;
  private isBusy = false;
  private next: string | undefined;
  private isLast = false;

  constructor(
    private readonly page: Page,
    private readonly options: ValueRowOptions,
  ) {
    const { label } = options;
    this.input = h("input", {
      class: "mono",
      "aria-label": label,
      spellcheck: "false",
      autocomplete: "off",
      onchange: () => void this.type(),
    });
    this.slider = h("input", {
      type: "range",
      "aria-label": `${label}, slider`,
      oninput: () => this.slide(),
      onchange: () => this.letGo(),
    });
  }

  /** Shows a value, unless a hand is on it. */
  show(text: string, isLive = false, isUsed = true): void {
    this.slider.hidden = isLive;
    this.slider.disabled = !isUsed;
    this.slider.title = isUsed
      ? ""
      : "Nothing follows it: what was made with it took its value then.";
    if (this.isSliding) return;
    if (document.activeElement !== this.input) this.input.value = text;
    const said = quantity(text);
    this.slider.hidden = isLive || said === undefined;
    if (said === undefined) return;
    const [lo, hi] = this.range ?? [1, 0];
    const isInside = said.unit === this.unit && lo <= said.number && said.number <= hi;
    this.unit = said.unit;
    if (!isInside) this.range = rangeAround(said.number, this.options.isSigned);
    const [min, max] = this.range ?? [0, 1];
    this.slider.min = String(min);
    this.slider.max = String(max);
    this.slider.step = String((max - min) / 1000);
    this.slider.value = String(said.number);
    this.slider.setAttribute("aria-valuetext", text);
  }

  private async type(): Promise<void> {
    const statement = this.options.statement(this.input.value.trim());
    const answer = await this.page.do(statement);
    this.input.setAttribute("aria-invalid", String(!answer.ok));
  }

  private slide(): void {
    this.isSliding = true;
    this.isLast = false;
    const text = `${Number(Number(this.slider.value).toPrecision(4))}${this.unit}`;
    this.input.value = text;
    this.input.removeAttribute("aria-invalid");
    this.slider.setAttribute("aria-valuetext", text);
    this.attempt(text);
  }

  private letGo(): void {
    this.isLast = true;
    if (!this.isBusy) this.end();
  }

  /** Tries a value; of those that come meanwhile the last is tried next. */
  private attempt(text: string): void {
    if (this.isBusy) {
      this.next = text;
      return;
    }
    this.isBusy = true;
    this.page.client.attempt(this.options.statement(text)).then((answer) => {
      this.isBusy = false;
      this.input.setAttribute("aria-invalid", String(!answer.ok));
      const { next } = this;
      this.next = undefined;
      if (next !== undefined) this.attempt(next);
      else if (this.isLast) this.end();
    });
  }

  private end(): void {
    if (!this.isSliding) return;
    this.isSliding = false;
    this.page.client.keep();
    this.page.hint(this.options.statement(this.input.value));
  }
}
