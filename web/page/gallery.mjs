// Pictures of the examples, drawn by the engine itself: JSON, a name and an SVG each.
//
//   node gallery.mjs WASM > gallery.json

import { readFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const HERE = dirname(fileURLToPath(import.meta.url));

/** The page's own way to the engine. */
async function wasmClass() {
  const result = await build({
    entryPoints: [join(HERE, "src", "engine", "wasm.ts")],
    bundle: true,
    write: false,
    format: "esm",
  });
  const source = Buffer.from(result.outputFiles[0].contents).toString("base64");
  return (await import(`data:text/javascript;base64,${source}`)).Wasm;
}

/** An engine that is asked one thing after the other. */
class Engine {
  constructor(Wasm, module) {
    this.answers = new Map();
    this.wasm = new Wasm(new WebAssembly.Instance(module, {}), (told) => {
      if (typeof told !== "string") return;
      const message = JSON.parse(told);
      if (message.answer !== undefined) this.answers.set(message.answer, message);
    });
    this.n = 0;
    this.wasm.tell(JSON.stringify({ do: "hello", protocol: 1 }));
  }

  ask(message) {
    this.n += 1;
    this.wasm.tell(JSON.stringify({ ...message, id: this.n }));
    return this.answers.get(this.n);
  }
}

async function main([wasm]) {
  const Wasm = await wasmClass();
  const module = await WebAssembly.compile(await readFile(wasm));
  const pictures = {};
  for (const { name, text } of new Engine(Wasm, module).ask({ do: "examples" }).examples) {
    const engine = new Engine(Wasm, module);
    const { ok, said } = engine.ask({ do: "exec", text });
    if (!ok) throw new Error(`${name}: ${said.map((one) => one.text).join("\n")}`);
    pictures[name] = engine.ask({ do: "file", kind: "svg" }).text;
  }
  process.stdout.write(JSON.stringify(pictures));
}

await main(process.argv.slice(2));
