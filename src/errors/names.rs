//! E02: names.

super::kinds! {
    201 UNKNOWN_NAME {
        title: "an unknown name",
        help: "What is named has to be there already. `list` shows all that is.",
        wrong: "point A = (0, 0)\nlength A B = 2",
        right: "point A = (0, 0), B = (2, 0)\nlength A B = 2",
    }
    202 NAME_TAKEN {
        title: "a name is taken",
        help: "Points, constraints, parameters, circles, arcs and instances share their names.\n\
             `move` puts a point elsewhere, `change` gives a constraint another value.",
        wrong: "point A = (0, 0)\nlet A = 3",
        right: "point A = (0, 0)\nlet a = 3",
    }
    203 WRONG_SORT {
        title: "a name of the wrong sort of thing",
        help: "Where a point is expected only the name of a point will do, and so on.",
        wrong: "let r = 3\nfreeze r",
        right: "point A = (0, 0)\nfreeze A",
    }
    204 NO_MEMBER {
        title: "a thing has no such member",
        help: "`.x` and `.y` are those of points and vectors; `help members` lists the others.",
        wrong: "let r = 3\nprint r.x",
        right: "point A = (0, 0)\nprint A.x",
    }
    205 IN_USE {
        title: "what is to be deleted is in use",
        help: "`delete NAME cascade` takes away all that uses it, too; `undo` brings both back.",
        wrong: "point A = (0, 0), B = (1, 0)\nrod: length A B\ndelete A",
        right: "point A = (0, 0), B = (1, 0)\nrod: length A B\ndelete A cascade",
    }
    206 CYCLE {
        title: "a parameter would depend on itself",
        help: "A parameter keeps its expression, so `let r = r + 1` says that r is one more than r.\n\
             For `i` in turn, write a `for`.",
        wrong: "let r = 3\nlet r = r + 1",
        right: "let r = 3\nlet r = 4",
    }
    207 UNKNOWN_DEFINITION {
        title: "an unknown definition",
        help: "`list definitions` shows those there are.",
        wrong: "use leg(1) as left",
        right: "define leg(a) { point P = (a, 0) }\nuse leg(1) as left",
    }
}
