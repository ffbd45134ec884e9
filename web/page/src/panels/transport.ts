//! Play, pause, step, reset, undo, redo; and what of the plane is shown.

import { h, icon, put } from "../dom.ts";
import type { State } from "../engine/protocol.ts";
import type { Page } from "../page.ts";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

interface Button {
  readonly element: HTMLButtonElement;
  readonly picture: (lines: string, areas?: string) => void;
}

function button(label: string, keys: string, act: () => void, lines: string, areas = ""): Button {
  const element = h("button", {
    class: "bare",
    type: "button",
    title: `${label} (${keys})`,
    "aria-label": label,
    onclick: act,
  });
  const picture = (lines: string, areas = ""): void => {
    element.replaceChildren(icon(lines, areas));
  };
  picture(lines, areas);
  return { element, picture };
}

export class Transport {
  private speed = 1;
  private readonly time = h("span", { class: "time" }, "0 s");

  constructor(
    private readonly page: Page,
    place: HTMLElement,
    zoom: HTMLElement,
  ) {
    const { client, stage } = page;
    const play = button("Play", "Space", () => this.togglePlay(), "", "M6 4l10 6-10 6z");
    play.element.id = "play";
    const reset = button("Reset", "R", () => void page.do("reset"), "M5 5v10", "M15 5v10l-8-5z");
    const step = button("Step", "S", () => this.step(), "M15 5v10", "M5 5v10l8-5z");
    const undo = button(
      "Undo",
      "U",
      () => void page.do("undo"),
      "M7 4L3 8l4 4M3 8h8a5 5 0 0 1 0 9H7",
    );
    const redo = button(
      "Redo",
      "Y",
      () => void page.do("redo"),
      "M13 4l4 4-4 4M17 8H9a5 5 0 0 0 0 9h4",
    );
    const speed = h(
      "select",
      {
        "aria-label": "Speed of time",
        title: "Speed of time",
        onchange: () => {
          this.speed = Number(speed.value);
          if (client.state?.playing === true) client.play(this.speed);
        },
      },
      ...SPEEDS.map((factor) =>
        h("option", { value: factor, selected: factor === 1 }, `${factor}×`),
      ),
    );
    put(
      place,
      reset.element,
      play.element,
      step.element,
      undo.element,
      redo.element,
      this.time,
      speed,
    );

    const centre = (): { x: number; y: number } => ({
      x: stage.camera.width / 2,
      y: stage.camera.height / 2,
    });
    const zoomBy = (factor: number): void => stage.look(stage.camera.zoomed(factor, centre()));
    put(
      zoom,
      button("Zoom in", "+", () => zoomBy(1.25), "M10 4v12M4 10h12").element,
      button("Show all", "0", () => stage.fit(), "M4 8V4h4M12 4h4v4M16 12v4h-4M8 16H4v-4").element,
      button("Zoom out", "-", () => zoomBy(0.8), "M4 10h12").element,
    );

    client.stated.listen((state) => {
      const label = state.playing ? "Pause" : "Play";
      play.element.setAttribute("aria-label", label);
      play.element.title = `${label} (Space)`;
      if (state.playing) play.picture("", "M5 4h3.5v12H5zM11.5 4H15v12h-3.5z");
      else play.picture("", "M6 4l10 6-10 6z");
      undo.element.disabled = state.undo === null;
      redo.element.disabled = state.redo === null;
      undo.element.title = state.undo === null ? "Nothing to undo" : `Undo ${state.undo} (U)`;
      redo.element.title = state.redo === null ? "Nothing to redo" : `Redo ${state.redo} (Y)`;
      this.showTime(state.time);
    });
    stage.painted.listen((frame) => this.showTime(frame.time));
  }

  togglePlay(): void {
    const { client } = this.page;
    if (client.state?.playing === true) client.pause();
    else client.play(this.speed);
  }

  step(): void {
    void this.page.do("step");
  }

  private showTime(time: State["time"]): void {
    const text = `${time.toFixed(2)} s`;
    if (this.time.textContent !== text) this.time.textContent = text;
  }
}
