// Builds the page into one file: `../built/index.html`, which the program carries.
//
//   node build.mjs                       writes it
//   node build.mjs --check               says whether the one that is there is current
//   node build.mjs --playground WASM GALLERY OUT   writes the page with its engine in it

import { createHash } from "node:crypto";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const HERE = dirname(fileURLToPath(import.meta.url));
const BUILT = join(HERE, "..", "built", "index.html");

/** A source and all that it needs as one text. */
async function bundled(source) {
  const result = await build({
    entryPoints: [join(HERE, "src", source)],
    absWorkingDir: HERE,
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    legalComments: "none",
  });
  return result.outputFiles[0].text.trim();
}

/** How a policy names a text that may be part of the page. */
function hashed(text) {
  return `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
}

/** The page: `data` are further elements, `own` what the policy has to allow for them. */
async function page({ data = "", scripts = "", rest = "connect-src 'self'" } = {}) {
  const [template, style, script] = await Promise.all([
    readFile(join(HERE, "src", "index.html"), "utf8"),
    bundled("style.css"),
    bundled("main.ts"),
  ]);
  const policy = [
    "default-src 'none'",
    `script-src ${hashed(script)}${scripts}`,
    `style-src ${hashed(style)}`,
    "img-src data: blob:",
    "base-uri 'none'",
    "form-action 'none'",
    rest,
  ].join("; ");
  const parts = {
    policy,
    data,
    style: `<style>${style}</style>`,
    script: `<script>${script}</script>`,
  };
  return template.replace(
    /<!--\{(\w+)\}-->|\{(policy)\}/g,
    (_, part, other) => parts[part ?? other],
  );
}

/** The page with the engine in it, which works from any folder and any static host. */
async function playground(wasm, gallery) {
  const worker = await bundled("engine/worker.ts");
  const element = (id, bytes) => {
    const packed = gzipSync(bytes, { level: 9 }).toString("base64");
    return `<script type="text/plain" id="${id}">${packed}</script>`;
  };
  return page({
    data: [
      element("engine-wasm", await readFile(wasm)),
      element("engine-worker", worker),
      element("gallery", await readFile(gallery)),
    ].join("\n"),
    scripts: " 'wasm-unsafe-eval'",
    rest: "worker-src blob:",
  });
}

async function main([command, ...rest]) {
  if (command === "--playground") {
    const [wasm, gallery, out] = rest;
    await mkdir(out, { recursive: true });
    const text = await playground(wasm, gallery);
    await writeFile(join(out, "index.html"), text);
    console.log(`${join(out, "index.html")}: ${text.length} bytes`);
    return 0;
  }
  const text = await page();
  if (command === "--check") {
    const there = await readFile(BUILT, "utf8").catch(() => "");
    if (there === text) return 0;
    console.error(
      "web/built/index.html is not what its sources make: npm --prefix web/page run build",
    );
    return 1;
  }
  await mkdir(dirname(BUILT), { recursive: true });
  await writeFile(BUILT, text);
  console.log(`${BUILT}: ${text.length} bytes`);
  return 0;
}

process.exitCode = await main(process.argv.slice(2));
