//! The script of the worker: lends the engine a thread of its own.

import { Wasm } from "./wasm.ts";

const scope = globalThis as unknown as {
  postMessage(message: unknown, transfer?: Transferable[]): void;
  onmessage: ((event: MessageEvent<string | null | WebAssembly.Module>) => void) | null;
};

let engine: Wasm | undefined;
/** What came before the engine was there. */
const early: string[] = [];

function fails(error: unknown): void {
  scope.postMessage({ fault: error instanceof Error ? error.message : String(error) });
}

async function begin(module: WebAssembly.Module): Promise<void> {
  const instance = await WebAssembly.instantiate(module, {});
  engine = new Wasm(instance, (told) =>
    scope.postMessage(told, told instanceof ArrayBuffer ? [told] : []),
  );
  for (const message of early.splice(0)) engine.tell(message);
}

/** Is there a tick to come that no message asked for? */
let isTickDue = false;

function tick(): void {
  isTickDue = false;
  engine?.tick(performance.now());
}

/** Time that passes goes on when the messages that wait have been taken. */
function tickSoon(): void {
  if (isTickDue || engine?.isBusy !== true) return;
  isTickDue = true;
  setTimeout(() => guarded(tick), 0);
}

function guarded(work: () => void): void {
  try {
    work();
  } catch (error) {
    fails(error);
  }
}

scope.onmessage = ({ data }) => {
  if (data instanceof WebAssembly.Module) {
    begin(data).catch(fails);
    return;
  }
  guarded(() => {
    if (data === null) tick();
    else if (engine === undefined) early.push(data);
    else engine.tell(data);
    if (data !== null) tickSoon();
  });
};
