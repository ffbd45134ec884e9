//! Keys: all that the mouse does can be done without one.

import type { Vec } from "../camera.ts";
import type { Page } from "../page.ts";
import { placeOf, places, pointOf } from "../scene.ts";
import type { Hand } from "./hand.ts";
import { rounded, turnSupport } from "./select.ts";
import type { Tool } from "./tool.ts";

/** How far an arrow moves a point, px; with Shift a tenth. */
const STEP = 10;
/** A gesture of keys ends when none came for so long, ms. */
const IDLE = 500;

/** What else keys reach. */
export interface Reach {
  readonly tools: readonly Tool[];
  readonly togglePlay: () => void;
  readonly step: () => void;
  readonly openMenu: (handle: number) => void;
  readonly closeAll: () => void;
  readonly help: () => void;
  readonly focusText: () => void;
  readonly speak: (text: string) => void;
}

const ARROWS: ReadonlyMap<string, Vec> = new Map([
  ["ArrowLeft", { x: -1, y: 0 }],
  ["ArrowRight", { x: 1, y: 0 }],
  ["ArrowUp", { x: 0, y: -1 }],
  ["ArrowDown", { x: 0, y: 1 }],
]);

export class Keys {
  private chosen: number | undefined;
  private held: { readonly point: number; to: Vec; timer: number } | undefined;
  private readonly anywhere: ReadonlyMap<string, () => void>;
  private readonly onCanvas: ReadonlyMap<string, () => void>;

  constructor(
    private readonly page: Page,
    private readonly hand: Hand,
    private readonly reach: Reach,
  ) {
    const { stage } = page;
    const zoom = (factor: number): void =>
      stage.look(
        stage.camera.zoomed(factor, { x: stage.camera.width / 2, y: stage.camera.height / 2 }),
      );
    const tools = reach.tools.map((tool) => [tool.key, () => hand.take(tool)] as const);
    this.anywhere = new Map([
      ...tools,
      [" ", reach.togglePlay],
      ["s", reach.step],
      ["r", () => void page.do("reset")],
      ["u", () => void page.do("undo")],
      ["y", () => void page.do("redo")],
      ["0", () => stage.fit()],
      ["+", () => zoom(1.25)],
      ["=", () => zoom(1.25)],
      ["-", () => zoom(0.8)],
      ["?", reach.help],
      ["/", reach.focusText],
      ["Escape", () => this.escape()],
    ]);
    this.onCanvas = new Map([
      [".", () => this.choose(1)],
      [",", () => this.choose(-1)],
      ["Enter", () => this.withChosen((handle) => reach.openMenu(handle))],
      ["f", () => this.withChosen((handle) => turnSupport(page, handle))],
      ["t", () => this.withChosen((handle) => this.trace(handle))],
      ["Delete", () => this.withChosen((handle) => this.remove(handle))],
    ]);
    document.addEventListener("keydown", (event) => this.down(event));
  }

  private down(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey) {
      this.withCtrl(event, target);
      return;
    }
    if (event.altKey || isTyping(target, event.key)) return;
    // With or without Shift or a lock of capitals.
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const isOnCanvas = target === this.page.stage.canvas;
    const arrow = isOnCanvas ? ARROWS.get(key) : undefined;
    const act =
      (arrow && (() => this.nudge(arrow, event.shiftKey))) ??
      (isOnCanvas ? this.onCanvas.get(key) : undefined) ??
      this.anywhere.get(key);
    if (act === undefined) return;
    event.preventDefault();
    act();
  }

  private withCtrl(event: KeyboardEvent, target: HTMLElement): void {
    const key = event.key.toLowerCase();
    if (target.matches("textarea, input") || (key !== "z" && key !== "y")) return;
    event.preventDefault();
    void this.page.do(key === "y" || event.shiftKey ? "redo" : "undo");
  }

  private escape(): void {
    this.reach.closeAll();
    if (this.held !== undefined) {
      clearTimeout(this.held.timer);
      this.held = undefined;
      this.page.client.cancel();
    }
    this.hand.cancel();
    this.chosen = undefined;
  }

  /** The next or the last point. */
  private choose(by: number): void {
    const all = [...places(this.page.client)];
    if (all.length === 0) {
      this.reach.speak("There are no points.");
      return;
    }
    const now = all.findIndex(([point]) => point.handle === this.chosen);
    const next = now < 0 && by < 0 ? all.length - 1 : (now + by + all.length) % all.length;
    const found = all[next];
    if (found === undefined) return;
    const [point, { x, y }] = found;
    this.chosen = point.handle;
    this.page.stage.overlay = { chosen: point.handle };
    this.page.stage.refresh();
    const where = `at ${Number(x.toPrecision(4))}, ${Number(y.toPrecision(4))}`;
    this.reach.speak(`${point.name}, ${point.frozen ? "frozen" : "loose"}, ${where}`);
  }

  private withChosen(act: (handle: number) => void): void {
    if (this.chosen !== undefined && pointOf(this.page.client, this.chosen)) act(this.chosen);
    else this.reach.speak("No point is chosen: . and , go from one to the next.");
  }

  /** Arrows move the point that is chosen, or else what is shown. */
  private nudge(arrow: Vec, isFine: boolean): void {
    const { stage, client } = this.page;
    const by = STEP * (isFine ? 0.1 : 1);
    const { chosen } = this;
    const place = chosen === undefined ? undefined : placeOf(client, chosen);
    if (chosen === undefined || place === undefined) {
      stage.look(stage.camera.panned({ x: -4 * by * arrow.x, y: -4 * by * arrow.y }));
      return;
    }
    if (this.held === undefined) void client.grab(chosen);
    else clearTimeout(this.held.timer);
    const from = this.held?.to ?? place;
    const { scale } = stage.camera;
    const to = { x: from.x + (by * arrow.x) / scale, y: from.y - (by * arrow.y) / scale };
    const asked = rounded(to, scale);
    client.move(asked.x, asked.y);
    stage.overlay = { chosen, held: { point: chosen, to: asked } };
    stage.refresh();
    this.held = { point: chosen, to, timer: setTimeout(() => this.letGo(chosen), IDLE) };
  }

  private letGo(chosen: number): void {
    this.held = undefined;
    this.page.stage.overlay = { chosen };
    this.page.stage.refresh();
    this.page.client.release().then((answer) => {
      if (typeof answer.statement === "string") this.page.hint(answer.statement);
    });
  }

  private trace(handle: number): void {
    const { state } = this.page.client;
    const name = pointOf(this.page.client, handle)?.name ?? "";
    void this.page.do(`${state?.traced.includes(handle) === true ? "untrace" : "trace"} ${name}`);
  }

  private remove(handle: number): void {
    const name = pointOf(this.page.client, handle)?.name ?? "";
    this.chosen = undefined;
    this.page.stage.overlay = {};
    void this.page.do(`delete ${name} cascade`);
  }
}

/** Whether a key is for the element that has the focus. */
function isTyping(target: HTMLElement, key: string): boolean {
  if (target.matches("textarea, select, input:not([type=checkbox])")) return true;
  if (target.closest("dialog, .menu") !== null) return key !== "Escape";
  // Space and Enter press what they are on.
  return target.matches("button, summary, a, input") && (key === " " || key === "Enter");
}
