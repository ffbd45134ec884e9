//! The statements that changed something, as pages are told: the last ones, as many as a page that
//! comes can take in one message.

use std::collections::VecDeque;

use serde_json::json;

/// Statements that a page gets when it comes, at most.
const MOST: usize = 500;
/// Bytes of the message that has them, at most: what else a page is told then has to have room too.
const MOST_BYTES: usize = 4 << 20;
/// Bytes of a text that stay where all of it would be too long, however they are written: `\u0001` takes
/// six for one.
const CUT: usize = MOST_BYTES / 8;

/// What pages are told of what was done.
#[derive(Debug, Default)]
pub struct Journal {
    /// The last entries, each as it is written in a message.
    entries: VecDeque<String>,
    n_bytes: usize,
    /// How many there were in all.
    n: u64,
}

impl Journal {
    /// Takes a statement in.
    pub fn write(&mut self, text: &str, by: &str) {
        let entry = |text: &str| json!({ "number": self.n, "text": text, "by": by }).to_string();
        let mut written = entry(text);
        if written.len() > MOST_BYTES {
            written = entry(&format!("{}…", &text[..text.floor_char_boundary(CUT)]));
        }
        self.n += 1;
        self.n_bytes += written.len();
        self.entries.push_back(written);
        while self.entries.len() > MOST || self.n_bytes > MOST_BYTES {
            let oldest = self.entries.pop_front();
            self.n_bytes -= oldest.map_or(0, |entry| entry.len());
        }
    }

    /// How many statements there were in all.
    pub const fn n(&self) -> u64 {
        self.n
    }

    /// The message that tells those that are there, from the `n`th of all on.
    pub fn message_since(&self, n: u64) -> String {
        let n_gone = self.n - self.entries.len() as u64;
        let news: Vec<&str> = self
            .entries
            .iter()
            .skip(n.saturating_sub(n_gone) as usize)
            .map(String::as_str)
            .collect();
        format!("{{\"journal\":[{}]}}", news.join(","))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;

    /// The number and the text of each entry of a message.
    fn read(message: &str) -> Vec<(u64, String)> {
        let message: Value = serde_json::from_str(message).expect("JSON");
        let entries = message["journal"].as_array().expect("a list").iter();
        let parts = entries.map(|entry| (entry["number"].as_u64(), entry["text"].as_str()));
        parts
            .map(|(number, text)| (number.expect("a number"), text.expect("a text").to_owned()))
            .collect()
    }

    #[test]
    fn what_came_since_is_told_whole() {
        let mut journal = Journal::default();
        for k in 0..1000 {
            journal.write(&format!("let r = \"{k}\""), "page");
        }
        let since = read(&journal.message_since(998));
        assert_eq!(
            since,
            [(998, "let r = \"998\"".to_owned()), (999, "let r = \"999\"".to_owned())]
        );
        let all = read(&journal.message_since(0));
        assert_eq!((all.len(), all[0].0), (MOST, 500));
    }

    #[test]
    fn no_statement_makes_a_message_too_long() {
        // Letters that take one byte, three, and six where there was one.
        for letter in ["x", "€", "\u{1}"] {
            let mut journal = Journal::default();
            for n_bytes in [10, 1 << 20, 3 << 20, 5 << 20, 3 << 20, 10] {
                let text = letter.repeat(n_bytes / letter.len());
                journal.write(&text, "page");
                let message = journal.message_since(0);
                assert!(message.len() <= MOST_BYTES + 1000, "{letter:?}: {} bytes", message.len());
                let last = read(&message).pop().expect("the last is told");
                let begin = last.1.strip_suffix('…');
                assert!(
                    begin.map_or(last.1 == text, |begin| text.starts_with(begin)),
                    "{letter:?}"
                );
            }
            assert_eq!(journal.n(), 6);
        }
    }
}
