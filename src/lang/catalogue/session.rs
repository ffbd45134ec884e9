//! The commands that run a mechanism, look at it, draw it and build with it.

use super::{Entry, Section};

pub(super) const SESSION: &[Entry] = &[
    Entry {
        keyword: "step",
        section: Section::Running,
        usage: "step [FRAMES] [within TOLERANCE] [in WALL_TIME]",
        summary: "let frames go by: the clock advances by dt, then the solver works",
        help: "`within e` promises that each frame reaches the tolerance e, `in e` that none takes longer.",
        example: "step\n\
             step 360\n\
             step 100 within 1e-9 in 2ms",
    },
    Entry {
        keyword: "run",
        section: Section::Running,
        usage: "run TIME [within TOLERANCE] [in WALL_TIME]",
        summary: "let simulated time go by, in whole frames",
        help: "`within e` promises that each frame reaches the tolerance e, `in e` that none takes longer.",
        example: "run 2.5",
    },
    Entry {
        keyword: "relax",
        section: Section::Running,
        usage: "relax [N]",
        summary: "bare iterations, the clock stands still",
        help: "",
        example: "relax\n\
             relax 100",
    },
    Entry {
        keyword: "solve",
        section: Section::Running,
        usage: "solve [within TOLERANCE] [in WALL_TIME]",
        summary: "iterate until converged or stalled, the clock stands still",
        help: "Says which of the two.",
        example: "solve\n\
             solve within 1e-12",
    },
    Entry {
        keyword: "list",
        section: Section::Looking,
        usage: "list [points | constraints | traces | parameters | definitions]",
        summary: "say what there is",
        help: "",
        example: "list\n\
             list points",
    },
    Entry {
        keyword: "show",
        section: Section::Looking,
        usage: "show NAME",
        summary: "a point with its constraints, a constraint with its residual",
        help: "",
        example: "show C",
    },
    Entry {
        keyword: "print",
        section: Section::Looking,
        usage: "print ITEM, ...",
        summary: "write values and strings on one line",
        help: "Numbers in the shortest form that reads back to the same bits, vectors as `(x, y)`,\n\
             a space between two items.",
        example: r#"print C, distance(A, C), time
print "x is", C.x"#,
    },
    Entry {
        keyword: "check",
        section: Section::Looking,
        usage: "check",
        summary: "degrees of freedom; what is redundant, conflicting, near-singular",
        help: "",
        example: "check",
    },
    Entry {
        keyword: "why",
        section: Section::Looking,
        usage: "why NAME",
        summary: "what holds a point, or what a constraint conflicts with",
        help: "",
        example: "why C",
    },
    Entry {
        keyword: "limits",
        section: Section::Looking,
        usage: "limits NAME",
        summary: "how far a thing can go, and what stops it",
        help: "",
        example: "limits crank",
    },
    Entry {
        keyword: "effects",
        section: Section::Looking,
        usage: "effects",
        summary: "which effects the scene has switched on, why, and what each costs",
        help: "",
        example: "effects",
    },
    Entry {
        keyword: "accuracy",
        section: Section::Looking,
        usage: "accuracy [within TOLERANCE] [in WALL_TIME]",
        summary: "what accuracy costs in time on this very scene",
        help: "Does the longest run since the scene last changed again, on a copy, with every method and
many settings. Prints a table and writes `accuracy.csv` and `accuracy.svg`. With a wish it
names the one setting to use instead.",
        example: "accuracy\n\
             accuracy within 1e-6\n\
             accuracy in 2ms",
    },
    Entry {
        keyword: "assert",
        section: Section::Looking,
        usage: "assert VALUE RELATION [within TOLERANCE]",
        summary: "stop unless this holds",
        help: "Compares numbers, or vectors by their distance. In a batch a failed one ends the run\n\
             with exit status 1.",
        example: "assert distance(u, t, p) = 0 within 1e-9\n\
             assert C.x > 0",
    },
    Entry {
        keyword: "help",
        section: Section::Looking,
        usage: "help [WORD]",
        summary: "say how a command is written and what it does",
        help: "",
        example: "help\n\
             help motor",
    },
    Entry {
        keyword: "quit",
        section: Section::Looking,
        usage: "quit",
        summary: "end the session",
        help: "",
        example: "quit",
    },
    Entry {
        keyword: "exit",
        section: Section::Looking,
        usage: "exit",
        summary: "end the session",
        help: "The same as `quit`.",
        example: "exit",
    },
    Entry {
        keyword: "trace",
        section: Section::Pictures,
        usage: "trace NAMES [every FRAMES]",
        summary: "record the paths of points",
        help: "",
        example: "trace C\n\
             trace A C every 5",
    },
    Entry {
        keyword: "untrace",
        section: Section::Pictures,
        usage: "untrace NAMES | all",
        summary: "forget the paths of points",
        help: "",
        example: "untrace C\n\
             untrace all",
    },
    Entry {
        keyword: "expose",
        section: Section::Pictures,
        usage: "expose [every FRAMES | off]",
        summary: "multiple exposure: keep a ghost of the whole mechanism",
        help: "Alone it keeps one ghost of what is now.",
        example: "expose\n\
             expose every 30\n\
             expose off",
    },
    Entry {
        keyword: "svg",
        section: Section::Pictures,
        usage: "svg FILE",
        summary: "write a picture of what is now",
        help: "",
        example: r#"svg "now.svg""#,
    },
    Entry {
        keyword: "record",
        section: Section::Pictures,
        usage: "record FILE [every FRAMES] | stop",
        summary: "write each frame from here on",
        help: r#"A folder (`"frames/"`) gets a picture a frame, an `.svg` is one animation, a `.csv` has
time and the traced points. `record stop`, or the end of the script, writes them."#,
        example: r#"record "frames/" every 10
record "motion.svg"
record stop"#,
    },
    Entry {
        keyword: "sample",
        section: Section::Pictures,
        usage: "sample SERIES = VALUE, ...",
        summary: "append values to a named series, to be plotted",
        help: "The name of the series stands in quotes. `plot` draws all series.",
        example: r#"sample "relaxation" = distance(A, B) - 5
relax 1
sample "relaxation" = distance(A, B) - 5"#,
    },
    Entry {
        keyword: "plot",
        section: Section::Pictures,
        usage: "plot FILE [log] [title TEXT] [x TEXT] [y TEXT]",
        summary: "write all series as a line chart against the number of the sample",
        help: "The first sample of a series has number 0. With `log` equal ratios are equally high,
and values that are not above 0 are left out.",
        example: r#"plot "errors.svg" log title "Two circles" x "iteration" y "error""#,
    },
    Entry {
        keyword: "for",
        section: Section::Building,
        usage: "for NAME in FROM..TO { ... }",
        summary: "repeat statements, both ends included",
        help: "The variable stands for its value.",
        example: "for i in 1..10 { point p[i] = (i, 0); length p[i-1] p[i] = 1 }",
    },
    Entry {
        keyword: "define",
        section: Section::Building,
        usage: "define NAME(PARAMETERS) { ... }",
        summary: "name a group of statements",
        help: "The parameters are points, or numbers that stay expressions.",
        example: "define dyad(A, B, a, b) {\n  point P = midpoint(A, B)\n  length A P = a; length B P = b\n}",
    },
    Entry {
        keyword: "use",
        section: Section::Building,
        usage: "use NAME(ARGUMENTS) [as NAME]",
        summary: "make what a definition says",
        help: "What it declares is prefixed with the name of the instance.",
        example: "use dyad(A, D, 3, 3.5) as left",
    },
    Entry {
        keyword: "include",
        section: Section::Building,
        usage: "include FILE",
        summary: "read statements from a file into this world",
        help: "The path is relative to the file that includes it.",
        example: r#"include "jansen-leg.link""#,
    },
    Entry {
        keyword: "save",
        section: Section::Building,
        usage: "save FILE",
        summary: "write a script that brings this world back to the last bit",
        help: "",
        example: r#"save "session.link""#,
    },
    Entry {
        keyword: "load",
        section: Section::Building,
        usage: "load FILE",
        summary: "replace the world by what a file makes",
        help: "",
        example: r#"load "session.link""#,
    },
    Entry {
        keyword: "restore",
        section: Section::Building,
        usage: "restore STATE [NAME] [= VALUE, ...]",
        summary: "state that only a saved session needs",
        help: "`save` writes these; there is no need to type one.",
        example: "restore clock = 0.5, 30",
    },
];
