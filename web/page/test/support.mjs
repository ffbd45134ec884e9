// What the tests share: sessions, a browser, a hand on the canvas.

import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

export const ROOT = join(dirname(fileURLToPath(import.meta.url)), "..", "..", "..");

/** The program; the test script says where it is. */
export const PROGRAM = process.env.LINKWORK ?? join(ROOT, "target", "debug", "linkwork");

/** The playground; none where it could not be built. */
export const PLAYGROUND = process.env.PLAYGROUND || undefined;

/** How long anything may take that is not measured here, ms: machines that build are slow. */
export const PATIENCE = 60_000;

/** A folder that goes with the test. */
export function folder(t) {
  const path = mkdtempSync(join(tmpdir(), "linkwork-page-"));
  t.after(() => rmSync(path, { recursive: true, force: true }));
  return path;
}

/** Waits until something holds. */
export async function until(holds, what) {
  const end = Date.now() + PATIENCE;
  for (;;) {
    const found = await holds();
    if (found) return found;
    if (Date.now() > end) assert.fail(`still not so: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

/** The program carries out scripts; gives what it said. */
export function run(args, cwd, input) {
  const done = spawnSync(PROGRAM, args, { cwd, input, encoding: "utf8", timeout: PATIENCE });
  return { status: done.status, out: done.stdout, err: done.stderr };
}

/** A port that nobody listens on. */
export async function freePort() {
  const server = createServer();
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}

/** A session of `linkwork view` on a script. */
export async function session(t, script, { cwd = folder(t), args = [] } = {}) {
  const file = join(cwd, "scene.link");
  writeFileSync(file, script);
  const child = spawn(PROGRAM, ["view", file, "--out", cwd, ...args], {
    cwd,
    env: { ...process.env, XDG_STATE_HOME: cwd, XDG_CONFIG_HOME: cwd },
    stdio: ["pipe", "pipe", "pipe"],
  });
  let [out, err] = ["", ""];
  child.stdout.on("data", (data) => {
    out += data;
  });
  child.stderr.on("data", (data) => {
    err += data;
  });
  const ended = new Promise((resolve) => child.on("exit", resolve));
  const stop = async () => {
    child.kill("SIGTERM");
    await ended;
  };
  t.after(stop);
  const address = await until(
    () => /http:\/\/127\.0\.0\.1:\d+\/\S*/.exec(out + err)?.[0],
    "the session says its address",
  );
  return {
    address,
    cwd,
    stop,
    /** A statement at the prompt. */
    type: (text) => child.stdin.write(`${text}\n`),
    said: () => out,
    complained: () => err,
  };
}

let shared;

/** One browser for all tests. */
export async function browser() {
  shared ??= await chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: ["--no-sandbox", "--disable-dev-shm-usage"],
  });
  return shared;
}

export async function closeBrowser() {
  await shared?.close();
  shared = undefined;
}

/** A page at an address; what goes wrong in it fails the test. */
export async function open(
  t,
  address,
  { width = 1200, height = 800, dark = false, touch = false, before } = {},
) {
  const context = await (await browser()).newContext({
    viewport: { width, height },
    colorScheme: dark ? "dark" : "light",
    hasTouch: touch,
    acceptDownloads: true,
  });
  t.after(() => context.close());
  const page = await context.newPage();
  const wrong = [];
  const strange = [];
  page.on("console", (message) => {
    // A connection that is refused is what some tests are about.
    if (message.type() === "error" && !message.text().includes("ERR_CONNECTION_REFUSED"))
      wrong.push(message.text());
  });
  page.on("pageerror", (error) => wrong.push(String(error)));
  const origin = new URL(address).origin;
  page.on("request", (request) => {
    const url = request.url();
    const isOwn = url.startsWith("data:") || url.startsWith("blob:") || url.startsWith("file:");
    if (!isOwn && new URL(url).origin !== origin) strange.push(url);
  });
  t.after(() => {
    assert.deepEqual(wrong, [], "the page has no errors");
    assert.deepEqual(strange, [], "the page loads nothing from elsewhere");
  });
  await page.addInitScript(() => {
    addEventListener(
      "linkwork-painted",
      (event) => {
        window.painted = event.detail;
        window.nPainted = (window.nPainted ?? 0) + 1;
      },
      { capture: true },
    );
  });
  if (before !== undefined) await page.addInitScript(before);
  await page.goto(address);
  return page;
}

/** The page at a session, with its first picture on it. */
export async function openAt(t, address, options) {
  const page = await open(t, address, options);
  await settled(page);
  return page;
}

/** Waits for a picture that does not change any more. */
export async function settled(page) {
  await page.waitForFunction(() => window.painted !== undefined, undefined, { timeout: PATIENCE });
  // The picture is asked for anew once its scale is known.
  let before = -1;
  await until(async () => {
    const now = await page.evaluate(() => window.painted.scale);
    const isSame = now === before;
    before = now;
    await page.waitForTimeout(150);
    return isSame;
  }, "the view stays as it is");
}

/** Where a point is, in the plane. */
export function place(page, handle) {
  return page.evaluate((handle) => {
    const { at } = window.painted;
    return { x: at[2 * handle], y: at[2 * handle + 1] };
  }, handle);
}

/** Where a place of the plane is on the screen. */
export function screen(page, { x, y }) {
  return page.evaluate(
    ([x, y]) => {
      const { scale, centre, width, height } = window.painted;
      const { left, top } = document.getElementById("canvas").getBoundingClientRect();
      return {
        x: left + width / 2 + (x - centre.x) * scale,
        y: top + height / 2 - (y - centre.y) * scale,
      };
    },
    [x, y],
  );
}

/** Drags with the mouse, through places of the plane. */
export async function drag(page, from, ...through) {
  const { mouse } = page;
  const start = await screen(page, from);
  await mouse.move(start.x, start.y);
  await mouse.down();
  let last = start;
  for (const stop of through) {
    const to = await screen(page, stop);
    for (let k = 1; k <= 5; k++) {
      await mouse.move(last.x + ((to.x - last.x) * k) / 5, last.y + ((to.y - last.y) * k) / 5);
    }
    last = to;
  }
  await mouse.up();
}

export async function click(page, place, { count = 1 } = {}) {
  const { x, y } = await screen(page, place);
  for (let k = 0; k < count; k++) await page.mouse.click(x, y);
}

/** Carries out a text in the box; gives what is said of it. */
export async function tell(page, text) {
  await page.fill("#text", text);
  await page.click("#run");
  await page.locator('#text:not([aria-busy="true"])').waitFor({ timeout: PATIENCE });
  return (await page.textContent("#answer")).trim();
}

/** The lines of the journal. */
export function journal(page) {
  return page.$$eval("#journal button", (lines) => lines.map((line) => line.textContent));
}

/** Waits for a line of the journal. */
export function written(page, pattern) {
  return until(
    async () => (await journal(page)).find((line) => pattern.test(line)),
    `the journal has ${pattern}`,
  );
}

/** A file that a button of the page gives. */
export async function download(page, kind) {
  const waiting = page.waitForEvent("download", { timeout: PATIENCE });
  await page.click(`[data-file="${kind}"]`);
  const file = await waiting;
  const stream = await file.createReadStream();
  const parts = [];
  for await (const part of stream) parts.push(part);
  return { name: file.suggestedFilename(), bytes: Buffer.concat(parts) };
}

/** Numbers of two poses are the same to what the solver promises. */
export function near(a, b, within = 1e-9) {
  assert.ok(
    Math.hypot(a.x - b.x, a.y - b.y) <= within,
    `${JSON.stringify(a)} is not at ${JSON.stringify(b)}`,
  );
}
