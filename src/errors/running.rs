//! E05: what cannot be run, promised or asked of a run; E06: settings.

super::kinds! {
    501 TWO_PLACES {
        title: "one point is dragged to two places at once",
        help: "For one after the other, write two statements, or `through` both.",
        wrong: "point A = (0, 0)\ndrag A to (1, 0), A to (0, 1) over 10",
        right: "point A = (0, 0)\ndrag A through (1, 0), (0, 1) over 10",
    }
    502 FROZEN {
        title: "a frozen point is immovable",
        help: "`drag` moves it all the same; `thaw` frees it.",
        wrong: "point A = (0, 0) frozen\npull A to (1, 0) over 10",
        right: "point A = (0, 0) frozen\nthaw A\npull A to (1, 0) over 10",
    }
    503 NO_CLOCK {
        title: "the time something takes is asked for where there is no clock",
        help: "A page in a browser and a program that lends none cannot measure it.",
        wrong: "",
        right: "",
    }
    504 BROKEN_PROMISE {
        title: "a run did not keep what it promised",
        help: "`run` and `step` with `within` end in an error where a frame does not reach the tolerance or\n\
             the time is not enough. `check` says what is in the way.",
        wrong: "point A = (0, 0) frozen, B = (5, 0) frozen\nlength A B = 3\nstep 5 within 1e-9",
        right: "point A = (0, 0) frozen, B = (5, 0)\nlength A B = 3\nstep 5 within 1e-9",
    }
    505 NO_PROMISE {
        title: "a promise that no run could keep",
        help: "Sixteen digits is what numbers have: below that lies rounding.",
        wrong: "point A = (0, 0), B = (1, 0)\nlength A B = 1\nstep within 1e-30",
        right: "point A = (0, 0), B = (1, 0)\nlength A B = 1\nstep within 1e-9",
    }
    506 ASSERTION {
        title: "an `assert` failed",
        help: "Both values and their difference stand at the caret. `within` says how much they may\n\
             differ; a script ends here with status 1.",
        wrong: "assert 0.1 + 0.2 = 0.3",
        right: "assert 0.1 + 0.2 = 0.3 within 1e-12",
    }
    507 NOTHING_TO_UNDO {
        title: "there is nothing to take back, or to do again",
        help: "What changes nothing (`print`, `list`, `check`) is not counted.",
        wrong: "undo",
        right: "point A = (0, 0)\nundo",
    }
    508 NO_MOTION {
        title: "there is no motion to be studied",
        help: "`accuracy` repeats a motion: something has to be driven by a motor, by time, or by hand.",
        wrong: "accuracy",
        right: "",
    }
    509 NO_RANGE {
        title: "`limits` asks about something that drives nothing",
        help: "A motor, a constraint with a value, or a parameter can be turned to its limits.",
        wrong: "point A = (0, 0), B = (1, 0)\nhorizontal A B\nlimits horizontal1",
        right: "",
    }
    510 TOO_MUCH {
        title: "more than a limit allows",
        help: "Blocks lie at most 64 deep in each other, one command carries\n\
             out at most 20 million statements, and so on; `--limit NAME=N` on\n\
             the command line sets another limit.",
        wrong: "for i in 1..1e12 { }",
        right: "for i in 1..10 { }",
    }
    511 ALONE {
        title: "a command that cannot be part of another",
        help: "`undo`, `redo`, `clear` and their like take whole commands back, so they do not stand in a\n\
             `for`, a definition or an included file.",
        wrong: "for i in 1..2 { undo }",
        right: "for i in 1..2 { step }",
    }
    512 INTERRUPTED {
        title: "the user stopped it",
        help: "The world is as it was at the last whole frame.",
        wrong: "",
        right: "",
    }
    513 NO_MINIMUM {
        title: "a `fit` without a best",
        help: "What is to be least or greatest has to follow the parameters, and some numbers in the ranges have\n\
             to make a mechanism that is solved in every frame.",
        wrong: "let r = 3\npoint A = (1, 0)\nfit r in 2..4 to minimise A.x",
        right: "let r = 3\npoint A = (0, 0) frozen, B = (1, 0)\nlength A B = r\nfit r in 2..4 to minimise abs(B.x - 3)",
    }
    514 NOT_A_PATH {
        title: "a table that is no path of a point",
        help: "It has a line of names, `C.x` and `C.y` among them and `time` if the rows are not the frames one\n\
             by one, and a row for each place, as `record` writes it.",
        wrong: "let r = 1\npoint A = (0, 0) frozen, C = (1, 0)\nmotor A C radius r\nrecord \"c.csv\" of time\n\
                step 3\nrecord stop\nfit r in 0.5..2 to \"c.csv\"",
        right: "let r = 1\npoint A = (0, 0) frozen, C = (1, 0)\nmotor A C radius r\nrecord \"c.csv\" of time, C\n\
                step 3\nrecord stop\nreset\nfit r in 0.5..2 to \"c.csv\"",
    }
    601 UNKNOWN_SETTING {
        title: "an unknown setting",
        help: "`set` alone lists them with their values.",
        wrong: "set speed 3",
        right: "set dt 1/60",
    }
    602 SETTING_VALUE {
        title: "a value that this setting does not have",
        help: "`help SETTING` lists its values.",
        wrong: "set method magic",
        right: "set method newton",
    }
    603 SETTING_OWNER {
        title: "a setting of one thing and one of the whole session are not the same",
        help: "`weight` belongs to points, and `rho` may belong to a constraint: `set weight 2 for A`.\n\
             The others are set for the whole session.",
        wrong: "set weight 3",
        right: "point A = (0, 0)\nset weight 3 for A",
    }
}
