//! An engine behind a socket: the session of `linkwork view`.

import type { Carrier, Listener } from "./carrier.ts";

/** How long to wait before the next try, ms: soon at first, and not so often later. */
const WAITS = [200, 400, 800, 1500, 3000];

/** Ends of a socket after which another try would be refused too. */
const FINAL: ReadonlyMap<number, string> = new Map([
  [
    1013,
    "There are as many pages open on this session as it takes. Close one and load this again.",
  ],
]);

export class Socket implements Carrier {
  private socket: WebSocket | undefined;
  private nTries = 0;

  constructor(private readonly address: string) {}

  open(listener: Listener): void {
    const socket = new WebSocket(this.address);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.nTries = 0;
      listener.standing({ is: "open" });
    };
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      if (typeof data === "string") listener.text(data);
      else listener.frame(data);
    };
    socket.onclose = ({ code }) => this.lost(listener, code);
  }

  send(message: string): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(message);
  }

  private lost(listener: Listener, code: number): void {
    const final = FINAL.get(code);
    if (final !== undefined) {
      listener.standing({ is: "gone", why: final });
      return;
    }
    const why = code === 1001 ? "The session has ended" : "The connection is lost";
    listener.standing({ is: "waiting", why: `${why}; trying to reach it again …` });
    const wait = WAITS[Math.min(this.nTries, WAITS.length - 1)] ?? 0;
    this.nTries += 1;
    setTimeout(() => this.open(listener), wait);
  }
}
