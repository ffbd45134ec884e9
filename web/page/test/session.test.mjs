// The page at a session: what the mouse does is text, and what is typed is seen.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import * as s from "./support.mjs";

const FOUR_BAR = `point A = (0, 0) frozen, D = (4, 0) frozen
point B = (1, 0), C = (3, 3)
crank: motor A B radius 1 speed 1rev
coupler: length B C = 3.5
rocker: length C D = 3
`;
// Handles in the order in which points are made.
const [D, B, C] = [1, 2, 3];

/** Two links and a free end. */
const ARM = `point A = (0, 0) frozen
point B = (2, 0), C = (3, 1)
length A B = 2
length B C = 1.5
`;

after(s.closeBrowser);

test("a frozen point goes where the mouse is, and the mechanism with it", async (t) => {
  const session = await s.session(t, FOUR_BAR);
  const page = await s.openAt(t, session.address);
  await s.drag(page, { x: 4, y: 0 }, { x: 4.5, y: -0.5 });
  const statement = await s.written(page, /^drag D/);
  assert.match(statement, /^drag D (to|through) .* over 0$/);
  const end = await s.place(page, D);
  s.near(end, { x: 4.5, y: -0.5 }, 0.02);
  const [b, c] = [await s.place(page, B), await s.place(page, C)];
  assert.ok(
    Math.abs(Math.hypot(c.x - b.x, c.y - b.y) - 3.5) < 1e-9,
    "the coupler keeps its length",
  );
  assert.ok(
    Math.abs(Math.hypot(c.x - end.x, c.y - end.y) - 3) < 1e-9,
    "the rocker keeps its length",
  );
  // The pose that the prompt tells is the one on the screen, to the last digit.
  assert.equal(await s.tell(page, "print D, C"), `(${end.x}, ${end.y}) (${c.x}, ${c.y})`);
  // One gesture is one step of undo.
  await s.tell(page, "undo");
  await s.until(async () => (await s.place(page, D)).x === 4, "undo brings the point back");
  s.near(await s.place(page, D), { x: 4, y: 0 });
});

test("what a gesture wrote brings the same bits", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address);
  await s.drag(page, { x: 2, y: 0 }, { x: 1, y: 1.5 }, { x: -1, y: 1 });
  const statement = await s.written(page, /^pull B/);
  await s.drag(page, await s.place(page, 0), { x: 0.5, y: 0.5 });
  const second = await s.written(page, /^drag A/);
  const saved = (await s.download(page, "script")).bytes.toString();
  writeFileSync(
    join(session.cwd, "again.link"),
    `${ARM}${statement}\n${second}\nsave "again-saved.link"\n`,
  );
  const { status, err } = s.run(["run", "again.link", "--out", session.cwd], session.cwd);
  assert.equal(status, 0, err);
  assert.equal(saved, readFileSync(join(session.cwd, "again-saved.link"), "utf8"));
});

test("a loose point is pulled and nothing tears", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address);
  // Far out of reach.
  await s.drag(page, { x: 3, y: 1 }, { x: 3, y: 0.5 }, { x: 3.4, y: -0.4 });
  await s.written(page, /^pull C/);
  const [a, b, c] = [await s.place(page, 0), await s.place(page, 1), await s.place(page, 2)];
  assert.ok(Math.abs(Math.hypot(b.x - a.x, b.y - a.y) - 2) < 1e-9);
  assert.ok(Math.abs(Math.hypot(c.x - b.x, c.y - b.y) - 1.5) < 1e-9);
});

test("Escape takes a gesture back", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address);
  const from = await s.screen(page, { x: 3, y: 1 });
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x - 60, from.y - 40, { steps: 4 });
  await s.until(async () => Math.abs((await s.place(page, 2)).x - 3) > 0.05, "the point moves");
  await page.keyboard.press("Escape");
  await s.until(async () => (await s.place(page, 2)).x === 3, "the point is back");
  await page.mouse.up();
  assert.deepEqual(
    (await s.journal(page)).filter((line) => line.startsWith("pull")),
    [],
  );
});

test("a double click freezes and thaws", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address);
  await s.click(page, { x: 3, y: 1 }, { count: 2 });
  await s.written(page, /^freeze C$/);
  await page.waitForTimeout(400);
  await s.click(page, { x: 3, y: 1 }, { count: 2 });
  await s.written(page, /^thaw C$/);
});

test("a click on a point offers what can be done with it", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address);
  await s.click(page, { x: 2, y: 0 });
  const menu = page.getByRole("dialog", { name: "Point B" });
  await menu.getByRole("button", { name: "Trace", exact: true }).click();
  await s.written(page, /^trace B$/);
  await menu.getByRole("checkbox", { name: "length2 is on" }).click();
  await s.written(page, /^off length2$/);
  await menu.getByRole("button", { name: "Delete", exact: true }).click();
  await s.written(page, /^delete B cascade$/);
  assert.match(await s.tell(page, "list points"), /A/);
});

test("a point is called otherwise on its card", async (t) => {
  const session = await s.session(t, `${ARM}trace C\n`);
  const page = await s.openAt(t, session.address);
  await page.focus("#canvas");
  for (let k = 0; k < 3; k++) await page.keyboard.press(".");
  await page.keyboard.press("Enter");
  // By keys alone: the name is the first that Tab comes to.
  await page.keyboard.press("Tab");
  const name = page.getByRole("dialog", { name: "Point C" }).getByLabel("Name");
  assert.equal(await name.inputValue(), "C");
  // A name that is taken gets the words of the prompt and stays, to be mended.
  await page.keyboard.type("B");
  await page.keyboard.press("Enter");
  await page.locator("#answer").getByText("`B` is a point already").waitFor();
  const { err } = s.run(["-e", "point B = (1, 1), C = (1, 2)", "-e", "rename C to B"], session.cwd);
  const withoutPlaces = (text) => text.replace(/-->.*$/m, "-->").trim();
  const said = withoutPlaces(await page.textContent("#answer"));
  assert.equal(said, withoutPlaces(err.slice(err.indexOf("error"))));
  assert.match(said, /\^/);
  assert.equal(await name.getAttribute("aria-invalid"), "true");
  assert.equal(await name.inputValue(), "B");
  // Escape gives up what was typed.
  await page.keyboard.press("Escape");
  assert.equal(await name.inputValue(), "C");
  await name.fill("hand");
  await page.keyboard.press("Enter");
  await s.written(page, /^rename C to hand$/);
  const menu = page.getByRole("dialog", { name: "Point hand" });
  await menu.getByText("length B hand = 1.5").waitFor();
  await menu.getByRole("button", { name: "End path" }).click();
  await s.written(page, /^untrace hand$/);
  await page.keyboard.press("Escape");
  await menu.waitFor({ state: "hidden" });
  // What is typed counts when the card is left, too.
  await s.click(page, { x: 2, y: 0 });
  await page.getByRole("dialog", { name: "Point B" }).getByLabel("Name").fill("elbow");
  await s.click(page, { x: 1, y: 0.5 });
  await s.written(page, /^rename B to elbow$/);
  assert.equal(await s.tell(page, "undo; distance(A, B)"), "note: undid `rename B to elbow`\n2");
});

test("values, motors and settings are statements", async (t) => {
  const session = await s.session(t, `let r = 3.5\n${FOUR_BAR.replace("= 3.5", "= r")}`);
  const page = await s.openAt(t, session.address);
  await page.getByLabel("rho", { exact: true }).fill("0.25");
  await page.getByLabel("rho", { exact: true }).press("Enter");
  await s.written(page, /^set rho 0.25$/);
  await page.getByLabel("method", { exact: true }).selectOption("newton");
  await s.written(page, /^set method newton$/);
  await page.getByLabel("r", { exact: true }).fill("4");
  await page.getByLabel("r", { exact: true }).press("Enter");
  await s.written(page, /^let r = 4$/);
  await page.getByLabel("speed of crank", { exact: true }).fill("2rev");
  await page.getByLabel("speed of crank", { exact: true }).press("Enter");
  await s.written(page, /^change crank speed 2rev$/);
  await page.getByRole("checkbox", { name: "crank is on" }).click();
  await s.written(page, /^off crank$/);
  // A slider is tried on its way and is one statement in the end.
  const slider = page.getByLabel("r, slider");
  await slider.focus();
  for (let k = 0; k < 5; k++) await page.keyboard.press("ArrowRight");
  await slider.blur();
  const last = await s.until(async () => {
    const lines = (await s.journal(page)).filter((line) => line.startsWith("let r"));
    return lines.length >= 2 && lines;
  }, "the slider's statement is in the journal");
  assert.match(last.at(-1), /^let r = 4\.\d+$/);
});

test("a slider that nothing follows says so", async (t) => {
  const script = "let n = 2, r = 3\nfor i in 1..n { point P[i] = (i, 0) }\nlength P[1] P[2] = r\n";
  const session = await s.session(t, script);
  const page = await s.openAt(t, session.address);
  assert.equal(await page.getByLabel("r, slider").isEnabled(), true);
  assert.equal(await page.getByLabel("n, slider").isEnabled(), false);
  assert.match(await page.getByLabel("n, slider").getAttribute("title"), /Nothing follows it/);
  await s.tell(page, "length P[1] P[2] <= 2 * n");
  await s.until(() => page.getByLabel("n, slider").isEnabled(), "it is followed now");
});

test("ten thousand bars are shown, and one of them is dragged", async (t) => {
  const script = `for i in 0..99 { for k in 0..99 {
    point a[i][k] = (i, k) frozen, b[i][k] = (i + 0.7, k + 0.3); length a[i][k] b[i][k]
  } }\n`;
  const session = await s.session(t, script);
  const page = await s.openAt(t, session.address);
  const size = await page.evaluate(() => ({
    points: window.painted.at.length / 2,
    scale: window.painted.scale,
  }));
  assert.equal(size.points, 20_000);
  // Near enough that points are apart.
  const middle = await s.screen(page, { x: 50.7, y: 50.3 });
  await page.mouse.move(middle.x, middle.y);
  for (let k = 0; k < 8; k++) await page.mouse.wheel(0, -300);
  await page.waitForFunction((scale) => window.painted.scale > 5 * scale, size.scale, {
    timeout: s.PATIENCE,
  });
  await page.waitForTimeout(1500);
  await s.drag(page, { x: 50.7, y: 50.3 }, { x: 50.4, y: 50.6 });
  await s.written(page, /^pull b\[50\]\[50\] (to|through) /);
});

test("a mistake has the words and the caret of the prompt", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address);
  const wrong = "length A Q = 3";
  const inBox = await s.tell(page, wrong);
  const { err } = s.run(
    ["-e", "point A = (0, 0), B = (1, 1), C = (1, 2)", "-e", wrong],
    session.cwd,
  );
  const withoutPlaces = (text) => text.replace(/-->.*$/m, "-->").trim();
  assert.match(inBox, /\^/);
  assert.equal(withoutPlaces(inBox), withoutPlaces(err.slice(err.indexOf("error"))));
  // What is wrong is marked in the box, and still there to be mended.
  assert.equal(await page.inputValue("#text"), wrong);
  const marked = await page.$eval("#text", (box) =>
    box.value.slice(box.selectionStart, box.selectionEnd),
  );
  assert.equal(marked, "Q");
});

test("what cannot be met is red, with its error", async (t) => {
  const session = await s.session(
    t,
    "point A = (0, 0) frozen, B = (4, 0) frozen, C = (2, 1)\nlength A C = 1\nlength C B = 1\nsolve\n",
  );
  const page = await s.openAt(t, session.address);
  const rows = page.locator(".off-by");
  await s.until(async () => (await rows.count()) === 2, "both rods are listed");
  // Nearest is the middle, where each of two rods of 1 is 2 long.
  for (const text of await rows.allTextContents()) assert.match(text, /^length\d.*1(\.0*)?$/);
  await page
    .locator("#verdict")
    .getByText(/off by/)
    .waitFor();
  const reds = await page.evaluate(() => {
    const canvas = document.getElementById("canvas");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let n = 0;
    for (let k = 0; k < data.length; k += 4)
      if (data[k] > 140 && data[k + 1] < 80 && data[k + 2] < 80) n += 1;
    return n;
  });
  assert.ok(reds > 300, `${reds} red pixels`);
});

test("the largest residual is that of the last picture", async (t) => {
  const session = await s.session(t, `${ARM}solve\n`);
  const page = await s.openAt(t, session.address);
  const fact = page.locator(".fact", { hasText: "largest residual" });
  const shown = async () => Number(/residual(.*)/.exec(await fact.textContent())?.[1]);
  for (let k = 0; k < 3; k++) {
    // One picture soon after the other.
    await s.tell(page, "move B to (9, 9)");
    await s.tell(page, "undo");
    await s.until(async () => (await shown()) < 1e-9, "it holds again");
  }
  await s.tell(page, "move B to (9, 9)");
  await s.until(async () => (await shown()) > 0.1, "it is off");
});

test("two pages show one session, and the prompt is a third", async (t) => {
  const session = await s.session(t, ARM);
  const [one, two] = [await s.openAt(t, session.address), await s.openAt(t, session.address)];
  await s.drag(one, { x: 3, y: 1 }, { x: 2.5, y: 1.2 });
  const statement = await s.written(one, /^pull C/);
  assert.equal(await s.written(two, /^pull C/), statement);
  await s.until(async () => {
    const [a, b] = [await s.place(one, 2), await s.place(two, 2)];
    return a.x === b.x && a.y === b.y;
  }, "both show the same pose");
  session.type("point N = (1, 2)");
  await s.written(one, /point N = \(1, 2\)/);
  await s.written(two, /point N = \(1, 2\)/);
});

test("a page that does not look holds nobody up", async (t) => {
  const session = await s.session(t, FOUR_BAR);
  const page = await s.openAt(t, session.address);
  // A second client that takes frames and never says that it has seen one.
  const slow = await s.openAt(t, session.address);
  await slow.evaluate(() => {
    window.nFrames = 0;
    const address = new URL("ws", location.href);
    address.protocol = "ws:";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => socket.send(JSON.stringify({ do: "hello", protocol: 1 }));
    socket.onmessage = ({ data }) => {
      if (typeof data !== "string") window.nFrames += 1;
    };
  });
  await page.click("#play");
  const begin = await page.evaluate(() => window.painted.time);
  await s.until(
    async () => (await page.evaluate(() => window.painted.time)) > begin + 0.5,
    "time passes",
  );
  await page.click("#play");
  assert.ok((await slow.evaluate(() => window.nFrames)) <= 3, "a slow client drops frames");
});

test("a lost connection says so and comes back", async (t) => {
  const cwd = s.folder(t);
  const args = ["--port", String(await s.freePort())];
  const session = await s.session(t, ARM, { cwd, args });
  const page = await s.openAt(t, session.address);
  await session.stop();
  const notice = page.locator("#connection");
  await notice.getByText(/trying to reach it again/).waitFor({ timeout: s.PATIENCE });
  const again = await s.session(t, FOUR_BAR, { cwd, args });
  assert.equal(again.address, session.address, "who says the port gets the same address again");
  await s.until(async () => (await notice.textContent()) === "", "the page is back");
  await s.until(
    async () => (await page.evaluate(() => window.painted.at.length)) === 8,
    "it shows the new scene",
  );
  assert.equal(await s.tell(page, "distance(A, D)"), "4");
});

test("the script of a page runs again to the same bits", async (t) => {
  const session = await s.session(t, `${FOUR_BAR}trace C\nset dt 1/100\n`);
  const page = await s.openAt(t, session.address);
  await s.tell(page, "step 37");
  await s.drag(page, await s.place(page, D), { x: 4.4, y: 0.3 });
  await s.written(page, /^drag D/);
  const { name, bytes } = await s.download(page, "script");
  assert.match(name, /\.link$/);
  writeFileSync(join(session.cwd, "taken.link"), bytes);
  const { status, err } = s.run(
    ["run", "taken.link", "-e", 'save "again.link"', "--out", session.cwd],
    session.cwd,
  );
  assert.equal(status, 0, err);
  assert.deepEqual(readFileSync(join(session.cwd, "again.link")), bytes);
});

test("pictures, animations and numbers can be taken home", async (t) => {
  const session = await s.session(t, `${FOUR_BAR}trace C\n`);
  const page = await s.openAt(t, session.address);
  const svg = (await s.download(page, "svg")).bytes.toString();
  assert.match(svg, /^<svg class="linkwork"/);
  await page.fill("#frames", "30");
  const animation = (await s.download(page, "animation")).bytes.toString();
  assert.match(animation, /<animate/);
  const csv = (await s.download(page, "csv")).bytes.toString().trim().split("\n");
  // A heading and a row a frame.
  assert.equal(csv.length, 31);
  assert.equal(await s.tell(page, "time"), "0", "none of it lets time pass");
});

test("what is drawn with the mouse is written", async (t) => {
  const session = await s.session(t, "point A = (-2, -1) frozen, Z = (2, 1)\n");
  const page = await s.openAt(t, session.address);
  const take = (name) =>
    page
      .getByRole("toolbar", { name: "What the mouse does" })
      .getByRole("button", { name })
      .click();
  await take("Point");
  await s.click(page, { x: 0, y: 0.5 });
  await s.written(page, /^point B = \(.*\)$/);
  await take("Rod");
  await s.drag(page, await s.place(page, 0), await s.place(page, 2));
  await s.written(page, /^length A B$/);
  await take("Motor");
  await s.drag(page, { x: 1.5, y: -0.8 }, { x: 1.9, y: -0.8 });
  await s.written(page, /^motor C D speed 1rev$/);
  await take("Glider");
  await s.click(page, { x: -1, y: -0.25 });
  await s.written(page, /^glider E on A B$/);
  await take("Hinge");
  await s.click(page, { x: -0.6, y: 0.05 });
  await s.written(page, /^hinge F on A B at 0\.\d+$/);
  const lines = await s.journal(page);
  assert.ok(
    lines.some((line) => /^point C = .* frozen/.test(line)),
    "the centre of a motor is frozen",
  );
});

test("all can be done by keys", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address);
  await page.focus("#canvas");
  for (let k = 0; k < 3; k++) await page.keyboard.press(".");
  assert.match(await page.textContent("#spoken"), /^C, loose/);
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("ArrowLeft");
  await s.written(page, /^pull C/);
  await page.keyboard.press("f");
  await s.written(page, /^freeze C$/);
  await page.keyboard.press("u");
  await page.keyboard.press("s");
  await s.written(page, /^step/);
  await page.keyboard.press("/");
  await page.keyboard.type("point K = (0, 1)");
  await page.keyboard.press("Escape");
  await page.focus("#text");
  await page.keyboard.press("Enter");
  await s.written(page, /^point K/);
});

test("fingers drag a point, two of them move the view", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address);
  const touch = await page.context().newCDPSession(page);
  const fingers = (type, ...touchPoints) =>
    touch.send("Input.dispatchTouchEvent", { type, touchPoints });
  const { x, y } = await s.screen(page, { x: 3, y: 1 });
  // Beside the point, as fingers are.
  await fingers("touchStart", { x: x + 14, y: y + 10, id: 1 });
  for (let k = 1; k <= 6; k++) await fingers("touchMove", { x: x - 10 * k, y: y - 5 * k, id: 1 });
  await fingers("touchEnd");
  await s.written(page, /^pull C/);
  const before = await page.evaluate(() => window.painted.scale);
  await fingers("touchStart", { x: 300, y: 420, id: 1 }, { x: 400, y: 420, id: 2 });
  for (let k = 1; k <= 5; k++) {
    await fingers(
      "touchMove",
      { x: 300 - 10 * k, y: 420, id: 1 },
      { x: 400 + 10 * k, y: 420, id: 2 },
    );
  }
  await fingers("touchEnd");
  await s.until(async () => {
    const ratio = (await page.evaluate(() => window.painted.scale)) / before;
    return Math.abs(ratio - 2) < 0.05;
  }, "fingers twice as far apart make it twice as large");
});

test("nothing lies over a button, or over the mechanism", async (t) => {
  const session = await s.session(t, ARM);
  for (const [width, height] of [
    [1200, 800],
    [400, 800],
    [360, 640],
    [800, 400],
  ]) {
    const page = await s.openAt(t, session.address, { width, height, touch: true });
    const hidden = await page.$$eval("#stage :is(button, select)", (buttons) => {
      const isSeen = (button, share) => {
        const { left, top, width, height } = button.getBoundingClientRect();
        const found = document.elementFromPoint(left + share * width, top + height / 2);
        return button.contains(found);
      };
      const hidden = buttons.filter((it) => ![0.1, 0.9].every((share) => isSeen(it, share)));
      return hidden.map((button) => button.getAttribute("aria-label"));
    });
    assert.deepEqual(hidden, [], `${width} x ${height}`);
    for (const handle of [0, 1, 2]) {
      const { x, y } = await s.screen(page, await s.place(page, handle));
      const id = await page.evaluate(([x, y]) => document.elementFromPoint(x, y)?.id, [x, y]);
      assert.equal(id, "canvas", `point ${handle} on ${width} x ${height}`);
    }
  }
});

test("a pointer that only passes by leads nothing", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address);
  const from = await s.screen(page, { x: 3, y: 1 });
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x - 40, from.y, { steps: 4 });
  await page.evaluate(
    ([clientX, clientY]) => {
      const event = { pointerId: 77, pointerType: "pen", clientX, clientY, bubbles: true };
      for (const name of ["pointerrawupdate", "pointermove"])
        document.getElementById("canvas").dispatchEvent(new PointerEvent(name, event));
    },
    Object.values(await s.screen(page, { x: 0, y: -2 })),
  );
  await page.mouse.up();
  const statement = await s.written(page, /^pull C/);
  const ys = [...statement.matchAll(/, (-?[\d.]+)\)/g)].map(([, y]) => Number(y));
  assert.ok(ys.length > 0 && ys.every((y) => Math.abs(y - 1) < 0.1), statement);
});

test("Enter carries out what is there, however slowly the session answers", async (t) => {
  const session = await s.session(t, ARM);
  // A session that is asked what may stand here is a while about it.
  const page = await s.openAt(t, session.address, {
    before: () => {
      const send = WebSocket.prototype.send;
      WebSocket.prototype.send = function (message) {
        setTimeout(() => send.call(this, message), 150);
      };
    },
  });
  await page.focus("#text");
  await page.keyboard.type("point K = (0, 1)");
  await page.keyboard.press("Enter");
  await s.written(page, /^point K/);
  await page.keyboard.type("for i in 1..2 {");
  await page.keyboard.press("Enter");
  await s.until(async () => (await page.inputValue("#text")).endsWith("{\n"), "the line goes on");
});

test("places that a slow engine has not come to are left out, all but the last", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address, {
    before: () => {
      window.nMoves = 0;
      const send = WebSocket.prototype.send;
      WebSocket.prototype.send = function (message) {
        const isMove = message.includes('"do":"move"');
        if (isMove) window.nMoves += 1;
        // What is sent takes its time, and keeps its order.
        setTimeout(() => send.call(this, message), 300);
      };
    },
  });
  const from = await s.screen(page, { x: 3, y: 1 });
  const to = await s.screen(page, { x: 2.5, y: 1.4 });
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  for (let k = 1; k <= 40; k++) {
    const share = k / 40;
    await page.mouse.move(from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share);
  }
  await page.mouse.up();
  const statement = await s.written(page, /^pull C/);
  const [x, y] = statement
    .match(/-?[\d.]+/g)
    .slice(-3, -1)
    .map(Number);
  s.near({ x, y }, { x: 2.5, y: 1.4 }, 0.01);
  const begun = statement.match(/\(/g).length;
  assert.equal(await page.evaluate(() => window.nMoves), begun, "each that was sent was led to");
  assert.ok(begun < 30, `${begun} places`);
});

test("the box completes", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.openAt(t, session.address);
  await page.focus("#text");
  await page.keyboard.type("orien");
  await page.locator("#offers li").first().waitFor();
  await page.keyboard.press("Tab");
  assert.match(await page.inputValue("#text"), /^orientation/);
});

test("time passes, stands and goes back", async (t) => {
  const session = await s.session(t, FOUR_BAR);
  const page = await s.openAt(t, session.address);
  await page.click("#play");
  await s.until(async () => (await page.evaluate(() => window.painted.time)) > 0.1, "time passes");
  await page.click("#play");
  const line = await s.written(page, /^step \d+$/);
  const [, n] = /^step (\d+)$/.exec(line);
  assert.equal(await s.tell(page, "round(time * 60)"), n, "what passed is what is written");
  await page.getByRole("button", { name: "Reset" }).click();
  await s.written(page, /^reset$/);
  await s.until(async () => (await page.evaluate(() => window.painted.time)) === 0, "time is 0");
});

test("what is dragged while time passes says how many frames went by", async (t) => {
  const session = await s.session(t, FOUR_BAR);
  const page = await s.openAt(t, session.address);
  await page.click("#play");
  await s.until(async () => (await page.evaluate(() => window.painted.time)) > 0, "time passes");
  await s.drag(page, { x: 4, y: 0 }, { x: 4.2, y: 0.2 }, { x: 4.4, y: 0 });
  const line = await s.written(page, /^drag D/);
  await page.click("#play");
  assert.match(line, / over [1-9]\d*$/);
  await s.until(
    async () => (await page.getAttribute("#play", "aria-label")) === "Play",
    "time stands",
  );
  // What the journal says, frame for frame, comes to the same bits.
  const lines = (await s.journal(page)).join("\n");
  const saved = (await s.download(page, "script")).bytes;
  writeFileSync(join(session.cwd, "again.link"), `${FOUR_BAR}${lines}\nsave "saved.link"\n`);
  const { status, err } = s.run(["run", "again.link", "--out", session.cwd], session.cwd);
  assert.equal(status, 0, err);
  assert.equal(saved.toString(), readFileSync(join(session.cwd, "saved.link"), "utf8"));
});

test("a browser without sockets gets a sentence", async (t) => {
  const session = await s.session(t, ARM);
  const page = await s.open(t, session.address, { before: () => delete window.WebSocket });
  await page.getByText(/WebSocket, and this browser has none/).waitFor();
});

for (const width of [1200, 400]) {
  test(`at ${width} px nothing is cut off and no text is below 12 px`, async (t) => {
    const session = await s.session(t, `let r = 3\n${FOUR_BAR}`);
    const page = await s.openAt(t, session.address, { width });
    const found = await page.evaluate(() => {
      const small = [];
      const outside = [];
      for (const element of document.querySelectorAll("#app *")) {
        const { width, right } = element.getBoundingClientRect();
        if (width === 0) continue;
        if (right > innerWidth + 1) outside.push(element.outerHTML.slice(0, 80));
        if (Number.parseFloat(getComputedStyle(element).fontSize) < 12)
          small.push(element.outerHTML.slice(0, 80));
      }
      return { small, outside, scroll: document.documentElement.scrollWidth - innerWidth };
    });
    assert.deepEqual(found, { small: [], outside: [], scroll: 0 });
  });
}
