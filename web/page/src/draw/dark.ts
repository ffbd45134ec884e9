//! The colours of the drawing on dark paper. The engine says them for light paper.

/** Each colour of the drawing list, and what takes its place. */
const DARK: ReadonlyMap<string, string> = new Map([
  // Paper, ink, steel.
  ["#fdfdfb", "#12171c"],
  ["#ffffff", "#12171c"],
  ["#273542", "#b4c3d1"],
  ["#d3dce5", "#35424f"],
  ["#94a6b7", "#62788c"],
  ["#e3eaf0", "#26303a"],
  ["#e9eef3", "#1c242c"],
  ["#e4e9ee", "#2a353f"],
  ["#eef2f5", "#35424f"],
  ["#f1f4f7", "#5a6b7b"],
  // Brass.
  ["#f5ecd3", "#3a3220"],
  ["#94793a", "#c6a55b"],
  ["#fbf6e8", "#2a2518"],
  ["#cdb981", "#7d6a3a"],
  ["#cdbb8a", "#7d6a3a"],
  // Pencil and guides.
  ["#7b8894", "#94a2af"],
  ["#9aa7b3", "#6f7e8b"],
  ["#c3ccd4", "#47545f"],
  ["#a9b3bd", "#5d6a76"],
  // Paths.
  ["#0072b2", "#4fabe6"],
  ["#d55e00", "#f28444"],
  ["#009e73", "#35c296"],
  ["#cc79a7", "#e29fc2"],
  ["#e69f00", "#f2b640"],
  ["#56b4e9", "#93d2f6"],
  ["#000000", "#e8edf2"],
]);

/** A colour with its lightness turned round, for what the table does not know. */
function turned(colour: string): string {
  const parts = /^#(..)(..)(..)$/.exec(colour);
  if (parts === null) return colour;
  const channels = parts.slice(1).map((hex) => Number.parseInt(hex, 16));
  const least = Math.min(...channels);
  const most = Math.max(...channels);
  // The same hue, as far from black as it was from white.
  return `rgb(${channels.map((channel) => 255 - most + (channel - least)).join(" ")})`;
}

/** A colour of the drawing on this paper. */
export function onPaper(colour: string, isDark: boolean): string {
  if (!isDark || colour === "none") return colour;
  return DARK.get(colour) ?? turned(colour);
}
