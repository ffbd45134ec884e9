//! The page begins: finds its engine, puts its parts together.

import { byId, h, icon, put } from "./dom.ts";
import type { Carrier, Standing } from "./engine/carrier.ts";
import { Client } from "./engine/client.ts";
import { InWorker } from "./engine/in_worker.ts";
import { Socket } from "./engine/socket.ts";
import { drawingTools } from "./hand/draw.ts";
import { Hand } from "./hand/hand.ts";
import { Keys } from "./hand/keys.ts";
import { Select } from "./hand/select.ts";
import type { Tool } from "./hand/tool.ts";
import { Page } from "./page.ts";
import { keysDialog } from "./panels/dialogs.ts";
import { Menu } from "./panels/menu.ts";
import { side } from "./panels/side.ts";
import { TextPanel } from "./panels/text.ts";
import { Transport } from "./panels/transport.ts";
import { Playground } from "./playground.ts";
import { Stage } from "./stage.ts";
import { Theme } from "./theme.ts";

const TABS = [
  ["text", "Text"],
  ["values", "Values"],
  ["solver", "Pose, solver"],
  ["files", "Files"],
] as const;

/** What the build put into an element. */
function textOf(id: string): string {
  return byId(id).textContent ?? "";
}

/** The engine that this page has; or a sentence why it has none. */
function carrier(): Carrier | string {
  if (document.getElementById("engine-wasm") !== null) {
    if (typeof WebAssembly === "undefined" || typeof Worker === "undefined") {
      return "This page runs its engine as WebAssembly in a worker, and this browser has not both. A current Firefox, Chrome, Edge or Safari has.";
    }
    if (typeof DecompressionStream === "undefined") {
      return "This browser cannot unpack the engine. A current Firefox, Chrome, Edge or Safari can.";
    }
    return new InWorker(textOf("engine-worker"), textOf("engine-wasm"));
  }
  if (typeof WebSocket === "undefined") {
    return "This page speaks with the session over a WebSocket, and this browser has none. A current Firefox, Chrome, Edge or Safari has.";
  }
  const address = new URL("ws", location.href);
  address.protocol = address.protocol.replace("http", "ws");
  address.hash = "";
  address.search = "";
  return new Socket(address.href);
}

function toolbar(hand: Hand, tools: readonly Tool[]): void {
  const buttons = tools.map((tool) => {
    const label = `${tool.name} (${tool.key.toUpperCase()})`;
    return h(
      "button",
      {
        class: "bare",
        type: "button",
        title: `${label}: ${tool.help}`,
        "aria-label": tool.name,
        "aria-pressed": String(tool === hand.tool),
        onclick: () => hand.take(tool),
      },
      icon(...tool.icon),
    );
  });
  hand.changed.listen((taken) => {
    for (const [k, button] of buttons.entries()) {
      button.setAttribute("aria-pressed", String(tools[k] === taken));
    }
  });
  put(byId("tools"), ...buttons);
}

/** The tabs that a narrow page has. */
function tabs(app: HTMLElement): void {
  const buttons = TABS.map(([name, label]) =>
    h("button", { type: "button", role: "tab", onclick: () => choose(name) }, label),
  );
  const choose = (chosen: string): void => {
    app.dataset.tab = chosen;
    for (const [k, button] of buttons.entries()) {
      button.setAttribute("aria-selected", String(TABS[k]?.[0] === chosen));
    }
  };
  put(byId("tabs"), ...buttons);
  choose("text");
}

/** What is said over the drawing: what is off, what just happened. */
function words(page: Page): void {
  const verdict = byId("verdict");
  const hint = byId("hint");
  let timer = 0;
  page.client.missed.listen((off) => {
    const [first] = off;
    verdict.replaceChildren();
    if (first === undefined) return;
    const others =
      off.length > 2
        ? `; so are ${off.length - 1} others`
        : off.length > 1
          ? "; so is another"
          : "";
    const text = `${first.name} is off by ${first.shown}${others}`;
    put(verdict, h("span", { class: "chip bad", role: "status" }, text));
  });
  page.hinted.listen(({ text, isWrong }) => {
    hint.textContent = text.length > 140 ? `${text.slice(0, 139)}…` : text;
    hint.classList.toggle("bad", isWrong);
    clearTimeout(timer);
    timer = setTimeout(() => hint.replaceChildren(), isWrong ? 9000 : 4000);
  });
}

function connection(page: Page): void {
  const place = byId("connection");
  const show = (standing: Standing): void => {
    place.textContent = standing.is === "open" ? "" : standing.why;
    document.documentElement.dataset.standing = standing.is;
  };
  page.client.standing.listen(show);
}

function begin(engine: Carrier): void {
  const app = byId("app");
  app.hidden = false;
  const theme = new Theme();
  const client = new Client(engine);
  const stage = new Stage(byId("canvas") as HTMLCanvasElement, client, theme);
  const page = new Page(client, stage, theme);
  const menu = new Menu(page);
  const select = new Select(
    (handle) => menu.open(handle),
    () => menu.close(),
  );
  const tools = [select, ...drawingTools()];
  const hand = new Hand(page, select);
  const transport = new Transport(page, byId("transport"), byId("zoom"));
  const playground = client.canRestart ? new Playground(page, textOf("gallery")) : undefined;
  const text = new TextPanel(page, byId("dock"), playground?.beside() ?? []);
  const help = keysDialog(tools);
  toolbar(hand, tools);
  side(page, byId("side"));
  tabs(app);
  words(page);
  connection(page);
  stage.canvas.setAttribute(
    "aria-label",
    "The mechanism. Full stop and comma go from point to point, arrows move the chosen one, question mark lists all keys.",
  );
  new Keys(page, hand, {
    tools,
    togglePlay: () => transport.togglePlay(),
    step: () => transport.step(),
    openMenu: (handle) => menu.open(handle),
    closeAll: () => menu.close(),
    help: () => help.showModal(),
    focusText: () => text.focus(),
    speak: (said) => {
      byId("spoken").textContent = said;
    },
  });
  const turn = h(
    "button",
    {
      class: "bare",
      type: "button",
      title: "Light or dark",
      "aria-label": "Light or dark",
      onclick: () => theme.turn(),
    },
    icon("M10 3a7 7 0 1 0 .1 0z", "M10 3a7 7 0 0 1 0 14z"),
  );
  const keys = h(
    "button",
    {
      class: "bare",
      type: "button",
      title: "Mouse and keys (?)",
      "aria-label": "Mouse and keys",
      onclick: () => help.showModal(),
    },
    icon("M10 3a7 7 0 1 0 .1 0zM7.8 8a2.2 2.2 0 1 1 3 2c-.6.3-.8.7-.8 1.4M10 13.8v.2"),
  );
  put(byId("bar-buttons"), ...(playground?.bar() ?? []), keys, turn);
  stage.beat.listen(() => client.tick());
  stage.shown.listen(() => client.shown());
  client.greeted.listen(({ version, engine: kind }) => {
    byId("title").textContent =
      kind === "socket" ? `session, version ${version}` : `playground, version ${version}`;
  });
  client.open();
  void playground?.begin(text);
}

const found = carrier();
if (typeof found === "string") document.body.append(h("p", { class: "sentence" }, found));
else begin(found);
