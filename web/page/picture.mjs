// Makes the picture of a drag in the README: a pantograph whose stylus is pulled, with the mouse.
//
//   node web/page/picture.mjs [PROGRAM] > docs/pictures/drag.svg

import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** Places of a heart, which the mouse goes round. */
const HEART = Array.from({ length: 40 }, (_, k) => {
  const t = (2 * Math.PI * (k + 1)) / 40;
  const x = 16 * Math.sin(t) ** 3;
  const y = 13 * Math.cos(t) - 5 * Math.cos(2 * t) - 2 * Math.cos(3 * t) - Math.cos(4 * t);
  return `(${(1.9 + 0.021 * x).toFixed(3)}, ${(0.15 + 0.021 * (y - 5)).toFixed(3)})`;
});

const SCRIPT = `let scale = 3, bar = 1.4
point O = (0, 0) frozen
point S = ${HEART.at(-1)} frozen, U = (1.1, -0.9), W = scale * U, P = scale * S, V = W + (P - W) / scale
length O W = scale * bar
length W P = scale * bar
hinge U on O W at 1 / scale
hinge V on W P at 1 / scale
length U S = bar
length S V = (scale - 1) * bar
solve
thaw S
trace P
set dt 1/25
record "drag.svg"
pull S through ${HEART.join(", ")} over 100
`;

/** The tip of a mouse's arrow is at the origin. */
const ARROW =
  '<path d="M0 0l0 17 4-3.6 2.7 6.2 2.8-1.2-2.7-6.1 5.4-.4z" fill="#273542" stroke="#fdfdfb" stroke-width="1.4" stroke-linejoin="round"/>';

const folder = mkdtempSync(join(tmpdir(), "linkwork-picture-"));
const program = process.argv[2] ?? "target/debug/linkwork";
const done = spawnSync(program, ["-e", SCRIPT, "--out", folder], { encoding: "utf8" });
if (done.status !== 0) throw new Error(done.stderr);
const drawn = readFileSync(join(folder, "drag.svg"), "utf8");
rmSync(folder, { recursive: true });

// The mouse goes where the joint S goes: it has the same motion.
const joint = /<g[^>]*>\s*<title>S<\/title>([\s\S]*?)<\/g>/.exec(drawn);
if (joint === null) throw new Error("the picture has no joint S");
const [place] = /<animateTransform[^>]*type="translate"[^>]*\/>/.exec(joint[0]) ?? [];
if (place === undefined) throw new Error("the joint S does not move");
process.stdout.write(drawn.replace("</svg>", `<g>${place}${ARROW}</g>\n</svg>`));
