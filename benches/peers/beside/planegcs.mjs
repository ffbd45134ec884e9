// FreeCAD's planegcs, compiled to WebAssembly, as a program that times itself.
// See src/beside.rs for what it is sent and how it answers.

import { createRequire } from "node:module";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

// The folder that npm installed it into.
const require = createRequire(process.argv[2] + "/");
const entry = require.resolve("@salusoft89/planegcs");
const { init_planegcs_module, GcsWrapper, Algorithm } = await import(pathToFileURL(entry));

// The solver talks on the console, where answers are expected.
console.log = () => {};
const module = await init_planegcs_module();
const wrapper = new GcsWrapper(new module.GcsSystem());
const { gcs } = wrapper;
let scene, addresses, drivers;

function set_up(text) {
  scene = JSON.parse(text);
  const held = new Set([...scene.ground, ...scene.driven.map(([p]) => p)]);
  scene.points.forEach(([x, y], p) => {
    wrapper.push_primitive({ id: `p${p}`, type: "point", x, y, fixed: held.has(p) });
  });
  let n = 0;
  const line = (a, b) => {
    const id = `l${n++}`;
    wrapper.push_primitive({ id, type: "line", p1_id: `p${a}`, p2_id: `p${b}` });
    return id;
  };
  for (const [kind, ...rest] of scene.relations) {
    if (kind === "length") {
      const [a, b, distance] = rest;
      wrapper.push_primitive({
        id: `c${n++}`, type: "p2p_distance", p1_id: `p${a}`, p2_id: `p${b}`, distance,
      });
    } else if (kind === "equal") {
      const [a, b, c, d] = rest;
      const [l1_id, l2_id] = [line(a, b), line(c, d)];
      wrapper.push_primitive({ id: `c${n++}`, type: "equal_length", l1_id, l2_id });
    } else {
      const [p, a, b] = rest;
      wrapper.push_primitive({
        id: `c${n++}`, type: "point_on_line_pl", p_id: `p${p}`, l_id: line(a, b),
      });
    }
  }
  addresses = scene.points.map((_, p) => wrapper.p_param_index.get(`p${p}`));
  drivers = scene.driven.map(([p, about]) => [addresses[p], about]);
}

// The system itself, not the wrapper's copying of every object after each solution.
function run(begin, n) {
  let failed = 0;
  const begun = process.cpuUsage();
  for (let k = begin + 1; k <= begin + n; k++) {
    const [x, y] = scene.offsets[k % scene.offsets.length];
    for (const [address, about] of drivers) {
      gcs.set_p_param(address, about[0] + x, true);
      gcs.set_p_param(address + 1, about[1] + y, true);
    }
    // 0: solved; 1: converged, with redundant constraints left aside.
    const status = gcs.solve_system(Algorithm.DogLeg);
    if (status === 0 || status === 1) gcs.apply_solution();
    else failed++;
  }
  const { user, system } = process.cpuUsage(begun);
  return `${(user + system) / 1e6} ${failed}`;
}

function answer(text) {
  if (!scene) {
    set_up(text);
    return "ready";
  }
  const [word, begin, n] = text.split(" ");
  if (word === "run") return run(Number(begin), Number(n));
  return JSON.stringify(addresses.map((at) => [gcs.get_p_param(at), gcs.get_p_param(at + 1)]));
}

for await (const text of createInterface({ input: process.stdin })) {
  try {
    process.stdout.write(`${answer(text)}\n`);
  } catch (problem) {
    process.stdout.write(`broke down: ${String(problem).split("\n")[0]}\n`, () => process.exit(1));
  }
}
