//! What the page has besides when it brings its own engine: examples, links, a beginning from nothing.

import { h } from "./dom.ts";
import type { Example } from "./engine/protocol.ts";
import { unpacked } from "./pack.ts";
import type { Page } from "./page.ts";
import { galleryDialog } from "./panels/dialogs.ts";
import type { TextPanel } from "./panels/text.ts";
import { packed, wanted } from "./share.ts";

/** What is there when the address asks for nothing. */
const FIRST = "four-bar";

export class Playground {
  private examples: readonly Example[] = [];
  private readonly started: Promise<void>;
  private greet: () => void = () => {};
  private gallery: HTMLDialogElement | undefined;
  private text: TextPanel | undefined;
  /** The hash that the page itself wrote. */
  private own = "";

  constructor(
    private readonly page: Page,
    /** The pictures of the examples, packed. */
    private readonly packedPictures: string,
  ) {
    this.started = this.greeting();
    page.client.greeted.listen(() => this.greet());
    window.addEventListener("hashchange", () => void this.readAddress());
  }

  /** Buttons of the bar. */
  bar(): HTMLElement[] {
    const gallery = h(
      "button",
      { type: "button", onclick: () => void this.showGallery() },
      "Examples",
    );
    const share = h("button", { type: "button", onclick: () => void this.share() }, "Share");
    return [gallery, share];
  }

  /** Buttons beside the text. */
  beside(): HTMLElement[] {
    const title = "Begins with an empty plane and carries out the text";
    const start = (): void => void this.start(this.text?.box.value ?? "");
    return [h("button", { type: "button", id: "start", title, onclick: start }, "From the start")];
  }

  async begin(text: TextPanel): Promise<void> {
    this.text = text;
    await this.started;
    this.examples = await this.page.client.examples();
    if (!(await this.readAddress())) await this.open(FIRST);
  }

  private greeting(): Promise<void> {
    return new Promise((resolve) => {
      this.greet = resolve;
    });
  }

  /** Carries out what the address asks for, unless the page wrote it there. */
  private async readAddress(): Promise<boolean> {
    if (location.hash === this.own) return this.own !== "";
    try {
      const what = await wanted(location.hash);
      if (what === undefined) return false;
      if (what.is === "example") await this.open(what.name);
      else await this.start(what.text);
      return true;
    } catch {
      this.page.hinted.tell({ text: "The script in the address cannot be read.", isWrong: true });
      return false;
    }
  }

  private async open(name: string): Promise<void> {
    const example = this.examples.find((example) => example.name === name);
    if (example !== undefined) await this.start(example.text, name);
    else this.page.hinted.tell({ text: `No example is called ${name}.`, isWrong: true });
  }

  /** Carries out a script in an empty session; it stays in the box. */
  private async start(script: string, name?: string): Promise<void> {
    const greeted = this.greeting();
    this.page.client.restart();
    await greeted;
    if (this.text === undefined) return;
    this.text.hold(script);
    await this.text.run(true);
    document.title = name === undefined ? "linkwork" : `${name} – linkwork`;
  }

  private async showGallery(): Promise<void> {
    this.gallery ??= await this.makeGallery();
    this.gallery.showModal();
  }

  private async makeGallery(): Promise<HTMLDialogElement> {
    const text = new TextDecoder().decode(await unpacked(this.packedPictures));
    const pictures = JSON.parse(text) as Record<string, string>;
    return galleryDialog(this.examples, pictures, (example) => {
      this.own = `#example=${encodeURIComponent(example.name)}`;
      location.hash = this.own;
      void this.start(example.text, example.name);
    });
  }

  /** Puts all that was carried out into the address. */
  private async share(): Promise<void> {
    const script = (this.text?.entries ?? []).map(({ text }) => text).join("\n");
    this.own = `#${await packed(script)}`;
    location.hash = this.own;
    try {
      await navigator.clipboard.writeText(location.href);
      this.page.hint("The address holds the mechanism now; it is in the clipboard.");
    } catch {
      this.page.hint("The address of this page holds the mechanism now.");
    }
  }
}
