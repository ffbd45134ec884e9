//! The script of the worker: lends the engine a thread of its own.

/** What the library exports. */
interface Engine {
  readonly memory: WebAssembly.Memory;
  begin(): void;
  room(length: number): number;
  tell(length: number): void;
  tick(now: number): void;
  /** 0 nothing, 1 a text, 2 a frame. */
  next(): number;
  out(): number;
  length(): number;
  fault(): number;
}

const scope = globalThis as unknown as {
  postMessage(message: unknown, transfer?: Transferable[]): void;
  onmessage: ((event: MessageEvent<string | null | WebAssembly.Module>) => void) | null;
};

let engine: Engine | undefined;
/** What came before the engine was there. */
const early: string[] = [];

function bytes(engine: Engine, at: number): Uint8Array<ArrayBuffer> {
  return new Uint8Array(
    engine.memory.buffer,
    at,
    engine.length(),
  ).slice() as Uint8Array<ArrayBuffer>;
}

/** Hands on all that the engine has to say. */
function take(engine: Engine): void {
  for (let kind = engine.next(); kind !== 0; kind = engine.next()) {
    const told = bytes(engine, engine.out());
    if (kind === 1) scope.postMessage(new TextDecoder().decode(told));
    else scope.postMessage(told.buffer, [told.buffer]);
  }
}

function tell(engine: Engine, message: string): void {
  const utf8 = new TextEncoder().encode(message);
  const at = engine.room(utf8.length);
  new Uint8Array(engine.memory.buffer, at, utf8.length).set(utf8);
  engine.tell(utf8.length);
  take(engine);
}

/** Does something with the engine; where it traps, says what the engine says of it. */
function guarded(engine: Engine, work: () => void): void {
  try {
    work();
  } catch (error) {
    const said = new TextDecoder().decode(bytes(engine, engine.fault()));
    scope.postMessage({ fault: said === "" ? String(error) : said });
  }
}

function begin(module: WebAssembly.Module): void {
  WebAssembly.instantiate(module, {}).then(
    (instance) => {
      const begun = instance.exports as unknown as Engine;
      engine = begun;
      guarded(begun, () => {
        begun.begin();
        take(begun);
        for (const message of early.splice(0)) tell(begun, message);
      });
    },
    (error: unknown) => scope.postMessage({ fault: String(error) }),
  );
}

scope.onmessage = ({ data }) => {
  if (data instanceof WebAssembly.Module) {
    begin(data);
  } else if (engine === undefined) {
    if (data !== null) early.push(data);
  } else if (data === null) {
    const running = engine;
    guarded(running, () => {
      running.tick(performance.now());
      take(running);
    });
  } else {
    const running = engine;
    guarded(running, () => tell(running, data));
  }
};
