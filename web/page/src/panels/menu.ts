//! What can be done with a point: shown beside it.

import { h, icon, put, replace } from "../dom.ts";
import type { ConstraintState, PointState } from "../engine/protocol.ts";
import { turnSupport } from "../hand/select.ts";
import type { Page } from "../page.ts";
import { constraintsAt, placeOf, pointOf } from "../scene.ts";

export class Menu {
  private readonly element = h("div", {
    class: "menu",
    role: "dialog",
    tabindex: "-1",
    hidden: true,
  });
  /** What the point is called: typed over, it is called otherwise. */
  private readonly name = h("input", {
    class: "mono",
    "aria-label": "Name",
    title: "Type another name for it",
    spellcheck: "false",
    autocapitalize: "off",
    autocomplete: "off",
    onchange: () => void this.rename(),
  });
  private readonly support = h("span", { class: "quiet" });
  /** What is under the name; made anew when something has changed. */
  private readonly offers = h("div");
  private handle: number | undefined;

  constructor(private readonly page: Page) {
    put(this.element, this.head(), this.offers);
    document.body.append(this.element);
    this.name.addEventListener("keydown", (event) => this.key(event));
    page.client.stated.listen(() => this.refresh());
    document.addEventListener("pointerdown", (event) => {
      const target = event.target as Node;
      if (!this.element.contains(target)) this.close();
    });
  }

  open(handle: number): void {
    const { stage, client } = this.page;
    const place = placeOf(client, handle);
    if (place === undefined) return;
    this.handle = handle;
    this.element.hidden = false;
    this.resetName();
    this.refresh();
    const { left, top } = stage.canvas.getBoundingClientRect();
    const at = stage.camera.toCanvas(place);
    const [width, height] = [this.element.offsetWidth, this.element.offsetHeight];
    const x = Math.min(left + at.x + 16, window.innerWidth - width - 8);
    const y = Math.min(top + at.y + 16, window.innerHeight - height - 8);
    this.element.style.left = `${Math.max(x, 8)}px`;
    this.element.style.top = `${Math.max(y, 8)}px`;
    stage.overlay = { chosen: handle };
    stage.refresh();
    this.element.focus({ preventScroll: true });
  }

  close(): void {
    if (this.handle === undefined) return;
    const hadFocus = this.element.contains(document.activeElement);
    // What was typed counts, as it does when Enter is pressed.
    this.name.blur();
    this.handle = undefined;
    this.element.hidden = true;
    this.page.stage.overlay = {};
    this.page.stage.refresh();
    if (hadFocus) this.page.stage.canvas.focus({ preventScroll: true });
  }

  private refresh(): void {
    if (this.handle === undefined) return;
    const { state } = this.page.client;
    const point = pointOf(this.page.client, this.handle);
    if (point === undefined) {
      this.close();
      return;
    }
    this.element.setAttribute("aria-label", `Point ${point.name}`);
    // Not under the hand that types.
    if (document.activeElement !== this.name) this.resetName();
    this.support.textContent = point.frozen ? "frozen" : "";
    const here = constraintsAt(state, point.handle);
    const isTraced = state?.traced.includes(point.handle) === true;
    replace(this.offers, this.actions(point, isTraced));
    if (here.length > 0) put(this.offers, h("h3", {}, "Constraints here"));
    for (const constraint of here) put(this.offers, this.held(constraint));
  }

  private nameOf(handle: number | undefined): string {
    return handle === undefined ? "" : (pointOf(this.page.client, handle)?.name ?? "");
  }

  private resetName(): void {
    this.name.value = this.nameOf(this.handle);
    this.name.removeAttribute("aria-invalid");
  }

  /** Gives the point the name that was typed; a wrong one stays, to be mended. */
  private async rename(): Promise<void> {
    const [from, to] = [this.nameOf(this.handle), this.name.value.trim()];
    if (from === "" || from === to) {
      this.resetName();
      return;
    }
    const answer = await this.page.do(`rename ${from} to ${to}`);
    this.name.setAttribute("aria-invalid", String(!answer.ok));
  }

  private key(event: KeyboardEvent): void {
    if (event.key !== "Escape") return;
    // First what was typed is given up, then the card is closed.
    if (this.name.value === this.nameOf(this.handle)) this.close();
    else this.resetName();
    event.preventDefault();
    event.stopPropagation();
  }

  private head(): HTMLElement {
    const close = h(
      "button",
      { class: "bare", type: "button", "aria-label": "Close", onclick: () => this.close() },
      icon("M5 5l10 10M15 5L5 15"),
    );
    return h("h2", {}, this.name, this.support, close);
  }

  private actions(point: PointState, isTraced: boolean): HTMLElement {
    const { page } = this;
    const button = (label: string, act: () => void): HTMLElement =>
      h("button", { type: "button", onclick: act }, label);
    return h(
      "div",
      { class: "buttons" },
      button(point.frozen ? "Thaw" : "Freeze", () => turnSupport(page, point.handle)),
      button(isTraced ? "End path" : "Trace", () => {
        void page.do(`${isTraced ? "untrace" : "trace"} ${point.name}`);
      }),
      button("Name into text", () => {
        this.close();
        page.written.tell(point.name);
      }),
      button("Delete", () => {
        const uses = constraintsAt(page.client.state, point.handle).length > 0 ? " cascade" : "";
        this.close();
        void page.do(`delete ${point.name}${uses}`);
      }),
    );
  }

  private held(constraint: ConstraintState): HTMLElement {
    const { page } = this;
    const { name, text, on } = constraint;
    const isOn = h("input", {
      type: "checkbox",
      "aria-label": `${name} is on`,
      checked: on,
      onchange: () => void page.do(`${isOn.checked ? "on" : "off"} ${name}`),
    });
    const remove = h(
      "button",
      {
        class: "bare",
        type: "button",
        title: `Delete ${name}`,
        "aria-label": `Delete ${name}`,
        onclick: () => void page.do(`delete ${name}`),
      },
      icon("M5 5l10 10M15 5L5 15"),
    );
    const words = h("code", { title: `${name}: ${text}` }, text);
    return h("div", { class: "held" }, isOn, words, remove);
  }
}
