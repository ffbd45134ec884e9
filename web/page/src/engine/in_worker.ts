//! An engine in a worker: the library as WebAssembly, which lies in the page.

import { unpacked } from "../pack.ts";
import type { Carrier, Listener } from "./carrier.ts";

export class InWorker implements Carrier {
  private worker: Worker | undefined;
  private module: WebAssembly.Module | undefined;
  private address: string | undefined;
  private listener: Listener | undefined;

  /** The worker's script and the library, both packed. */
  constructor(
    private readonly source: string,
    private readonly wasm: string,
  ) {}

  open(listener: Listener): void {
    this.listener = listener;
    listener.standing({ is: "waiting", why: "The engine is being made ready …" });
    this.begin(listener).catch((error: unknown) => {
      listener.standing({ is: "gone", why: `The engine cannot be started: ${String(error)}` });
    });
  }

  send(message: string): void {
    this.worker?.postMessage(message);
  }

  restart(): void {
    this.worker?.terminate();
    this.worker = undefined;
    if (this.listener !== undefined) this.open(this.listener);
  }

  tick(): void {
    this.worker?.postMessage(null);
  }

  private async begin(listener: Listener): Promise<void> {
    this.module ??= await WebAssembly.compile(await unpacked(this.wasm));
    this.address ??= URL.createObjectURL(
      new Blob([await unpacked(this.source)], { type: "text/javascript" }),
    );
    const worker = new Worker(this.address);
    this.worker = worker;
    worker.onmessage = ({ data }: MessageEvent<string | ArrayBuffer | { fault: string }>) => {
      if (worker !== this.worker) return;
      if (typeof data === "string") listener.text(data);
      else if (data instanceof ArrayBuffer) listener.frame(data);
      else this.failed(listener, data.fault);
    };
    worker.onerror = (event) => this.failed(listener, event.message);
    worker.postMessage(this.module);
    listener.standing({ is: "open" });
  }

  /** An error of the engine: it begins anew, empty. */
  private failed(listener: Listener, why: string): void {
    this.worker?.terminate();
    this.worker = undefined;
    listener.standing({ is: "gone", why: `The engine failed: ${why}. Load the page again.` });
  }
}
