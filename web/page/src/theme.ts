//! Light or dark: as the display asks, unless the user says which.

import type { Alarm } from "./draw/brush.ts";
import { Signal } from "./signal.ts";

export type Choice = "system" | "light" | "dark";

const KEPT = "linkwork-theme";

function kept(): Choice {
  try {
    const choice = localStorage.getItem(KEPT);
    return choice === "light" || choice === "dark" ? choice : "system";
  } catch {
    // A page from a file may have nowhere to keep it.
    return "system";
  }
}

export class Theme {
  readonly changed = new Signal();
  choice: Choice = kept();
  private readonly system = matchMedia("(prefers-color-scheme: dark)");

  constructor() {
    this.system.addEventListener("change", () => this.apply());
    this.apply();
  }

  get isDark(): boolean {
    return this.choice === "dark" || (this.choice === "system" && this.system.matches);
  }

  get paper(): string {
    return this.isDark ? "#12171c" : "#fdfdfb";
  }

  get ink(): string {
    return this.isDark ? "#dbe4ec" : "#273542";
  }

  get soft(): string {
    return this.isDark ? "#9fadb9" : "#5b6873";
  }

  get accent(): string {
    return this.isDark ? "#6bb7ee" : "#0b6aa8";
  }

  get alarm(): Alarm {
    return this.isDark
      ? { edge: "#ff8f84", inside: "#6b2b27" }
      : { edge: "#b3261e", inside: "#f3b8b3" };
  }

  /** To the other of light and dark. */
  turn(): void {
    this.choice = this.isDark ? "light" : "dark";
    try {
      localStorage.setItem(KEPT, this.choice);
    } catch {
      // It holds for as long as the page is open.
    }
    this.apply();
  }

  private apply(): void {
    document.documentElement.dataset.theme = this.isDark ? "dark" : "light";
    this.changed.tell();
  }
}
