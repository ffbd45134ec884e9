//! E01: a text that cannot be read.

super::kinds! {
    101 UNKNOWN_COMMAND {
        title: "a statement begins with a word that is no command",
        help: "`help` lists the commands, `help WORD` says what a word of the trade is called here.",
        wrong: "lenght A B = 3",
        right: "point A = (0, 0), B = (3, 0)\nlength A B = 3",
    }
    102 UNEXPECTED {
        title: "something stands where the statement cannot go on with it",
        help: "The caret shows where reading stopped, and the line under it what could stand there.\n\
             `help WORD` shows how the statement is written.",
        wrong: "point A (0, 0)",
        right: "point A = (0, 0)",
    }
    103 INCOMPLETE {
        title: "a statement ends too early",
        help: "A line goes on while a bracket is open, behind a comma, or behind a `\\`.",
        wrong: "length A",
        right: "point A = (0, 0), B = (1, 0)\nlength A B",
    }
    104 BRACKET {
        title: "brackets do not match",
        help: "Each `(`, `[` and `{` is closed by its own kind, within its statement.",
        wrong: "print (1 + 2",
        right: "print (1 + 2)",
    }
    105 OPEN_STRING {
        title: "a string is not closed on its line",
        help: "A line end in a string is written `\\n`.",
        wrong: "print \"hello",
        right: "print \"hello\"",
    }
    106 TOO_NESTED {
        title: "an expression is too long or too deeply nested",
        help: "Brackets may stand within each other 64 deep. Give a part of it a name with `let`.",
        wrong: "",
        right: "",
    }
    107 BLOCK {
        title: "a block in braces is missing, or one too many",
        help: "`for` and `define` have a block, whose `{` stands on their line; nothing else has.",
        wrong: "for i in 1..3",
        right: "for i in 1..3 { print i }",
    }
    108 UNKNOWN_ESCAPE {
        title: "a backslash in a string stands before a letter that means nothing",
        help: "`\\\"`, `\\\\` and `\\n` are known. In a path use `/`.",
        wrong: "print \"a\\tb\"",
        right: "print \"a b\"",
    }
    109 LABEL {
        title: "a name in front, or `add`, where there is no constraint",
        help: "`coupler: length B C = 3` names a constraint. Points, circles and arcs are named in their\n\
             statement.",
        wrong: "A: point = (0, 0)",
        right: "point A = (0, 0)",
    }
    110 NUMBER_TOO_LARGE {
        title: "a number has too many digits to be one",
        help: "Numbers go up to 1.7976931348623157e308.",
        wrong: "print 1e999",
        right: "print 1e99",
    }
    111 UNKNOWN_UNIT {
        title: "an unknown unit",
        help: "A number may have `deg`, `rad`, `rev`, `rpm`, `s` or `ms` right behind it. Lengths have no\n\
             unit: all of a scene are in one, whichever you think in.",
        wrong: "let reach = 3mm",
        right: "let reach = 3",
    }
    112 TWICE {
        title: "a part of a statement is given twice",
        help: "",
        wrong: "define twin(a, a) { print a }",
        right: "define twin(a, b) { print a, b }",
    }
    113 UNKNOWN_FUNCTION {
        title: "an unknown function",
        help: "`help functions` lists them.",
        wrong: "print sqr(2)",
        right: "print sqrt(2)",
    }
    114 NOT_A_FUNCTION {
        title: "something is called that is no function",
        help: "A product is written with `*`.",
        wrong: "point A = (0, 0)\nprint A.x(3 + 4)",
        right: "point A = (0, 0)\nprint A.x * (3 + 4)",
    }
    115 ARGUMENTS {
        title: "too many or too few arguments",
        help: "`help NAME` shows how many a function takes.",
        wrong: "print sin(1, 2)",
        right: "print sin(1)",
    }
    116 RESERVED_NAME {
        title: "a name that always means something else",
        help: "`pi`, `tau` and `time` are reserved.",
        wrong: "let time = 3",
        right: "let start = 3",
    }
    117 ASSIGNMENT {
        title: "`name = ...` alone is not a statement",
        help: "What it should be depends on what the name is: a parameter is given a value with `let`, a\n\
             point is moved with `move`, a constraint is given another value with `change`.",
        wrong: "r = 3",
        right: "let r = 3",
    }
    118 NO_HELP {
        title: "there is no help on this word",
        help: "`help` alone lists the commands and subjects.",
        wrong: "help rhubarb",
        right: "help motor",
    }
    119 UNKNOWN_LIST {
        title: "there is no list of this",
        help: "`list` alone lists everything; `show NAME` shows one thing.",
        wrong: "list cranks",
        right: "list constraints",
    }
    120 NO_REQUEST {
        title: "a line of a program that is no request",
        help: "`linkwork --json` takes statements, and requests: `{\"run\": \"STATEMENTS\"}`, `{\"get\": \"traces\"}`.\n\
             docs/json.md has them all.",
        wrong: "",
        right: "",
    }
}
