//! Texts in pieces that fit into messages.

/** A message may have 4 KiB; so many letters fit whatever they are. */
const PIECE = 600;

/** A text in pieces that fit into messages. */
export function pieces(text: string): string[] {
  const parts: string[] = [];
  for (let from = 0; from < text.length || parts.length === 0; ) {
    let to = Math.min(from + PIECE, text.length);
    // A letter of two units stays whole.
    if (to < text.length && (text.charCodeAt(to - 1) & 0xfc00) === 0xd800) to -= 1;
    parts.push(text.slice(from, to));
    from = Math.max(to, from + 1);
  }
  return parts;
}
