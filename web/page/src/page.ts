//! What the parts of the page share.

import type { Client } from "./engine/client.ts";
import type { Answer, Said } from "./engine/protocol.ts";
import { Signal } from "./signal.ts";
import type { Stage } from "./stage.ts";
import type { Theme } from "./theme.ts";

export class Page {
  /** A sentence about what just happened, or what the tool in hand does. */
  readonly hinted = new Signal<{ readonly text: string; readonly isWrong: boolean }>();
  /** Texts are wanted in the box. */
  readonly written = new Signal<string>();
  /** An answer that the text's place shows. */
  readonly answered = new Signal<readonly Said[]>();

  constructor(
    readonly client: Client,
    readonly stage: Stage,
    readonly theme: Theme,
  ) {}

  /** Carries out a statement that a button or the mouse made; what is wrong is said. */
  async do(text: string): Promise<Answer> {
    const answer = await this.client.exec(text);
    this.report(text, answer);
    return answer;
  }

  /** Says what became of a statement. */
  report(text: string, answer: Answer): void {
    const wrong = answer.said?.find(({ kind }) => kind === "error");
    if (answer.ok) this.hinted.tell({ text, isWrong: false });
    else this.hinted.tell({ text: wrong?.message ?? wrong?.text ?? "refused", isWrong: true });
    this.answered.tell(answer.said ?? []);
  }

  hint(text: string): void {
    this.hinted.tell({ text, isWrong: false });
  }
}
