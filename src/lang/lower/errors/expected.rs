//! From the rules that pest expected to what a user would call them.

use std::fmt;

use crate::diag::nearest;

use crate::lang::ast::Role;
use crate::lang::grammar::Rule;
use crate::lang::lower::constraint;

/// What a command that names a file expects.
pub(crate) const PATH: &str = "a path in quotes";

/// What could have stood there, in a user's terms.
pub(crate) struct Expected {
    pub terms: Vec<String>,
    keywords: Vec<&'static str>,
}

impl Expected {
    pub fn new(rules: &[Rule], verb: &str, is_first: bool) -> Self {
        let has = |rule| rules.contains(&rule);
        let is_value = has(Rule::expr) || has(Rule::number) || has(Rule::range);
        let mut expected = Self { terms: Vec::new(), keywords: Vec::new() };
        for &rule in rules {
            match rule {
                // A value could go on with any of these; that says nothing.
                Rule::operator
                | Rule::member
                | Rule::index
                | Rule::open_bracket
                | Rule::arguments
                | Rule::EOI => {}
                Rule::number
                | Rule::reference
                | Rule::parens
                | Rule::minus
                | Rule::expr
                | Rule::column
                | Rule::range => expected.add("a value"),
                Rule::against => expected.add("measures"),
                Rule::name | Rule::ident if is_value => {}
                // Behind a name: it could be a function's.
                Rule::open_paren if is_value || rules.len() > 1 => {}
                Rule::relation => {
                    expected.add("a relation");
                    expected.keywords.push("in");
                }
                Rule::unit => expected.add("a unit"),
                Rule::example => expected.add("the name of an example"),
                Rule::string => {
                    let is_path = match verb {
                        "print" | "sample" | "result" | "trace" | "untrace" => false,
                        "plot" => is_first,
                        _ => true,
                    };
                    expected.add(if is_path { PATH } else { "a string" });
                }
                Rule::name
                | Rule::names
                | Rule::ident
                | Rule::setting
                | Rule::pair
                | Rule::binding
                | Rule::point_decl
                | Rule::result_item
                | Rule::fit_range
                | Rule::drag_target => expected.add(noun(verb, is_first)),
                Rule::selection => {
                    expected.add(noun(verb, is_first));
                    expected.add("`all`");
                    expected.keywords.push("all");
                }
                _ => match token(rule) {
                    Some(token) => expected.add(&format!("`{token}`")),
                    None => {
                        if let Some(keyword) = keyword(rule) {
                            expected.add(&format!("`{keyword}`"));
                            expected.keywords.push(keyword);
                        }
                    }
                },
            }
        }
        if has(Rule::EOI) {
            expected.add("the end of the statement");
        } else if expected.terms.is_empty() {
            expected.add("an operator");
        }
        expected
    }

    pub fn has(&self, term: &str) -> bool {
        self.terms.iter().any(|known| known == term)
    }

    fn add(&mut self, term: &str) {
        if !self.has(term) {
            self.terms.push(term.to_owned());
        }
    }

    /// The expected keyword that `word` is a misspelling of.
    pub fn near(&self, word: &str) -> Option<&'static str> {
        if word.is_empty() || self.keywords.contains(&word) {
            return None;
        }
        nearest(word, self.keywords.iter().copied())
    }
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("expected ")?;
        for (position, term) in self.terms.iter().enumerate() {
            match position {
                0 => {}
                _ if position + 1 == self.terms.len() => f.write_str(" or ")?,
                _ => f.write_str(", ")?,
            }
            f.write_str(term)?;
        }
        Ok(())
    }
}

/// What the statement of `verb` has names of.
fn noun(verb: &str, is_first: bool) -> &'static str {
    match verb {
        "freeze" | "thaw" | "move" | "drag" | "pull" | "point" | "trace" | "untrace" => "a point",
        "change" if !is_first => "a point",
        "let" | "fit" => "a parameter",
        "set" if is_first => "a setting",
        "off" | "on" => "a constraint",
        "help" => "a command",
        "use" | "define" if is_first => "a definition",
        _ if constraint::rule(verb).is_some() => "a point",
        _ => "a name",
    }
}

/// How a mark is written, or a clause begins; nothing for a keyword.
fn token(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::comma => ",",
        Rule::colon => ":",
        Rule::dots => "..",
        Rule::equals => "=",
        Rule::less => "<",
        Rule::less_equal => "<=",
        Rule::greater => ">",
        Rule::greater_equal => ">=",
        Rule::open_paren | Rule::parameters => "(",
        Rule::close_paren => ")",
        Rule::close_bracket => "]",
        _ => return None,
    })
}

/// The word of a keyword's rule, or the one that a clause begins with.
pub(crate) fn keyword(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::every | Rule::kw_every => "every",
        Rule::within | Rule::kw_within => "within",
        Rule::in_time | Rule::in_unit | Rule::kw_in => "in",
        Rule::kw_frozen => "frozen",
        Rule::kw_to => "to",
        Rule::kw_through => "through",
        Rule::kw_over => "over",
        Rule::kw_on => "on",
        Rule::kw_cascade => "cascade",
        Rule::kw_for => "for",
        Rule::kw_stop => "stop",
        Rule::kw_file => "file",
        Rule::kw_off => "off",
        Rule::kw_as | Rule::as_text => "as",
        Rule::kw_of | Rule::columns => "of",
        Rule::kw_against => "against",
        Rule::minimise | Rule::kw_minimise => "minimise",
        Rule::maximise | Rule::kw_maximise => "maximise",
        Rule::kw_all => "all",
        Rule::kw_add => "add",
        Rule::kw_log => "log",
        Rule::title | Rule::kw_title => "title",
        Rule::width | Rule::kw_width => "width",
        Rule::kw_dark => "dark",
        Rule::kw_transparent => "transparent",
        Rule::without_names | Rule::kw_without => "without names",
        Rule::kw_names => "names",
        Rule::scale | Rule::kw_scale => "scale",
        Rule::hole | Rule::kw_hole => "hole",
        Rule::kerf | Rule::kw_kerf => "kerf",
        Rule::x_label | Rule::kw_x => "x",
        Rule::y_label | Rule::kw_y => "y",
        Rule::kw_radius => "radius",
        Rule::kw_speed => "speed",
        Rule::kw_phase => "phase",
        Rule::kw_at => "at",
        Rule::kw_ratio => "ratio",
        Rule::kw_teeth => "teeth",
        Rule::kw_about => "about",
        Rule::kw_from => "from",
        _ => return constraint::role(rule).map(Role::word),
    })
}
