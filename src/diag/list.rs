//! Lists in words: `a, b and c`.

/// More names than this in one sentence are counted.
const MOST_NAMES: usize = 8;

/// Names as a list in words: `a`, `a and b`, `a, b and c`; `last` stands before the last.
///
/// ```
/// use linkwork::diag::listed;
///
/// assert_eq!(listed(&["a", "b", "c"], "or"), "a, b or c");
/// ```
pub fn listed<S: AsRef<str>>(names: &[S], last: &str) -> String {
    match names {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [first @ .., end] => {
            let first: Vec<&str> = first.iter().map(AsRef::as_ref).collect();
            format!("{} {last} {}", first.join(", "), end.as_ref())
        }
    }
}

/// The first of many names as a list in words: `a, b, c and 20 more`.
pub fn listed_first(names: &[String]) -> String {
    if names.len() <= MOST_NAMES + 1 {
        return listed(names, "and");
    }
    let (first, others) = names.split_at(MOST_NAMES);
    format!("{} and {} more", first.join(", "), others.len())
}

/// Ways to choose from as one line: commas between them, `or` before the last.
pub fn listed_ways(ways: &[String]) -> String {
    match ways {
        [first @ .., last] if !first.is_empty() => format!("{}, or {last}", first.join(", ")),
        _ => ways.join(""),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_more_than_is_listed_is_named_rather_than_counted() {
        let names: Vec<String> = ('a'..='j').map(String::from).collect();
        assert_eq!(listed_first(&names[..9]), "a, b, c, d, e, f, g, h and i");
        assert_eq!(listed_first(&names), "a, b, c, d, e, f, g, h and 2 more");
        assert_eq!(listed_ways(&names[..2]), "a, or b");
        assert_eq!(listed_ways(&names[..1]), "a");
        assert_eq!(listed::<String>(&[], "and"), "");
    }
}
