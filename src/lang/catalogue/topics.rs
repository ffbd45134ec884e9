//! The subjects of `help` that are no commands.

use super::{Entry, Section};

pub(super) const TOPICS: &[Entry] = &[
    Entry {
        keyword: "add",
        section: Section::Topics,
        usage: "add CONSTRAINT",
        summary: "means the same as the constraint alone",
        help: "",
        example: "add length B C = 3.5\n\
             add coupler: length B C = 3.5",
    },
    Entry {
        keyword: "names",
        section: Section::Topics,
        usage: "p, p[3], left.B",
        summary: "how things are called",
        help: "A letter or `_`, then letters, digits, `_` and `'`; then any number of `[index]` and\n\
             `.member`. Points, constraints and parameters share one namespace. A word is a keyword\n\
             only where one is expected; `pi`, `tau` and `time` are reserved.",
        example: "point r[2].foot = (0, 0)",
    },
    Entry {
        keyword: "numbers",
        section: Section::Topics,
        usage: "3, 0.5, .5, 1e-9, 90deg",
        summary: "how numbers are written",
        help: "A suffix scales: `deg`, `rad`, `rev` (2 pi), `rpm` (2 pi / 60), `s`, `ms`.",
        example: "print 90deg, 60rpm, 5ms",
    },
    Entry {
        keyword: "expressions",
        section: Section::Topics,
        usage: "-2^2 + (x, y).x * sin(time)",
        summary: "how values are computed",
        help: "Numbers and vectors. `^` binds tightest and to the right, then unary minus, then `*` and\n\
             `/`, then `+` and `-`. `(x, y)` is a vector; `v.x` and `v.y` are its components.\n\
             The constants are `pi` and `tau`; `time` is the clock.\n\
             A statement of values alone prints them, as `print` does; the lone name of a constraint or an\n\
             instance shows it, as `show` does.",
        example: "-2^2, (A + B).x\n\
             distance(A, C)",
    },
    Entry {
        keyword: "members",
        section: Section::Topics,
        usage: "crank.angle, coupler.value, coupler.residual, c.radius, d.max",
        summary: "what a thing says of itself",
        help: "`.angle` is that of a motor with its phase; it goes on past half a turn. `.value` is what a\n\
             constraint measures now, whatever is asked of it; `.residual` is by how much it is missed,\n\
             with its sign. A measure has `.min .max .span .mean .first .last .at_min .at_max .count`. What is\n\
             declared under such a name comes first.\n\
             A constraint may follow an angle, a value, or the `.radius` of a circle; a residual and a\n\
             measure drive none.",
        example: "length A B = 3 + sin(2 * crank.angle)\n\
             print coupler.value, coupler.residual",
    },
    Entry {
        keyword: "functions",
        section: Section::Topics,
        usage: "sin(a), distance(P, Q), ...",
        summary: "what an expression can call",
        help: "Numbers: `sin cos tan asin acos atan atan2 sqrt abs sign min max hypot floor ceil round\n\
             exp ln mod`, `clamp(x, lo, hi)`, `triangle(x)` (0 at even, 1 at odd x).\n\
             Vectors: `norm dot cross rotate(v, phi) polar(r, phi) midpoint(P, Q)`.\n\
             Measures: `distance(P, Q)`, `distance(P, A, B)` from P to the line AB, `angle(P, Q)`,\n\
             `angle(A, B, C, D)`; `turn(A, B)` and `turn(A, B, C, D)` are the same angles with their whole\n\
             turns, counted from the first statement that asks.\n\
             Rates, only where a value is looked at: `velocity(P)`, `acceleration(P)`, `omega(A, B)` and\n\
             `alpha(A, B)` of the direction AB, `curvature(P)` of P's path, and `ic(A, B, C, D)`, the instant\n\
             centre of the bodies that hold the lines AB and CD.",
        example: "print distance(A, C), angle(A, B, C, D)",
    },
    Entry {
        keyword: "settings",
        section: Section::Topics,
        usage: "set SETTING VALUE",
        summary: "what `set` can change",
        help: "dt          time of one frame, 1/60\n\
             method      how frames are solved, auto; `help method` lists the others\n\
             rho         relaxation coefficient, 0.5; also for some constraints\n\
             weight      how strongly a point resists being moved; for some points\n\
             iterations  most iterations between two frames, 30\n\
             tolerance   stop below this residual, relative to the scene's size, 1e-12\n\
             dead-points where a motor cannot go on: hold, stop or reverse\n\
             live        on: each edit is followed by a solution; off\n\
             cog         wheels that are made from here on: holonomic, or the paper's velocity form\n\
             receipt     what is said after a run: short, or long\n\
             measures    extremes between frames: refined, or those of the frames: sampled",
        example: "set tolerance 1e-9",
    },
    Entry {
        keyword: "relations",
        section: Section::Topics,
        usage: "= e, <= e, >= e, in a..b",
        summary: "what can be demanded of a value",
        help: "`<` and `>` compare in an `assert`; in a constraint they mean the same as `<=` and `>=`.",
        example: "length A B in 2..5\n\
             assert C.x > 0",
    },
];
