//! The page's end of the protocol: what the engine said last, and how it is asked.

import { Signal } from "../signal.ts";
import type { Carrier, Standing } from "./carrier.ts";
import { pieces } from "./pieces.ts";
import {
  type Answer,
  type Completion,
  type Drawing,
  type Entry,
  type Example,
  type FileAnswer,
  type Frame,
  type Hello,
  type Look,
  type Message,
  type Off,
  PROTOCOL,
  readFrame,
  type Said,
  type Shape,
  type State,
  topologyOf,
} from "./protocol.ts";
import { Traces } from "./traces.ts";

/** What is known of an engine that has said nothing. */
const NOTHING: State = {
  time: 0,
  frame: 0,
  dt: 0,
  playing: false,
  speed: 1,
  held: null,
  points: [],
  constraints: [],
  motors: [],
  parameters: [],
  settings: [],
  freedoms: null,
  sound: null,
  verdict: null,
  check: null,
  receipt: null,
  unlisted: 0,
  undo: null,
  redo: null,
  traced: [],
};

export class Client {
  readonly standing = new Signal<Standing>();
  readonly greeted = new Signal<Hello>();
  readonly stated = new Signal<State>();
  readonly missed = new Signal<readonly Off[]>();
  readonly drawn = new Signal<Drawing>();
  readonly reshaped = new Signal<readonly (readonly [number, readonly Shape[]])[]>();
  readonly traced = new Signal();
  readonly moved = new Signal<Frame>();
  readonly wrote = new Signal<readonly Entry[]>();
  readonly said = new Signal<readonly Said[]>();
  /** Files that statements of this page wrote. */
  readonly filed = new Signal<readonly string[]>();

  hello: Hello | undefined;
  state: State | undefined;
  off: readonly Off[] = [];
  classes: Readonly<Record<string, Look>> = {};
  drawing: Drawing | undefined;
  frame: Frame | undefined;
  readonly traces = new Traces();

  private nAsked = 0;
  /** Whether a place is on its way to the engine, and the one that follows. */
  private isMoving = false;
  private next: readonly [number, number] | undefined;
  private readonly waiting = new Map<number, (message: unknown) => void>();
  /** Whether there is a frame that the display does not have, and what came after that. */
  private hasFrame = false;
  private readonly later: (string | ArrayBuffer)[] = [];

  constructor(private readonly carrier: Carrier) {}

  /** Whether the session can be begun anew. */
  get canRestart(): boolean {
    return this.carrier.restart !== undefined;
  }

  open(): void {
    this.carrier.open({
      standing: (standing) => this.stands(standing),
      text: (text) => this.take(text),
      frame: (buffer) => this.take(buffer),
    });
  }

  restart(): void {
    this.carrier.restart?.();
  }

  tick(): void {
    if (this.state?.playing === true) this.carrier.tick?.();
  }

  /** The display has the last frame: the next may come. */
  shown(): void {
    this.hasFrame = false;
    let nFrames = this.later.filter((message) => typeof message !== "string").length;
    for (const message of this.later.splice(0)) {
      // Of frames that have piled up one waits at most.
      if (typeof message !== "string" && --nFrames > 0) this.hasFrame = false;
      this.take(message);
    }
  }

  /** Carries out statements. */
  async exec(text: string): Promise<Answer> {
    const parts = pieces(text);
    const last = parts.pop() ?? "";
    for (const part of parts) this.tell({ do: "exec", text: part, more: true });
    const answer = await this.ask<Answer>({ do: "exec", text: last });
    if (answer.wrote?.length) this.filed.tell(answer.wrote);
    return answer;
  }

  /** Carries out a statement in the place of the last that was tried. */
  attempt(text: string): Promise<Answer> {
    return this.ask({ do: "try", text });
  }

  keep(): void {
    this.tell({ do: "keep" });
  }

  complete(text: string, at: number): Promise<Completion> {
    return this.ask({ do: "complete", text, at });
  }

  file(kind: string, more: Record<string, unknown> = {}): Promise<FileAnswer> {
    return this.ask({ do: "file", kind, ...more });
  }

  async examples(): Promise<readonly Example[]> {
    const answer = await this.ask<{ examples?: readonly Example[] }>({ do: "examples" });
    return answer.examples ?? [];
  }

  grab(point: number): Promise<Answer> {
    return this.ask({ do: "grab", point });
  }

  /** Leads what is held to a place, once it has been led to the one before: of those that come meanwhile the
   * last counts, so that the point does not lag behind where an engine takes long. */
  move(x: number, y: number): void {
    if (this.isMoving) {
      this.next = [x, y];
      return;
    }
    this.isMoving = true;
    this.ask({ do: "move", to: [x, y] }).then(() => {
      this.isMoving = false;
      this.goOn();
    });
  }

  release(): Promise<Answer> {
    if (this.next !== undefined) this.tell({ do: "move", to: this.next });
    this.next = undefined;
    return this.ask({ do: "release" });
  }

  cancel(): void {
    this.next = undefined;
    this.tell({ do: "cancel" });
  }

  private goOn(): void {
    const { next } = this;
    this.next = undefined;
    if (next !== undefined) this.move(...next);
  }

  play(speed: number): void {
    this.tell({ do: "play", speed });
  }

  pause(): void {
    this.tell({ do: "pause" });
  }

  /** Stops what runs: where the engine cannot be asked while it works, it begins anew. */
  stop(): void {
    if (this.canRestart) this.restart();
    else this.tell({ do: "stop" });
  }

  view(scale: number): void {
    this.tell({ do: "view", scale });
  }

  seen(seq: number): void {
    this.tell({ do: "seen", seq });
  }

  private tell(message: Record<string, unknown>): void {
    this.carrier.send(JSON.stringify(message));
  }

  private ask<T>(message: Record<string, unknown>): Promise<T> {
    this.nAsked += 1;
    const id = this.nAsked;
    return new Promise((resolve) => {
      this.waiting.set(id, (answer) => resolve(answer as T));
      this.tell({ ...message, id });
    });
  }

  /** While time passes an engine has its clock and the display another: of two frames that come between two
   * pictures the second waits for the next, with all that comes after it. */
  private take(message: string | ArrayBuffer): void {
    const isFrame = typeof message !== "string";
    const isPaced = this.state?.playing === true && this.state.held === null;
    if (this.later.length > 0 || (isFrame && isPaced && this.hasFrame)) {
      this.later.push(message);
    } else if (isFrame) {
      this.hasFrame = true;
      this.see(message);
    } else {
      this.hear(JSON.parse(message) as Message);
    }
  }

  private stands(standing: Standing): void {
    // What was asked of an engine that is gone is not answered any more.
    const unanswered = [...this.waiting.values()];
    this.waiting.clear();
    this.next = undefined;
    this.later.length = 0;
    const lost: Answer = { ok: false, said: [{ kind: "error", text: "the connection was lost" }] };
    for (const resolve of unanswered) resolve(lost);
    this.drawing = undefined;
    this.frame = undefined;
    if (standing.is === "open") this.tell({ do: "hello", protocol: PROTOCOL });
    this.standing.tell(standing);
  }

  private hear(message: Message): void {
    if (message.answer !== undefined) {
      this.waiting.get(message.answer)?.(message);
      this.waiting.delete(message.answer);
      return;
    }
    this.hearPicture(message);
    if (message.hello !== undefined) {
      this.hello = message.hello;
      this.state = undefined;
      this.off = [];
      this.traces.list.length = 0;
      this.greeted.tell(message.hello);
    }
    if (message.state !== undefined) {
      this.state = { ...(this.state ?? NOTHING), ...message.state };
      this.stated.tell(this.state);
    }
    if (message.off !== undefined) {
      this.off = message.off;
      this.missed.tell(message.off);
    }
    if (message.journal !== undefined) this.wrote.tell(message.journal);
    if (message.said !== undefined) this.said.tell(message.said);
    if (message.refused !== undefined) {
      this.said.tell([{ kind: "error", text: `refused: ${message.refused}` }]);
    }
  }

  private hearPicture(message: Message): void {
    if (message.classes !== undefined) this.classes = message.classes;
    if (message.drawing !== undefined) {
      this.drawing = message.drawing;
      this.drawn.tell(message.drawing);
    }
    if (message.shapes !== undefined) this.reshape(message.shapes);
    if (message.traces !== undefined) {
      this.traces.update(message.traces, message.n);
      this.traced.tell();
    }
  }

  private reshape({ topology, figures }: NonNullable<Message["shapes"]>): void {
    const { drawing } = this;
    if (topology !== drawing?.topology) return;
    for (const [idx, shapes] of figures) {
      const figure = drawing.figures[idx];
      if (figure !== undefined) drawing.figures[idx] = { ...figure, shapes };
    }
    this.reshaped.tell(figures);
  }

  private see(buffer: ArrayBuffer): void {
    const drawing = this.drawing;
    if (drawing === undefined || topologyOf(buffer) !== drawing.topology) return;
    const before = this.frame?.topology === drawing.topology ? this.frame.place : undefined;
    const frame = readFrame(buffer, drawing, before);
    if (frame === undefined) return;
    this.frame = frame;
    this.moved.tell(frame);
  }
}
