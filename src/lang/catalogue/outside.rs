//! What the program does from a shell, and no statement does: who asks for it at a prompt is told what to
//! type there.

/// A word that follows the program's name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outside {
    /// The word.
    pub word: &'static str,
    /// What it does, as the end of a sentence that begins with the word.
    pub says: &'static str,
    /// What to type in a shell.
    pub example: &'static str,
}

/// What a word does that follows the program's name.
pub fn outside(word: &str) -> Option<&'static Outside> {
    OUTSIDE.iter().find(|outside| outside.word == word)
}

impl Outside {
    /// What to do instead of typing it at a prompt.
    pub fn advice(&self) -> String {
        let Self { word, says, example } = self;
        format!("`{word}` {says}, from a shell: `{example}`")
    }
}

/// The table.
pub const OUTSIDE: &[Outside] = &[
    Outside {
        word: "sweep",
        says: "runs a script for many values of its parameters",
        example: "linkwork sweep FILE --set r=1..3:0.5",
    },
    Outside {
        word: "watch",
        says: "runs a script again whenever it is saved",
        example: "linkwork watch FILE",
    },
    Outside {
        word: "fmt",
        says: "writes a script in its canonical form",
        example: "linkwork fmt FILE",
    },
];
