//! The library as WebAssembly: messages in, texts and frames out.

/** What the library exports. */
interface Exports {
  readonly memory: WebAssembly.Memory;
  begin(): void;
  room(length: number): number;
  tell(length: number): void;
  tick(now: number): void;
  /** Whether time passes. */
  busy(): number;
  /** 0 nothing, 1 a text, 2 a frame. */
  next(): number;
  out(): number;
  length(): number;
  fault(): number;
}

export type Told = string | ArrayBuffer;

export class Wasm {
  private readonly exports: Exports;

  /** `hear` gets all that the engine says. */
  constructor(
    instance: WebAssembly.Instance,
    private readonly hear: (told: Told) => void,
  ) {
    this.exports = instance.exports as unknown as Exports;
    this.guarded(() => this.exports.begin());
  }

  tell(message: string): void {
    const utf8 = new TextEncoder().encode(message);
    this.guarded(() => {
      const at = this.exports.room(utf8.length);
      new Uint8Array(this.exports.memory.buffer, at, utf8.length).set(utf8);
      this.exports.tell(utf8.length);
    });
  }

  get isBusy(): boolean {
    return this.exports.busy() !== 0;
  }

  /** Lets time pass, if it does. */
  tick(now: number): void {
    this.guarded(() => this.exports.tick(now));
  }

  /** Does something and hands on what the engine has to say of it; a trap has its words. */
  private guarded(work: () => void): void {
    try {
      work();
    } catch (trap) {
      const words = new TextDecoder().decode(this.bytes(this.exports.fault()));
      throw new Error(words === "" ? String(trap) : words);
    }
    for (let kind = this.exports.next(); kind !== 0; kind = this.exports.next()) {
      const told = this.bytes(this.exports.out());
      this.hear(kind === 1 ? new TextDecoder().decode(told) : told.buffer);
    }
  }

  private bytes(at: number): Uint8Array<ArrayBuffer> {
    const { memory, length } = this.exports;
    return new Uint8Array(new Uint8Array(memory.buffer, at, length()));
  }
}
