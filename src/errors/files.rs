//! E07: files, pictures and recordings.

super::kinds! {
    701 CANNOT_READ {
        title: "a file cannot be read",
        help: "The message says what the system says. `include` looks beside the file that includes.",
        wrong: "",
        right: "",
    }
    702 CANNOT_WRITE {
        title: "a file cannot be written",
        help: "The message says what the system says. Files are written below the output folder (`--out`).",
        wrong: "",
        right: "",
    }
    703 OUTSIDE {
        title: "a path leads out of the output folder",
        help: "Scripts write below the folder given with `--out`, so that no script of others writes\n\
             elsewhere. `--allow-any-path` lifts that.",
        wrong: "svg \"../elsewhere.svg\"",
        right: "svg \"here.svg\"",
    }
    704 NOT_A_FILE_NAME {
        title: "a path that names no file of a kind that is written here",
        help: "The ending of a name says what is written. `help svg`, `help plot` and `help record` list\n\
             the endings.",
        wrong: "svg \"\"",
        right: "svg \"now.svg\"",
    }
    705 RECORDING {
        title: "a recording that is under way already, or none that could be stopped",
        help: "`record stop` ends all recordings and writes them.",
        wrong: "record stop",
        right: "record \"motion.svg\"\nrecord stop",
    }
    706 NOT_TRACED {
        title: "a point is not traced",
        help: "`list traces` shows which are.",
        wrong: "point A = (0, 0)\nuntrace A",
        right: "point A = (0, 0)\ntrace A\nuntrace A",
    }
    707 NOTHING_TO_PLOT {
        title: "there is nothing to plot",
        help: "`sample` takes the values that `plot` draws.",
        wrong: "plot \"p.svg\"",
        right: "",
    }
    708 INCLUDES_ITSELF {
        title: "a file includes itself",
        help: "Directly or by way of others: that would never end.",
        wrong: "",
        right: "",
    }
    709 FOREIGN_FILE {
        title: "a file would be replaced that this program did not write",
        help: "Choose another name, so that nothing made by hand is lost; `--force` on the command line\n\
             replaces it all the same.",
        wrong: "",
        right: "",
    }
    710 NOT_RESTORED {
        title: "`restore` takes only what `save` wrote",
        help: "It is how a saved file brings back what no other statement says. Nobody need write it.",
        wrong: "restore rubbish = 1",
        right: "",
    }
    711 NEWER_FILE {
        title: "a newer linkwork wrote this file",
        help: "`save` notes the version of what it writes. What a newer program means by it is not known\n\
             to an older one, so it is not guessed.",
        wrong: "restore version = 1000",
        right: "restore version = 1",
    }
    712 READ_OUTSIDE {
        title: "a path leads out of where scripts may read",
        help: "Scripts read below the folder of the first of them, the output folder, and folders given\n\
             with `-I`. `--allow-any-path` lifts that.",
        wrong: "",
        right: "",
    }
    713 NO_SCRIPT {
        title: "what was read is no script",
        help: "Of a file whose name does not end in `.link` nothing is shown, lest a script print what\n\
             others keep to themselves.",
        wrong: "",
        right: "",
    }
    714 NO_PAGE {
        title: "no page can be shown",
        help: "`view` is for a session that goes on: a prompt, or `linkwork view FILE`. Where a port is\n\
             taken, `--port` names another, and without it any that is free will do.",
        wrong: "view",
        right: "",
    }
    715 NO_PIXELS {
        title: "a program that is built without pictures in pixels",
        help: "`.png` and `.gif` take some forty crates more, so they are a feature of their own:\n\
             `cargo install linkwork --features pictures`. The wheel and the archives have it.",
        wrong: "",
        right: "svg \"now.svg\"",
    }
    716 NOTHING_TO_EXPORT {
        title: "there is nothing that a machine could make",
        help: "A plotter draws bars and paths, a cutter cuts rods and rigid bodies that are switched on.",
        wrong: "point A = (0, 0)\nexport \"parts.svg\" width 10",
        right: "point A = (0, 0), B = (1, 0)\nlength A B = 1\nexport \"parts.svg\" scale 50 width 10",
    }
    717 UNMAKEABLE {
        title: "a part that cannot be made so",
        help: "A hole leaves some of the part around it, a cut is thinner than the part, and points that\n\
             are nearer than a hole cannot both have one.",
        wrong: "point A = (0, 0), B = (1, 0)\nlength A B = 1\nexport \"parts.svg\" width 10 hole 12",
        right: "point A = (0, 0), B = (1, 0)\nlength A B = 1\nexport \"parts.svg\" scale 50 width 10 hole 4",
    }
}
