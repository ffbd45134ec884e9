//! The panel at the side: values, motors, the solver, how the pose is, files.

import { h, put, replace } from "../dom.ts";
import type { MotorState, Off, ParameterState, SettingState, State } from "../engine/protocol.ts";
import type { Page } from "../page.ts";
import { filesPanel } from "./files.ts";
import { type Row, Rows } from "./rows.ts";
import { ValueRow } from "./value_row.ts";

/** Settings that are in sight; the others are below them. */
const FIRST: ReadonlySet<string> = new Set(["rho", "iterations", "method", "tolerance", "dt"]);

/** Lines of an analysis that say what stands beside them already. */
const ELSEWHERE = /^(degrees of freedom|status): /;

function panel(tab: string, title: string, ...children: (Node | string)[]): HTMLElement {
  return h("section", { class: "panel", "data-tab": tab }, h("h2", {}, title), ...children);
}

function parameterRow(page: Page, { name }: ParameterState): Row<ParameterState> {
  const row = new ValueRow(page, {
    label: name,
    isSigned: false,
    statement: (text) => `let ${name} = ${text}`,
  });
  const element = h("div", { class: "row slider" }, h("code", {}, name), row.input, row.slider);
  return { element, update: ({ text, live, used }) => row.show(text, live, used) };
}

function motorRow(page: Page, { name }: MotorState): Row<MotorState> {
  const row = new ValueRow(page, {
    label: `speed of ${name}`,
    isSigned: true,
    statement: (text) => `change ${name} speed ${text}`,
  });
  const isOn = h("input", {
    type: "checkbox",
    "aria-label": `${name} is on`,
    onchange: () => void page.do(`${isOn.checked ? "on" : "off"} ${name}`),
  });
  const element = h(
    "div",
    { class: "row motor" },
    isOn,
    h("code", {}, name),
    row.input,
    row.slider,
  );
  return {
    element,
    update: ({ on, shown }) => {
      isOn.checked = on;
      row.show(shown);
    },
  };
}

function settingRow(page: Page, { name, words, what }: SettingState): Row<SettingState> {
  const label = h("label", { for: `set-${name}`, title: what }, name);
  const attributes = { id: `set-${name}`, class: "mono", spellcheck: "false", autocomplete: "off" };
  const field =
    words.length > 0
      ? h("select", attributes, ...words.map((word) => h("option", { value: word }, word)))
      : h("input", attributes);
  field.addEventListener("change", () => {
    page.do(`set ${name} ${field.value.trim()}`).then((answer) => {
      field.setAttribute("aria-invalid", String(!answer.ok));
    });
  });
  const element = h("div", { class: "row setting" }, label, field);
  return {
    element,
    update: ({ text }) => {
      if (document.activeElement !== field || words.length > 0) field.value = text;
    },
  };
}

function settings(page: Page): HTMLElement {
  const first = h("div");
  const others = h("div");
  const make = (setting: SettingState): Row<SettingState> => settingRow(page, setting);
  const nameOf = ({ name }: SettingState): string => name;
  const rows = [new Rows(first, make, nameOf), new Rows(others, make, nameOf)] as const;
  page.client.stated.listen((state) => {
    rows[0].show(state.settings.filter(({ name }) => FIRST.has(name)));
    rows[1].show(state.settings.filter(({ name }) => !FIRST.has(name)));
  });
  const more = h("details", {}, h("summary", {}, "All settings"), others);
  return panel("solver", "Solver", first, more);
}

function values(page: Page): HTMLElement {
  const parameters = h("div");
  const motors = h("div");
  const none = h("p", { class: "quiet" }, "let r = 3 makes a value with a slider.");
  const noMotor = h("p", { class: "quiet" }, "The motor tool draws what turns by itself.");
  const parameterRows = new Rows<ParameterState>(
    parameters,
    (parameter) => parameterRow(page, parameter),
    ({ name }) => name,
  );
  const motorRows = new Rows<MotorState>(
    motors,
    (motor) => motorRow(page, motor),
    ({ name }) => name,
  );
  page.client.stated.listen((state) => {
    parameterRows.show(state.parameters);
    motorRows.show(state.motors);
    none.hidden = state.parameters.length > 0;
    noMotor.hidden = state.motors.length > 0;
  });
  const side = panel("values", "Values", parameters, none);
  put(side, h("h2", { class: "second" }, "Motors"), motors, noMotor);
  return side;
}

function fact(name: string, value: string): HTMLElement {
  return h("div", { class: "row fact" }, h("span", { class: "quiet" }, name), h("span", {}, value));
}

function pose(page: Page): HTMLElement {
  const facts = h("div");
  const off = h("div");
  const lines = h("div");
  const showFacts = (): void => {
    const { state, frame } = page.client;
    if (state === undefined) return;
    replace(
      facts,
      fact(
        "degrees of freedom",
        state.freedoms === null ? "ask with check" : String(state.freedoms),
      ),
      fact(
        "largest residual",
        frame === undefined ? "…" : Number(frame.residual.toPrecision(3)).toString(),
      ),
      fact("points, constraints", `${state.points.length}, ${state.constraints.length}`),
      state.unlisted > 0 && fact("not listed", String(state.unlisted)),
    );
  };
  const showLines = (state: State): void => {
    showFacts();
    const texts = [state.verdict, ...(state.check ?? []), ...(state.receipt ?? [])];
    const isNews = (text: string | null): boolean =>
      text !== null && text !== "" && !ELSEWHERE.test(text);
    const seen = new Set(texts.filter(isNews));
    replace(lines, ...[...seen].map((text) => h("p", { class: "quiet" }, text)));
  };
  let isDue = false;
  page.stage.painted.listen(() => {
    // Numbers that change faster than that cannot be read; the last of them is shown.
    if (isDue) return;
    isDue = true;
    setTimeout(() => {
      isDue = false;
      showFacts();
    }, 200);
  });
  page.client.stated.listen(showLines);
  page.client.missed.listen((missed) => replace(off, ...missed.map((one) => offRow(page, one))));
  return panel("solver", "Pose", facts, off, lines);
}

/** A constraint that does not hold; pressed, its own words about itself. */
function offRow(page: Page, { name, shown }: Off): HTMLElement {
  const text = h("span", { class: "mono" }, name);
  const show = (): void => page.written.tell(`show ${name}`);
  return h("button", { class: "off-by", type: "button", onclick: show }, text, `off by ${shown}`);
}

export function side(page: Page, place: HTMLElement): void {
  put(place, values(page), pose(page), settings(page), filesPanel(page));
}
