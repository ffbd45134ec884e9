// Measures the page in a real browser: from a pointer event to the redraw that answers it, and
// frames a second while time passes.
//
//   node web/page/measure.mjs [--playground web/dist/index.html] [--program target/release/linkwork]
//
// Chromium without a display paints in software; on a machine with one, figures are better.

import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";

const ROOT = join(dirname(fileURLToPath(import.meta.url)), "..", "..");

/** Moves of the mouse, one about each frame of the display. */
const N_MOVES = 240;
/** How long time passes, s. */
const SECONDS = 6;

const BEAST = `include "jansen-leg.link"
let legs = 6
let crank = 15
point O = (0, 0) frozen, L = (-38, -7.8) frozen, R = (38, -7.8) frozen
for k in 1..legs {
  point X[k] = polar(crank, k * 360deg / legs)
  motor O X[k] radius crank speed -1rev
  use jansen_leg(X[k], L, 1) as left[k]
  use jansen_leg(X[k], R, -1) as right[k]
}
step
`;

/** Two chords, posts and diagonals: four bars a field, turned slowly by a motor in its first post. */
const FIELDS = 250;
const TRUSS = `point low[0] = (0, 0) frozen, high[0] = (0, 1)
motor low[0] high[0] radius 1 speed 0.01rev
for i in 1..${FIELDS} {
  point low[i] = (i, 0), high[i] = (i, 1)
  length low[i-1] low[i]; length high[i-1] high[i]; length low[i] high[i]
  length low[i-1] high[i]
}
step
`;

/** Scenes, each with the point that is dragged: frozen, so that what is painted is where the mouse was. */
const SCENES = [
  { name: "twelve-leg beast", script: BEAST, grip: "L", reach: 0.6, goal: 16 },
  { name: "truss of 1,000 bars", script: TRUSS, grip: "low[0]", reach: 0.3, goal: 33 },
];

const { values } = parseArgs({
  options: {
    playground: { type: "string" },
    program: { type: "string", default: join(ROOT, "target", "release", "linkwork") },
    chromium: { type: "string", default: process.env.CHROMIUM ?? "/usr/bin/chromium" },
  },
});

/** A session of the program; gives the address and how to end it. */
async function session(script) {
  const cwd = mkdtempSync(join(tmpdir(), "linkwork-measure-"));
  writeFileSync(join(cwd, "scene.link"), script);
  writeFileSync(
    join(cwd, "jansen-leg.link"),
    readFileSync(join(ROOT, "scripts/gallery/jansen-leg.link")),
  );
  const child = spawn(
    resolve(values.program),
    ["view", join(cwd, "scene.link"), "--out", cwd, "--no-journal"],
    { cwd },
  );
  const address = await new Promise((resolve, reject) => {
    let said = "";
    const hear = (data) => {
      said += data;
      const found = /http:\/\/127\.0\.0\.1:\d+\/\S*/.exec(said);
      if (found !== null) resolve(found[0]);
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("exit", () => reject(new Error(said)));
  });
  const end = () => {
    child.removeAllListeners("exit");
    child.kill();
    rmSync(cwd, { recursive: true, force: true });
  };
  return { address, end };
}

/** Notes when the pointer moved and when that was painted. */
function watch() {
  window.moves = [];
  window.delays = [];
  window.nFrames = 0;
  addEventListener(
    "pointermove",
    (event) => window.moves.push({ at: event.timeStamp, x: event.clientX, y: event.clientY }),
    { capture: true },
  );
  addEventListener(
    "linkwork-painted",
    ({ detail }) => {
      const now = performance.now();
      if (detail.seq !== window.painted?.seq) window.nFrames += 1;
      window.painted = detail;
      if (window.grip === undefined) return;
      const { at, scale, centre, width, height } = detail;
      const { left, top } = document.getElementById("canvas").getBoundingClientRect();
      const x = left + width / 2 + (at[2 * window.grip] - centre.x) * scale;
      const y = top + height / 2 - (at[2 * window.grip + 1] - centre.y) * scale;
      // The newest move that this picture shows; those before it are answered as well.
      const k = window.moves.findLastIndex((move) => Math.hypot(move.x - x, move.y - y) < 0.9);
      if (k < 0) return;
      window.delays.push(now - window.moves[k].at);
      window.moves.splice(0, k + 1);
    },
    { capture: true },
  );
}

async function settle(page) {
  await page.waitForFunction(() => window.painted !== undefined, undefined, { timeout: 120_000 });
  await page.locator('#text:not([aria-busy="true"])').waitFor({ timeout: 120_000 });
  await page.waitForTimeout(1500);
}

async function delays(page, scene) {
  await page.fill("#text", `print ${scene.grip}`);
  await page.click("#run");
  await page.waitForTimeout(500);
  const [x, y] = (await page.textContent("#answer")).match(/-?[\d.e-]+/g).map(Number);
  const start = await page.evaluate(
    ([x, y]) => {
      const { at, scale, centre, width, height } = window.painted;
      for (let k = 0; k < at.length / 2; k++) {
        if (Math.hypot(at[2 * k] - x, at[2 * k + 1] - y) < 1e-9) window.grip = k;
      }
      const { left, top } = document.getElementById("canvas").getBoundingClientRect();
      return {
        x: left + width / 2 + (x - centre.x) * scale,
        y: top + height / 2 - (y - centre.y) * scale,
      };
    },
    [x, y],
  );
  await page.mouse.move(start.x, start.y);
  await page.mouse.down();
  await page.mouse.move(start.x + 6, start.y);
  await page.waitForTimeout(300);
  await page.evaluate(() => {
    window.delays = [];
    window.moves = [];
  });
  for (let k = 0; k < N_MOVES; k++) {
    const phi = (k / 60) * 2 * Math.PI;
    const radius = 30 * scene.reach;
    await page.mouse.move(start.x + radius * Math.cos(phi), start.y + radius * Math.sin(phi));
    await page.waitForTimeout(12);
  }
  await page.waitForTimeout(300);
  const found = await page.evaluate(() => window.delays);
  await page.keyboard.press("Escape");
  await page.mouse.up();
  await page.waitForTimeout(300);
  return found.sort((a, b) => a - b);
}

/** Frames a second while time passes, and what each takes of the page's thread: time of the processor,
 * which does not count what others do on the machine. */
async function rate(page) {
  const cdp = await page.context().newCDPSession(page);
  await cdp.send("Performance.enable", { timeDomain: "threadTicks" });
  const look = async () => {
    const { metrics } = await cdp.send("Performance.getMetrics");
    const busy = metrics.find(({ name }) => name === "TaskDuration").value;
    return { busy, n: await page.evaluate(() => window.nFrames) };
  };
  await page.click("#play");
  await page.waitForTimeout(1000);
  const before = await look();
  await page.waitForTimeout(SECONDS * 1000);
  const after = await look();
  await page.click("#play");
  const n = after.n - before.n;
  return { rate: n / SECONDS, busy: (1000 * (after.busy - before.busy)) / n };
}

const at = (sorted, share) =>
  sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)];

async function measure(browser, engine, scene, address) {
  const page = await browser.newPage({ viewport: { width: 1200, height: 800 } });
  await page.addInitScript(watch);
  await page.goto(address);
  await settle(page);
  const found = await delays(page, scene);
  const frames = await rate(page);
  await page.close();
  const row = [
    scene.name,
    engine,
    `${found.length}`,
    `${at(found, 0.5)?.toFixed(1)}`,
    `${at(found, 0.95)?.toFixed(1)}`,
    `${scene.goal}`,
    frames.rate.toFixed(0),
    frames.busy.toFixed(1),
  ];
  console.log(`| ${row.join(" | ")} |`);
}

const browser = await chromium.launch({ executablePath: values.chromium, args: ["--no-sandbox"] });
console.log(
  "| scene | engine | moves answered | median, ms | 95 %, ms | goal, ms | frames a second | page, ms a frame |",
);
console.log("|---|---|---|---|---|---|---|---|");
for (const scene of SCENES) {
  const { address, end } = await session(scene.script);
  try {
    await measure(browser, "socket", scene, address);
  } finally {
    end();
  }
  if (values.playground !== undefined) {
    const base = pathToFileURL(resolve(values.playground)).href;
    await measure(browser, "WebAssembly", scene, `${base}#t=${encodeURIComponent(scene.script)}`);
  }
}
await browser.close();
