// Holds the engine to the program: every script that needs no files comes to the same world, to the
// last bit of what `save` writes.
//
//   node same.mjs ENGINE.wasm LINKWORK SCRIPTS

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const [wasm, program, scripts] = process.argv.slice(2);
const module = new WebAssembly.Module(readFileSync(wasm));

if (WebAssembly.Module.imports(module).length > 0) {
  throw new Error("the engine imports something: a page has nothing for it");
}

/** An engine that is asked one thing after the other. */
class Engine {
  constructor() {
    this.wasm = new WebAssembly.Instance(module, {}).exports;
    this.wasm.begin();
  }

  ask(message) {
    const utf8 = new TextEncoder().encode(JSON.stringify({ ...message, id: 1 }));
    const at = this.wasm.room(utf8.length);
    new Uint8Array(this.wasm.memory.buffer, at, utf8.length).set(utf8);
    try {
      this.wasm.tell(utf8.length);
    } catch (trap) {
      throw new Error(this.text(this.wasm.fault()) || String(trap));
    }
    let answer;
    for (let kind = this.wasm.next(); kind !== 0; kind = this.wasm.next()) {
      const told = kind === 1 ? JSON.parse(this.text(this.wasm.out())) : {};
      if (told.answer === 1) answer = told;
    }
    return answer;
  }

  text(at) {
    return new TextDecoder().decode(new Uint8Array(this.wasm.memory.buffer, at, this.wasm.length()));
  }
}

/** The files below a folder. */
function below(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? below(path) : [path];
  });
}

/** What the program saves after a script. */
function saved(path) {
  const folder = mkdtempSync(join(tmpdir(), "linkwork-same-"));
  try {
    const args = [path, "-e", 'save "saved.link"', "--out", folder, "--quiet"];
    execFileSync(program, args, { stdio: ["ignore", "ignore", "inherit"] });
    return readFileSync(join(folder, "saved.link"), "utf8");
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const NEEDS_FILES = /^\s*(include|load)\b/m;
let [nSame, nLeft] = [0, 0];
const wrong = [];
for (const path of below(scripts).filter((path) => path.endsWith(".link")).sort()) {
  const text = readFileSync(path, "utf8");
  if (NEEDS_FILES.test(text)) {
    nLeft += 1;
    continue;
  }
  const engine = new Engine();
  engine.ask({ do: "exec", text });
  if (engine.ask({ do: "file", kind: "script" }).text === saved(path)) nSame += 1;
  else wrong.push(path);
}
console.log(`${nSame} scripts come to the same bits, ${nLeft} need files`);
if (nSame === 0 || wrong.length > 0) {
  console.error(`another world: ${wrong.join(", ")}`);
  process.exitCode = 1;
}
