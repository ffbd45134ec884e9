// Parts of the page that need no browser.

import assert from "node:assert/strict";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const SOURCES = join(dirname(fileURLToPath(import.meta.url)), "..", "src");

async function part(name) {
  const result = await build({
    entryPoints: [join(SOURCES, name)],
    bundle: true,
    write: false,
    format: "esm",
  });
  const source = Buffer.from(result.outputFiles[0].contents).toString("base64");
  return import(`data:text/javascript;base64,${source}`);
}

test("numbers are typed as finely as a pixel tells", async () => {
  const { typed } = await part("camera.ts");
  for (const [value, scale, wanted] of [
    [1.23456, 100, "1.23"],
    [0.1 + 0.2, 10, "0.3"],
    [-0.0001, 100, "0"],
    [123456, 0.001, "123000"],
    [1.5e-7, 1e9, "1.5e-7"],
    [2, 1, "2"],
  ]) {
    assert.equal(typed(value, scale), wanted, `${value} at ${scale} px a unit`);
  }
  // Whatever the scale, what is typed is no farther off than a pixel.
  for (let power = -12; power <= 12; power++) {
    const scale = 3.7 * 10 ** power;
    for (const value of [Math.PI / scale, 12345.678 / scale, -987.6 / scale]) {
      assert.ok(Math.abs(Number(typed(value, scale)) - value) * scale <= 1, `${value} at ${scale}`);
    }
  }
});

test("the plane and the canvas are one another's inverse, and zooming keeps a place", async () => {
  const { Camera } = await part("camera.ts");
  const camera = new Camera(37, { x: 3, y: -2 }, 640, 480, 2).zoomed(1.7, { x: 100, y: 50 });
  const there = new Camera(37, { x: 3, y: -2 }, 640, 480, 2).toPlane({ x: 100, y: 50 });
  const again = camera.toPlane({ x: 100, y: 50 });
  assert.ok(Math.hypot(there.x - again.x, there.y - again.y) < 1e-12);
  const back = camera.toCanvas(camera.toPlane({ x: 7, y: 9 }));
  assert.ok(Math.hypot(back.x - 7, back.y - 9) < 1e-9);
});

test("what is fitted is on the canvas, whatever its size", async () => {
  const { Camera } = await part("camera.ts");
  for (const size of [1e-9, 1, 1e9]) {
    for (const [width, height] of [
      [1200, 800],
      [300, 240],
    ]) {
      const corners = [
        { x: -size, y: 0 },
        { x: 2 * size, y: size },
      ];
      const camera = new Camera(1, { x: 0, y: 0 }, width, height).fitted({
        lo: corners[0],
        hi: corners[1],
      });
      for (const corner of corners) {
        const { x, y } = camera.toCanvas(corner);
        assert.ok(x > 10 && x < width - 10 && y > 10 && y < height - 10, `${x}, ${y}`);
      }
    }
  }
});

test("a typed value is a number with a unit, or neither", async () => {
  const { quantity } = await part("panels/value_row.ts");
  assert.deepEqual(quantity("90deg"), { number: 90, unit: "deg" });
  assert.deepEqual(quantity("-.5rev"), { number: -0.5, unit: "rev" });
  assert.deepEqual(quantity("1e-3"), { number: 0.001, unit: "" });
  assert.deepEqual(quantity("250ms"), { number: 250, unit: "ms" });
  for (const other of ["2 * r", "1/60", "(1, 2)", "r", "", "3 m"])
    assert.equal(quantity(other), undefined, other);
});

test("a script comes back from an address", async () => {
  const { packed, wanted } = await part("share.ts");
  const script = 'point A = (0, 0)\nprint "Übergröße ∞ 𝕏"\n'.repeat(50);
  const hash = `#${await packed(script)}`;
  assert.ok(hash.length < script.length / 4, "it is packed");
  assert.match(hash, /^#z=[\w-]+$/);
  assert.deepEqual(await wanted(hash), { is: "script", text: script });
  assert.deepEqual(await wanted("#t=a%3B%20b"), { is: "script", text: "a; b" });
  assert.deepEqual(await wanted("#example=klann"), { is: "example", name: "klann" });
  assert.equal(await wanted("#else"), undefined);
  await assert.rejects(wanted("#z=nonsense"));
});

test("texts of any length fit into messages and come out whole", async () => {
  const { pieces } = await part("engine/pieces.ts");
  for (const text of [
    "",
    "a",
    "x".repeat(5000),
    "\u0001".repeat(2000),
    "𝕏".repeat(1999),
    "a\ud835",
  ]) {
    const parts = pieces(text);
    assert.equal(parts.join(""), text);
    for (const piece of parts) {
      const message = JSON.stringify({ do: "exec", text: piece, more: true, id: 123456 });
      assert.ok(Buffer.byteLength(message) <= 4096, `${Buffer.byteLength(message)} bytes`);
      assert.ok(!/^[\udc00-\udfff]/.test(piece), "a letter is not cut");
    }
  }
});

test("a path that is begun anew is not the one before", async () => {
  const { Traces } = await part("engine/traces.ts");
  const traces = new Traces();
  const versions = new Set();
  const told = (update, n = 1) => {
    const head = { trace: 0, point: 0, name: "A", class: "trace-0", colour: "#000" };
    traces.update([{ ...head, from: 0, at: [0, 0, 1, 1], missed: [], ...update }], n);
    return traces.list[0].version;
  };
  const isNew = (version) => versions.size < versions.add(version).size;
  assert.ok(isNew(told({})));
  assert.ok(!isNew(told({ from: 2, at: [2, 2] })), "one that goes on stays");
  assert.ok(isNew(told({ from: 1 })), "samples were taken away");
  assert.ok(isNew(told({ from: 3, colour: "#fff" })), "another colour");
  // A session that begins, and a path that was taken away before.
  traces.list.length = 0;
  assert.ok(isNew(told({})));
  traces.update([], 0);
  assert.ok(isNew(told({})));
});

test("a frame is read, and what is none is not", async () => {
  const { readFrame } = await part("engine/protocol.ts");
  const buffer = new ArrayBuffer(24 + 16 * 2 + 16);
  const view = new DataView(buffer);
  view.setBigUint64(0, 7n, true);
  view.setUint32(8, 5, true);
  view.setFloat64(12, 0.25, true);
  view.setFloat32(20, 0.5, true);
  [1, 2, 3, 4].forEach((number, k) => {
    view.setFloat64(24 + 8 * k, number, true);
  });
  view.setUint32(56, 2, true);
  [10, 20, 90].forEach((number, k) => {
    view.setFloat32(60 + 4 * k, number, true);
  });
  // One at a point, one from it towards the other, one that is told, one as it was.
  const figures = [{ on: [0] }, { on: [0, 1] }, {}, {}];
  const drawing = { points: 2, scale: 10, centre: [1, 1], figures };
  const before = new Float32Array([9, 9, 0, 9, 9, 9, 9, 9, 9, 5, 6, 7]);
  const { at, place, ...head } = readFrame(buffer, drawing, before);
  assert.deepEqual(head, { seq: 7, topology: 5, time: 0.25, residual: 0.5 });
  assert.deepEqual([...at], [1, 2, 3, 4]);
  assert.deepEqual([...place], [0, -10, 0, 0, -10, -45, 10, 20, 90, 5, 6, 7]);
  assert.equal(readFrame(buffer, { ...drawing, points: 5 }, undefined), undefined);
  assert.equal(readFrame(buffer, { ...drawing, figures: [] }, undefined), undefined);
  assert.equal(readFrame(new ArrayBuffer(10), { ...drawing, points: 0 }, undefined), undefined);
});

test("a display shows each frame of an engine whose clock is another", async () => {
  const { Client } = await part("engine/client.ts");
  const frame = (seq) => {
    const buffer = new ArrayBuffer(24 + 16);
    new DataView(buffer).setBigUint64(0, BigInt(seq), true);
    return buffer;
  };
  const drawing = { topology: 0, scale: 1, centre: [0, 0], points: 1, figures: [] };
  /** What is seen at each beat of the display; numbers are frames that come, a beat is `"|"`. */
  const seen = (state, events) => {
    let engine;
    const client = new Client({ open: (listener) => (engine = listener), send: () => {} });
    client.open();
    engine.standing({ is: "open" });
    engine.text(JSON.stringify({ drawing, state: { held: null, ...state } }));
    const shown = [];
    for (const event of events) {
      if (typeof event === "number") engine.frame(frame(event));
      else if (event !== "|") engine.text(JSON.stringify(event));
      else {
        shown.push(client.frame?.seq);
        client.shown();
      }
    }
    return shown;
  };
  const uneven = [1, "|", 2, 3, "|", "|", 4, 5, "|", "|", 6, "|"];
  assert.deepEqual(seen({ playing: true }, uneven), [1, 2, 3, 4, 5, 6]);
  // Frames that pile up are passed over, all but one.
  assert.deepEqual(seen({ playing: true }, [1, 2, 3, 4, "|", "|", "|"]), [1, 3, 4]);
  // What stands is shown as it is now, and so is what a hand leads.
  assert.deepEqual(seen({ playing: false }, uneven), [1, 3, 3, 5, 5, 6]);
  const held = { point: 0, client: 0 };
  assert.deepEqual(seen({ playing: true, held }, uneven), [1, 3, 3, 5, 5, 6]);
  // What is said behind a frame is heard behind it.
  const other = { drawing: { ...drawing, topology: 7 } };
  assert.deepEqual(seen({ playing: true }, [1, 2, other, "|", 3, "|"]), [1, 2]);
});
