//! A script in the address, behind `#`: one link shares a mechanism.

import { fromAddress, through, toAddress } from "./pack.ts";

/** What stands behind `#` for a script. */
export async function packed(script: string): Promise<string> {
  const bytes = new TextEncoder().encode(script) as Uint8Array<ArrayBuffer>;
  return `z=${toAddress(await through(bytes, new CompressionStream("deflate-raw")))}`;
}

/** What an address asks for. */
export type Wanted =
  | { readonly is: "script"; readonly text: string }
  | { readonly is: "example"; readonly name: string };

/** Reads what stands behind `#`: `z=` packed, `t=` plain text, `example=` a name. */
export async function wanted(hash: string): Promise<Wanted | undefined> {
  const [, kind, rest] = /^#(z|t|example)=(.*)$/s.exec(hash) ?? [];
  if (kind === undefined || rest === undefined) return undefined;
  if (kind === "t") return { is: "script", text: decodeURIComponent(rest) };
  if (kind === "example") return { is: "example", name: decodeURIComponent(rest) };
  const bytes = await through(fromAddress(rest), new DecompressionStream("deflate-raw"));
  return { is: "script", text: new TextDecoder().decode(bytes) };
}
