//! What is too much: the bounds that keep odd input from hanging or exhausting the machine.

use crate::world::Extent;

/// Rounds of one `for`, and statements carried out by one statement of a script, blocks and
/// definitions included. A slip of the pen is found in seconds; a million points fit well.
pub const MOST_STATEMENTS: u64 = 20_000_000;

/// How deep `include`, `use` and `for` may nest at run time: recursion ends here.
pub const DEEPEST_NESTING: usize = 64;

/// Frames of one command. A billion frames of the smallest mechanism take minutes.
pub const MOST_FRAMES: f64 = 1e9;

/// Bytes of history kept for `undo`, roughly; the oldest commands are forgotten beyond it.
pub const UNDO_BYTES: usize = 256 << 20;

/// Commands kept for `undo`.
pub const UNDO_COMMANDS: usize = 10_000;

/// Terms of one expression with all that the members in it stand for, and how deep they may stand
/// within each other: each is worked out many times a frame, by calls within calls.
pub const LONGEST_EXPRESSION: Extent = Extent { n_terms: 100_000, depth: 500 };

/// An argument of a definition that has more terms becomes a parameter of the instance: what it is
/// handed on to mentions it, and does not hold it again.
pub const LONGEST_ARGUMENT: u32 = 64;
