// Measures the page in a real browser: from a pointer event until the picture that answers it is drawn,
// until the frame has ended that shows it, and how long that takes in a page that only leads an
// element after the pointer; what a move takes of the processor, in the thread of the page and in the
// program; frames a second while time passes.
//
//   node web/page/measure.mjs [--playground web/dist/index.html] [--program target/release/linkwork]
//
// Chromium without a display paints in software; on a machine with one, figures are better.

import { spawn } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";

const ROOT = join(dirname(fileURLToPath(import.meta.url)), "..", "..");

/** Moves of the mouse in a round. */
const N_MOVES = 120;
/** Rounds, each with the bare browser first. */
const N_ROUNDS = 3;
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

/** A page that does nothing but lead an element after the pointer: what the browser itself takes. */
const FLOOR = `<!doctype html><style>
body { margin: 0; height: 100vh }
#led { position: absolute; width: 20px; height: 20px; background: #273542 }
</style><body><div id="led"></div><script>
const led = document.getElementById("led");
addEventListener("pointermove", ({ clientX, clientY }) => {
  led.style.transform = "translate(" + clientX + "px, " + clientY + "px)";
  dispatchEvent(new CustomEvent("led", { detail: { x: clientX, y: clientY } }));
});
</script>`;

const FOLDER = mkdtempSync(join(tmpdir(), "linkwork-floor-"));
const FLOOR_PAGE = join(FOLDER, "floor.html");
writeFileSync(FLOOR_PAGE, FLOOR);

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
  return { address, end, pid: child.pid };
}

/** Notes when the pointer moved, when that was drawn, and when the frame ended that shows it. */
function watch() {
  window.moves = [];
  window.written = [];
  window.shown = [];
  window.nFrames = 0;
  window.nBeats = 0;
  // Some pages hear of moves before the display is about to show something.
  const early = "onpointerrawupdate" in window && window.isSecureContext;
  addEventListener(
    early ? "pointerrawupdate" : "pointermove",
    (event) => window.moves.push({ at: event.timeStamp, x: event.clientX, y: event.clientY }),
    { capture: true },
  );
  // What is drawn before or in the callbacks of a frame is shown by it; what comes after, by the next.
  const ask = window.requestAnimationFrame.bind(window);
  let isInFrame = false;
  const waiting = [];
  const leaving = [];
  const after = new MessageChannel();
  after.port1.onmessage = () => {
    const now = performance.now();
    for (const at of leaving.splice(0)) window.shown.push(now - at);
  };
  const begin = () => {
    leaving.push(...waiting.splice(0));
  };
  window.requestAnimationFrame = (callback) =>
    ask((now) => {
      begin();
      isInFrame = true;
      callback(now);
      isInFrame = false;
    });
  const beat = () => {
    window.nBeats += 1;
    begin();
    after.port2.postMessage(null);
    ask(beat);
  };
  ask(beat);
  /** The thing that is led is at this place now. */
  const drawn = (x, y) => {
    // The newest move that this picture shows; those before it are answered as well.
    const k = window.moves.findLastIndex((move) => Math.hypot(move.x - x, move.y - y) < 0.9);
    if (k < 0) return;
    const { at } = window.moves[k];
    window.written.push(performance.now() - at);
    (isInFrame ? leaving : waiting).push(at);
    window.moves.splice(0, k + 1);
  };
  addEventListener("led", ({ detail }) => drawn(detail.x, detail.y));
  addEventListener(
    "linkwork-painted",
    ({ detail }) => {
      if (detail.seq !== window.painted?.seq) window.nFrames += 1;
      window.painted = detail;
      if (window.grip === undefined) return;
      const { at, scale, centre, width, height } = detail;
      const { left, top } = document.getElementById("canvas").getBoundingClientRect();
      drawn(
        left + width / 2 + (at[2 * window.grip] - centre.x) * scale,
        top + height / 2 - (at[2 * window.grip + 1] - centre.y) * scale,
      );
    },
    { capture: true },
  );
}

async function settle(page) {
  await page.waitForFunction(() => window.painted !== undefined, undefined, { timeout: 120_000 });
  await page.locator('#text:not([aria-busy="true"])').waitFor({ timeout: 120_000 });
  await page.waitForTimeout(1500);
}

/** Where the point is that is led, px. */
async function gripOf(page, scene) {
  await page.fill("#text", `print ${scene.grip}`);
  await page.click("#run");
  await page.waitForTimeout(500);
  const [x, y] = (await page.textContent("#answer")).match(/-?[\d.e-]+/g).map(Number);
  return page.evaluate(
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
}

/** Leads the mouse round; gives how long it took until each move was drawn, and was shown. */
async function lead(page, start, reach) {
  await page.bringToFront();
  await page.mouse.move(start.x, start.y);
  await page.mouse.down();
  await page.mouse.move(start.x + 6, start.y);
  await page.waitForTimeout(300);
  await page.evaluate(() => {
    window.moves = [];
    window.written = [];
    window.shown = [];
  });
  for (let k = 0; k < N_MOVES; k++) {
    const phi = (k / 60) * 2 * Math.PI;
    const radius = 30 * reach;
    await page.mouse.move(start.x + radius * Math.cos(phi), start.y + radius * Math.sin(phi));
    // A hand knows nothing of the display's frames.
    await page.waitForTimeout(8 + 16 * Math.random());
  }
  await page.waitForTimeout(300);
  const found = await page.evaluate(() => ({ written: window.written, shown: window.shown }));
  await page.keyboard.press("Escape");
  await page.mouse.up();
  await page.waitForTimeout(300);
  return found;
}

/** Tells how long the page's thread has been busy, ms: time of the processor, which does not count what others
 * do on the machine. */
async function clockOf(page) {
  const cdp = await page.context().newCDPSession(page);
  await cdp.send("Performance.enable", { timeDomain: "threadTicks" });
  return async () => {
    const { metrics } = await cdp.send("Performance.getMetrics");
    return 1000 * metrics.find(({ name }) => name === "TaskDuration").value;
  };
}

/** The same of a program, where the system says it; of a worker it cannot be told. */
function busyOf(pid) {
  try {
    const threads = readdirSync(`/proc/${pid}/task`);
    const times = threads.map((it) => readFileSync(`/proc/${pid}/task/${it}/schedstat`, "utf8"));
    return times.reduce((sum, time) => sum + Number(time.split(" ")[0]) / 1e6, 0);
  } catch {
    return Number.NaN;
  }
}

/** Frames a second while time passes, how many the display could have shown, and what each takes of the page's
 * thread. */
async function rate(page, busy) {
  const look = async () => ({
    busy: await busy(),
    n: await page.evaluate(() => window.nFrames),
    beats: await page.evaluate(() => window.nBeats),
  });
  await page.click("#play");
  await page.waitForTimeout(1000);
  const before = await look();
  await page.waitForTimeout(SECONDS * 1000);
  const after = await look();
  await page.click("#play");
  const n = after.n - before.n;
  const display = (after.beats - before.beats) / SECONDS;
  return { rate: n / SECONDS, display, busy: (after.busy - before.busy) / n };
}

function percentile(found, share) {
  const sorted = found.toSorted((a, b) => a - b);
  return sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)] ?? Number.NaN;
}

/** The median and what one in twenty is beyond. */
const told = (found) => [0.5, 0.95].map((share) => percentile(found, share).toFixed(1));

async function measure(browser, engine, scene, address, pid) {
  const context = await browser.newContext({ viewport: { width: 1200, height: 800 } });
  await context.addInitScript(watch);
  const floor = await context.newPage();
  await floor.goto(pathToFileURL(FLOOR_PAGE).href);
  const page = await context.newPage();
  await page.goto(address);
  await settle(page);
  const start = await gripOf(page, scene);
  const found = { written: [], shown: [], floor: [] };
  const busy = await clockOf(page);
  const taken = { page: 0, engine: 0 };
  // In turn, so that what others do on the machine is the same for both.
  for (let round = 0; round < N_ROUNDS; round++) {
    const bare = await lead(floor, start, scene.reach);
    found.floor.push(...bare.shown);
    const [page0, engine0] = [await busy(), busyOf(pid)];
    const ours = await lead(page, start, scene.reach);
    taken.page += ((await busy()) - page0) / (N_ROUNDS * N_MOVES);
    taken.engine += (busyOf(pid) - engine0) / (N_ROUNDS * N_MOVES);
    found.written.push(...ours.written);
    found.shown.push(...ours.shown);
  }
  const frames = await rate(page, busy);
  await context.close();
  const row = [
    scene.name,
    engine,
    `${found.written.length}`,
    ...told(found.written),
    `${scene.goal}`,
    ...told(found.shown),
    ...told(found.floor),
    taken.page.toFixed(1),
    Number.isNaN(taken.engine) ? "–" : taken.engine.toFixed(1),
    frames.rate.toFixed(0),
    frames.display.toFixed(0),
    frames.busy.toFixed(1),
  ];
  console.log(`| ${row.join(" | ")} |`);
}

const browser = await chromium.launch({ executablePath: values.chromium, args: ["--no-sandbox"] });
const COLUMNS =
  "scene | engine | moves | drawn, ms | 95 % | goal | shown, ms | 95 % | floor, ms | 95 % | page, ms a move | program, ms a move | frames a second | display | page, ms a frame";
console.log(`| ${COLUMNS} |`);
console.log(`|${COLUMNS.replaceAll(/[^|]+/g, "---")}|`);
for (const scene of SCENES) {
  const { address, end, pid } = await session(scene.script);
  try {
    await measure(browser, "socket", scene, address, pid);
  } finally {
    end();
  }
  if (values.playground !== undefined) {
    const base = pathToFileURL(resolve(values.playground)).href;
    await measure(browser, "WebAssembly", scene, `${base}#t=${encodeURIComponent(scene.script)}`);
  }
}
await browser.close();
rmSync(FOLDER, { recursive: true, force: true });
