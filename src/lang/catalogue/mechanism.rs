//! The commands that make and change a mechanism, its constraints left out.

use super::{Entry, Section};

pub(super) const POINTS: &[Entry] = &[
    Entry {
        keyword: "point",
        section: Section::Points,
        usage: "point NAME = POSITION [frozen], ...",
        summary: "declare points where they start",
        help: "The position is a starting value: constraints move a point that is not frozen.\n\
             A frozen point stays where it is until it is moved, dragged or thawed.",
        example: "point A = (0, 0) frozen, B = A + (1, 0)",
    },
    Entry {
        keyword: "let",
        section: Section::Points,
        usage: "let NAME = EXPRESSION, ...",
        summary: "define a parameter, or change one",
        help: "The expression stays an expression: when a parameter in it changes, or it mentions\n\
             `time`, all that depends on it follows at once.",
        example: "let r = 3\n\
             let s = 2 * r + sin(time)",
    },
    Entry {
        keyword: "freeze",
        section: Section::Points,
        usage: "freeze NAMES | all",
        summary: "make points immovable",
        help: "",
        example: "freeze A B\n\
             freeze all",
    },
    Entry {
        keyword: "thaw",
        section: Section::Points,
        usage: "thaw NAMES | all",
        summary: "let frozen points move again",
        help: "",
        example: "thaw A\n\
             thaw all",
    },
    Entry {
        keyword: "move",
        section: Section::Points,
        usage: "move NAME to POSITION",
        summary: "put a point somewhere else, at once",
        help: "The constraints then act.",
        example: "move B to (2, 3)",
    },
    Entry {
        keyword: "drag",
        section: Section::Points,
        usage: "drag NAME to POSITION, ... [over FRAMES]",
        summary: "draw points along straight lines, simulating",
        help: "A point that is not frozen is frozen for the drag and thawed after it.",
        example: "drag A to (3, 4) over 60\n\
             drag A to (3, 4), B to (0, 1) over 60",
    },
];

pub(super) const CHANGING: &[Entry] = &[
    Entry {
        keyword: "delete",
        section: Section::Changing,
        usage: "delete NAMES [cascade]",
        summary: "take points, constraints, parameters or instances out",
        help: "A point still in use is refused, with a list of its users; `cascade` takes these out too.",
        example: "delete coupler\n\
             delete C cascade",
    },
    Entry {
        keyword: "off",
        section: Section::Changing,
        usage: "off NAMES",
        summary: "keep constraints, but out of the active list",
        help: "",
        example: "off crank",
    },
    Entry {
        keyword: "on",
        section: Section::Changing,
        usage: "on NAMES",
        summary: "take constraints back into the active list",
        help: "",
        example: "on crank",
    },
    Entry {
        keyword: "change",
        section: Section::Changing,
        usage: "change NAME PART ...",
        summary: "change any trailing part of the statement that made a thing",
        help: "The parts: `= e`, `<= e`, `>= e`, `in a..b`, `radius e`, `speed e`, `phase e`, `at e`,\n\
             `ratio e`, `inside`, `unbounded`, `on A B`, `to A B`.",
        example: "change crank speed 2rev\n\
             change coupler = 4\n\
             change coupler in 3..4",
    },
    Entry {
        keyword: "set",
        section: Section::Changing,
        usage: "set [SETTING [VALUE [for NAMES]]]",
        summary: "change a setting, or print them",
        help: "`set` alone prints all settings, `set dt` this one. `set rho` and `set weight` can be for\n\
             some constraints or points only. `help settings` lists them.",
        example: "set\n\
             set dt 1/360\n\
             set method newton\n\
             set rho 0.25 for coupler",
    },
    Entry {
        keyword: "undo",
        section: Section::Changing,
        usage: "undo [N]",
        summary: "take back the last commands that changed anything",
        help: "Runs included.",
        example: "undo\n\
             undo 3",
    },
    Entry {
        keyword: "redo",
        section: Section::Changing,
        usage: "redo [N]",
        summary: "do again what was undone",
        help: "",
        example: "redo",
    },
    Entry {
        keyword: "reset",
        section: Section::Changing,
        usage: "reset",
        summary: "time 0, and the points where they stood when the clock left 0",
        help: "",
        example: "reset",
    },
    Entry {
        keyword: "clear",
        section: Section::Changing,
        usage: "clear",
        summary: "an empty world",
        help: "",
        example: "clear",
    },
];
