//! What carries messages between the page and an engine.

/** How it stands with an engine. */
export type Standing =
  | { readonly is: "open" }
  | { readonly is: "waiting"; readonly why: string }
  | { readonly is: "gone"; readonly why: string };

/** Who hears what an engine says. */
export interface Listener {
  standing(standing: Standing): void;
  text(message: string): void;
  frame(buffer: ArrayBuffer): void;
}

/** A way to an engine. */
export interface Carrier {
  /** Begins; what was lost is begun anew by itself. */
  open(listener: Listener): void;
  send(message: string): void;
  /** Begins with an empty session where that is possible. */
  restart?(): void;
  /** Tells that time may pass, as often as the display shows. */
  tick?(): void;
}
