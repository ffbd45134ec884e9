//! The commands that make and change a mechanism.

use super::{Entry, Section};

pub(super) const MECHANISM: &[Entry] = &[
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
    Entry {
        keyword: "coordinate",
        section: Section::Constraints,
        usage: "coordinate P at POSITION",
        summary: "a point stays at a place (3.1)",
        help: "",
        example: "coordinate A at (3, 4)",
    },
    Entry {
        keyword: "coincidence",
        section: Section::Constraints,
        usage: "coincidence P Q",
        summary: "two points are in one place (3.2)",
        help: "",
        example: "coincidence A B",
    },
    Entry {
        keyword: "equivalence",
        section: Section::Constraints,
        usage: "equivalence A B, C D",
        summary: "the vector AB equals the vector CD (3.3)",
        help: "",
        example: "equivalence A B, C D",
    },
    Entry {
        keyword: "equal",
        section: Section::Constraints,
        usage: "equal A B, C D [RELATION]",
        summary: "the distances AB and CD are equal (3.4)",
        help: "With `in a..b`, `<= e` or `>= e` the difference of the two is what is bounded.",
        example: "equal A B, C D\n\
             equal A B, C D in -1..1",
    },
    Entry {
        keyword: "length",
        section: Section::Constraints,
        usage: "length A B [RELATION]",
        summary: "the distance of two points (3.5)",
        help: "The relation is `= e`, `<= e`, `>= e` or `in a..b`; without one the present value is kept.\n\
             A cord is `<=`, a telescope `in`; an expression with `time` makes an actuator.",
        example: "coupler: length B C = 3.5\n\
             length A B <= 5\n\
             length A B in 2..5",
    },
    Entry {
        keyword: "orientation",
        section: Section::Constraints,
        usage: "orientation A B, C D [RELATION]",
        summary: "the angle from AB to CD, counter-clockwise positive (3.6)",
        help: "The relation is `= e`, `<= e`, `>= e` or `in a..b`; without one the present value is kept.",
        example: "orientation A B, C D = 90deg",
    },
    Entry {
        keyword: "motor",
        section: Section::Constraints,
        usage: "motor O P [radius R] [speed W] [phase PHI]",
        summary: "P goes round O (3.7)",
        help: "The parts come in any order. Radius and phase are the present ones unless given.\n\
             The angle grows by speed times dt each frame, so a change of speed makes no jump.",
        example: "crank: motor O P radius 1 speed 1rev phase 90deg",
    },
    Entry {
        keyword: "glider",
        section: Section::Constraints,
        usage: "glider P on A B [unbounded]",
        summary: "P slides on the segment AB, or on the whole line (3.8)",
        help: "",
        example: "glider P on A B\n\
             glider P on A B unbounded",
    },
    Entry {
        keyword: "hinge",
        section: Section::Constraints,
        usage: "hinge P on A B at RATIO",
        summary: "P is fixed on the bar AB: P = A + ratio (B - A) (3.9)",
        help: "",
        example: "hinge P on A B at 1/3",
    },
    Entry {
        keyword: "cog",
        section: Section::Constraints,
        usage: "cog O1 A, O2 B ratio R [inside]",
        summary: "two wheels roll on each other, R the ratio of their radii (3.10)",
        help: "A is on the rim of the wheel round O1, B of that round O2; R = r2 / r1.\n\
             A negative ratio, or `inside`, is for internal contact.",
        example: "cog O1 A, O2 B ratio 4",
    },
    Entry {
        keyword: "distance",
        section: Section::Constraints,
        usage: "distance P to A B [RELATION]",
        summary: "the distance of P from the line AB, positive on its left",
        help: "The relation is `= e`, `<= e`, `>= e` or `in a..b`; without one the present value is kept.",
        example: "distance P to A B = 2",
    },
    Entry {
        keyword: "parallel",
        section: Section::Constraints,
        usage: "parallel A B, C D",
        summary: "AB and CD have one direction, or opposite ones",
        help: "The nearest of the two.",
        example: "parallel A B, C D",
    },
    Entry {
        keyword: "perpendicular",
        section: Section::Constraints,
        usage: "perpendicular A B, C D",
        summary: "AB and CD are at right angles",
        help: "The nearest of the two senses.",
        example: "perpendicular A B, C D",
    },
    Entry {
        keyword: "rigid",
        section: Section::Constraints,
        usage: "rigid A B C ...",
        summary: "points keep their present shape",
        help: "One constraint for all of them.",
        example: "rigid A B C D",
    },
    Entry {
        keyword: "rack",
        section: Section::Constraints,
        usage: "rack O A on P Q",
        summary: "a wheel rolls along a line without slipping",
        help: "O is the centre of the wheel and A a point of its rim, or any other point that turns with \
             it. The radius is the height of O over the line as it stands: where the rim touches.",
        example: "rack O A on P Q",
    },
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
