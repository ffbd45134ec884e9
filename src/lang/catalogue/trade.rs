//! Words that people bring with them: of the trade, and of other tools. None is a command; each is
//! answered by the statement that does it.

/// Words of one meaning, and what to type for them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Trade {
    /// The words.
    pub words: &'static [&'static str],
    /// The command that does it.
    pub command: &'static str,
    /// What it is here, as the end of a sentence that begins with the word.
    pub says: &'static str,
    /// A whole statement.
    pub example: &'static str,
}

/// The words that mean the same as `word`.
pub fn trade(word: &str) -> Option<&'static Trade> {
    TRADE.iter().find(|trade| trade.words.contains(&word))
}

/// Every word of the table.
pub fn trade_words() -> impl Iterator<Item = &'static str> {
    TRADE.iter().flat_map(|trade| trade.words).copied()
}

/// The table.
pub const TRADE: &[Trade] = &[
    Trade {
        words: &[
            "rod",
            "bar",
            "link",
            "beam",
            "strut",
            "arm",
            "member",
            "dimension",
            "line",
            "segment",
            "edge",
        ],
        command: "length",
        says: "keeps two points at a distance",
        example: "length A B = 3",
    },
    Trade {
        words: &["coupler", "conrod"],
        command: "length",
        says: "is a rod between two moving points",
        example: "coupler: length B C = 3.5",
    },
    Trade {
        words: &["rocker", "follower", "lever"],
        command: "length",
        says: "is a rod with one end frozen",
        example: "rocker: length C D = 3",
    },
    Trade {
        words: &["crank", "crankshaft", "driver", "drive", "engine", "spin"],
        command: "motor",
        says: "turns a point round another, driven by a motor",
        example: "crank: motor O A radius 1 speed 1rev",
    },
    Trade {
        words: &["slider", "piston", "carriage", "crosshead"],
        command: "glider",
        says: "is a point that slides along a line",
        example: "glider P on A B unbounded",
    },
    Trade {
        words: &["slot", "groove", "rail", "guide", "track", "prismatic"],
        command: "glider",
        says: "keeps a point on a segment, between its ends",
        example: "glider P on A B",
    },
    Trade {
        words: &["pin", "joint", "pivot", "revolute", "bolt", "axle", "concentric"],
        command: "coincidence",
        says: "needs no statement where two rods name one point; to put two points in one place",
        example: "coincidence A B",
    },
    Trade {
        words: &["gear", "gears", "gearwheel", "cogwheel", "pinion"],
        command: "cog",
        says: "is a pair of wheels that turn together",
        example: "cog O1 A, O2 B teeth 20, 60",
    },
    Trade {
        words: &["chain", "sprocket", "timing"],
        command: "belt",
        says: "goes round two wheels as a belt does",
        example: "belt O1 A, O2 B teeth 20, 40",
    },
    Trade {
        words: &["pulley", "tackle"],
        command: "hold",
        says: "leads a rope, whose parts have one length together",
        example: "hold distance(A, P) + distance(P, B) = 9",
    },
    Trade {
        words: &["wheel", "roller", "disc", "disk"],
        command: "circle",
        says: "is a circle, that others touch or slide on",
        example: "circle c = O radius 5",
    },
    Trade {
        words: &[
            "ground", "anchor", "fix", "lock", "fasten", "nail", "base", "earth", "frame",
            "support", "bearing", "fixed",
        ],
        command: "freeze",
        says: "holds a point where it is",
        example: "freeze A",
    },
    Trade {
        words: &["unfix", "unlock", "release", "free", "loosen", "unfreeze"],
        command: "thaw",
        says: "lets a frozen point move",
        example: "thaw A",
    },
    Trade {
        words: &["rope", "cord", "string", "cable", "tether"],
        command: "length",
        says: "keeps two points no farther apart than its length",
        example: "length A B <= 5",
    },
    Trade {
        words: &["telescope", "endstop", "limit"],
        command: "length",
        says: "holds a value in a range",
        example: "length A B in 2..5",
    },
    Trade {
        words: &["spring", "damper"],
        command: "length",
        says: "needs forces, and there are none here; how far it gives way is a range",
        example: "length A B in 2..5",
    },
    Trade {
        words: &["force", "gravity", "torque"],
        command: "pull",
        says: "is none of this: there are no forces here, but a point can be pulled",
        example: "pull A to (8, 0) over 40",
    },
    Trade {
        words: &["mass", "inertia"],
        command: "set",
        says: "is the weight of a point: a heavy one gives way less",
        example: "set weight 100 for A",
    },
    Trade {
        words: &["actuator", "cylinder", "ram", "jack", "hydraulic"],
        command: "length",
        says: "is a rod whose length follows an expression",
        example: "jack: length A B = 3 + sin(time)",
    },
    Trade {
        words: &["cam"],
        command: "length",
        says: "lifts by its profile: a length that follows the angle of a motor",
        example: "length O P = 3 + sin(2 * crank.angle)",
    },
    Trade {
        words: &["weld", "plate", "body", "lamina", "ternary", "solid"],
        command: "rigid",
        says: "keeps the shape of three points or more",
        example: "rigid A B C",
    },
    Trade {
        words: &["angle"],
        command: "orientation",
        says: "is held between two lines",
        example: "orientation A B, A C = 90deg",
    },
    Trade {
        words: &["mirror"],
        command: "symmetric",
        says: "makes a point the image of another in a line",
        example: "symmetric A B about P Q",
    },
    Trade {
        words: &["collinear", "midpoint"],
        command: "hinge",
        says: "keeps a point in its place between two others",
        example: "hinge P on A B at 1/2",
    },
    Trade {
        words: &["path", "locus", "trail"],
        command: "trace",
        says: "is drawn by a point that is traced",
        example: "trace C",
    },
    Trade {
        words: &["draw", "picture", "image", "render", "png", "paint"],
        command: "svg",
        says: "is written as a picture",
        example: "svg \"now.svg\"",
    },
    Trade {
        words: &["animate", "animation", "movie", "film", "video", "gif"],
        command: "record",
        says: "is recorded from here on",
        example: "record \"motion.svg\"",
    },
    Trade {
        words: &["simulate", "play", "go", "start", "advance"],
        command: "run",
        says: "lets time pass",
        example: "run 2.5",
    },
    Trade {
        words: &["dof", "mobility", "freedom", "diagnose", "analyse", "analyze"],
        command: "check",
        says: "tells the degrees of freedom and what contradicts",
        example: "check",
    },
    Trade {
        words: &["place", "position", "put"],
        command: "move",
        says: "puts a point elsewhere, at once",
        example: "move A to (1, 1)",
    },
    Trade {
        words: &["remove", "rm", "del", "erase"],
        command: "delete",
        says: "takes something away",
        example: "delete A",
    },
    Trade {
        words: &["modify", "edit", "update"],
        command: "change",
        says: "gives a constraint another value",
        example: "change coupler = 4",
    },
    Trade {
        words: &["call", "name", "relabel"],
        command: "rename",
        says: "gives something another name",
        example: "rename A to pivot",
    },
    Trade {
        words: &["enable", "activate"],
        command: "on",
        says: "switches a constraint on again",
        example: "on coupler",
    },
    Trade {
        words: &["disable", "suppress", "deactivate"],
        command: "off",
        says: "switches a constraint off and keeps it",
        example: "off coupler",
    },
    Trade {
        words: &["var", "param", "parameter", "variable", "const"],
        command: "let",
        says: "is a value with a name",
        example: "let r = 3",
    },
    Trade { words: &["ls", "dir"], command: "list", says: "lists what there is", example: "list" },
    Trade {
        words: &["echo", "puts", "log"],
        command: "print",
        says: "writes values and texts",
        example: "print \"C is at\", C",
    },
    Trade {
        words: &["source", "import", "read"],
        command: "include",
        says: "carries out another script in this world",
        example: "include \"leg.link\"",
    },
    Trade {
        words: &["write", "store"],
        command: "save",
        says: "writes a script that brings this world back",
        example: "save \"session.link\"",
    },
    Trade {
        words: &["open", "restart"],
        command: "load",
        says: "replaces this world by that of a script",
        example: "load \"session.link\"",
    },
    Trade {
        words: &["repeat", "while", "loop"],
        command: "for",
        says: "carries statements out several times",
        example: "for i in 1..3 { step }",
    },
    Trade {
        words: &["if", "else", "elif", "unless", "when", "switch", "require", "ensure"],
        command: "assert",
        says: "has no counterpart, as a script does the same in every run; what is to hold is asserted",
        example: "assert distance(A, B) = 3 within 1e-9",
    },
    Trade {
        words: &["node", "vertex", "dot"],
        command: "point",
        says: "is a point",
        example: "point A = (0, 0)",
    },
    Trade {
        words: &["function", "def", "macro", "component", "module", "subassembly"],
        command: "define",
        says: "gives statements a name, to be used more than once",
        example: "define leg(A, a) { point P = A + (a, 0) }",
    },
    Trade {
        words: &["bye", "q", "logout"],
        command: "quit",
        says: "ends the session",
        example: "quit",
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::SourceId;
    use crate::lang::catalogue::{commands, topics};
    use crate::lang::parse;

    #[test]
    fn every_word_is_there_once_and_no_command() {
        let mut words: Vec<_> = trade_words().collect();
        let known = commands().chain(topics()).map(|entry| entry.keyword);
        words.extend(known);
        words.sort_unstable();
        let twice = words.windows(2).find(|pair| pair[0] == pair[1]);
        assert_eq!(twice, None);
    }

    #[test]
    fn every_example_parses_as_its_command() {
        for trade in TRADE {
            let mut statements = parse(SourceId(0), trade.example);
            assert!(statements.all(|statement| statement.is_ok()), "{}", trade.example);
            let has_word = trade.example.split([' ', ':']).any(|word| word == trade.command);
            assert!(has_word, "{}", trade.example);
        }
    }
}
