// The page with its own engine: opened from a file, without a server.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { pathToFileURL } from "node:url";
import * as s from "./support.mjs";

const skip = s.PLAYGROUND === undefined && "the playground is not built";
const address = skip ? "" : pathToFileURL(s.PLAYGROUND).href;

after(s.closeBrowser);

/** A link to a script. */
const linkTo = (script) => `${address}#t=${encodeURIComponent(script)}`;

/** Waits until the script in the box has been carried out. */
async function carriedOut(page) {
  await page.locator("#text:not(:placeholder-shown)").waitFor({ timeout: s.PATIENCE });
  await page.locator('#text:not([aria-busy="true"])').waitFor({ timeout: s.PATIENCE });
  await s.settled(page);
}

test("a double click on the file opens a mechanism that moves", { skip }, async (t) => {
  const page = await s.open(t, address);
  await carriedOut(page);
  await page.click("#play");
  const begin = await page.evaluate(() => window.painted.time);
  await s.until(
    async () => (await page.evaluate(() => window.painted.time)) > begin + 0.2,
    "time passes",
  );
  await page.click("#play");
  await s.written(page, /^step \d+$/);
});

test("points are dragged, mistakes have carets", { skip }, async (t) => {
  const page = await s.open(t, linkTo("point A = (0, 0) frozen, B = (2, 0)\nlength A B = 2"));
  await carriedOut(page);
  await s.drag(page, { x: 2, y: 0 }, { x: 1, y: 1.5 });
  await s.written(page, /^pull B/);
  const b = await s.place(page, 1);
  assert.ok(Math.abs(Math.hypot(b.x, b.y) - 2) < 1e-9);
  assert.match(await s.tell(page, "length A Q = 3"), /unknown name `Q`[\s\S]*\^/);
});

test("a link holds the mechanism, gestures included", { skip }, async (t) => {
  const page = await s.open(
    t,
    linkTo("let r = 2\npoint A = (0, 0) frozen, B = (2, 0)\nlength A B = r\ntrace B"),
  );
  await carriedOut(page);
  await s.drag(page, { x: 2, y: 0 }, { x: 1, y: 1.5 }, { x: -1, y: 1 });
  await s.written(page, /^pull B/);
  await s.tell(page, "let r = 2.25; step 10");
  const script = (await s.download(page, "script")).bytes.toString();
  await page.getByRole("button", { name: "Share" }).click();
  await page.waitForFunction(() => location.hash.startsWith("#z="));
  const other = await s.open(t, page.url());
  await carriedOut(other);
  assert.equal((await s.download(other, "script")).bytes.toString(), script);
});

test("what a statement wrote can be taken home", { skip }, async (t) => {
  const page = await s.open(t, linkTo("point A = (0, 0) frozen, B = (2, 0)\nlength A B = 2"));
  await carriedOut(page);
  await s.tell(page, 'svg "now.svg"; save "all.link"');
  const { name, bytes } = await s.download(page, "now.svg");
  assert.equal(name, "now.svg");
  assert.match(bytes.toString(), /^<svg /);
  assert.match((await s.download(page, "all.link")).bytes.toString(), /^point A/m);
});

test("examples have pictures, and one of them is opened by a click", { skip }, async (t) => {
  const page = await s.open(t, address);
  await carriedOut(page);
  await page.getByRole("button", { name: "Examples" }).click();
  const card = page.locator(".gallery button").filter({ hasText: /^peaucellier$/ });
  const isDrawn = await card.locator("img").evaluate(async (image) => {
    await image.decode();
    return image.naturalWidth > 50;
  });
  assert.ok(isDrawn);
  await card.click();
  await carriedOut(page);
  assert.match(page.url(), /#example=peaucellier$/);
  assert.match(await page.inputValue("#text"), /Peaucellier/);
});

test("both engines make the same bytes of every example", { skip, timeout: 600_000 }, async (t) => {
  const cwd = s.folder(t);
  const names = s
    .run(["examples"], cwd)
    .out.split("\n")
    .map((line) => /^\s*([a-z0-9-]+)\s/.exec(`${line} `)?.[1])
    .filter((name) => name !== undefined);
  assert.ok(names.length > 40, `${names.length} examples`);
  // Beside one another: some include others.
  for (const name of names) {
    writeFileSync(join(cwd, `${name}.link`), s.run(["examples", name], cwd).out);
  }
  const page = await s.open(t, linkTo("point A = (0, 0)"));
  await carriedOut(page);
  const different = [];
  for (const name of names) {
    await page.goto(`${address}#example=${name}`);
    await page.waitForFunction((name) => document.title === `${name} – linkwork`, name, {
      timeout: s.PATIENCE,
    });
    const there = (await s.download(page, "script")).bytes.toString();
    const save = ["-e", 'save "native.link"', "--force", "--out", cwd];
    const { status, err } = s.run(["run", `${name}.link`, ...save], cwd);
    assert.equal(status, 0, `${name}: ${err}`);
    if (readFileSync(join(cwd, "native.link"), "utf8") !== there) different.push(name);
  }
  assert.deepEqual(different, []);
});

test("a browser without WebAssembly gets a sentence", { skip }, async (t) => {
  const page = await s.open(t, address, { before: () => delete window.WebAssembly });
  await page.getByText(/WebAssembly in a worker, and this browser has not both/).waitFor();
});

test("an address that cannot be read is said", { skip }, async (t) => {
  const page = await s.open(t, `${address}#z=nonsense`);
  await page.getByText("The script in the address cannot be read.").waitFor();
});
