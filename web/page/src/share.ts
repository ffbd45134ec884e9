//! A script in the address, behind `#`: one link shares a mechanism.

/** Letters that stand in an address as they are. */
function toAddress(bytes: Uint8Array): string {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

function fromAddress(text: string): Uint8Array<ArrayBuffer> {
  const letters = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  return Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
}

async function through(
  bytes: Uint8Array<ArrayBuffer>,
  stream: CompressionStream | DecompressionStream,
): Promise<Uint8Array<ArrayBuffer>> {
  const piped = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

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
