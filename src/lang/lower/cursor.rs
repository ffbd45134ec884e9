//! Walks over what pest has read: each call takes the next thing of a sort and gives its tree.

use std::sync::Arc;

use crate::diag::{Diagnostic, Span};
use crate::lang::ast::{
    Expr, Ident, Name, NamePart, Pair, PartKind, Promise, Range, Relation, Selection, Text, Unit,
};

use super::Reader;
use super::errors::refusal;
use super::expr::{MAX_DEPTH, Tree, lower_expr};
use super::parsed::{Parsed, Things};
use crate::lang::grammar::Rule;

/// A position in the parts of a statement.
pub(in crate::lang) struct Cursor<'a> {
    pub reader: Reader<'a>,
    end: usize,
    pairs: Things<'a>,
}

/// Where a part of a statement stands.
pub(in crate::lang) struct Spot<'a> {
    pub rule: Rule,
    /// The word it begins with.
    pub word: &'a str,
    pub word_span: Span,
    pub span: Span,
}

type Result<T> = std::result::Result<T, Diagnostic>;

impl<'a> Cursor<'a> {
    pub(super) fn new(reader: Reader<'a>, pairs: Things<'a>) -> Self {
        Self { reader, end: 0, pairs }
    }

    /// Over the parts of `pair`.
    pub fn within(&self, pair: Parsed<'a>) -> Self {
        Self::new(self.reader, pair.inner())
    }

    pub fn span(&self, pair: Parsed<'_>) -> Span {
        self.reader.span(pair.start()..pair.end())
    }

    /// Where in the text the last thing taken ended.
    pub fn end(&self) -> usize {
        self.end
    }

    /// The sort of the next thing; words and marks that only hold things apart are passed over.
    pub fn peek(&mut self) -> Option<Rule> {
        loop {
            let pair = self.pairs.peek()?;
            let rule = pair.rule();
            if !only_separates(rule) {
                return Some(rule);
            }
            self.end = pair.end();
            self.pairs.next();
        }
    }

    /// The sort and place of the next thing.
    pub fn peek_span(&mut self) -> Option<(Rule, Span)> {
        let rule = self.peek()?;
        self.pairs.peek().map(|pair| (rule, self.span(pair)))
    }

    /// Where the next thing is, which `rule` has read.
    pub fn spot(&mut self, rule: Rule) -> Spot<'a> {
        let part = self.pairs.peek().expect("there is a next thing");
        let word = part.inner().next().unwrap_or(part);
        let (span, word_span) = (self.span(part), self.span(word));
        Spot { rule, word: word.as_str(), word_span, span }
    }

    /// What stands at a place.
    pub fn text_at(&self, span: Span) -> &'a str {
        &self.reader.text[span.range()]
    }

    /// Passes over the first word of a statement.
    pub fn pass_verb(&mut self) {
        self.pairs.next();
    }

    /// The next thing, if it is a `rule`.
    pub fn take(&mut self, rule: Rule) -> Option<Parsed<'a>> {
        if self.peek() != Some(rule) {
            return None;
        }
        let pair = self.pairs.next()?;
        self.end = pair.end();
        Some(pair)
    }

    /// The next thing, whatever it is.
    pub fn next(&mut self) -> Option<Parsed<'a>> {
        let rule = self.peek()?;
        self.take(rule)
    }

    /// Is the next thing this word? Then it is passed over.
    pub fn flag(&mut self, word: Rule) -> bool {
        self.take(word).is_some()
    }

    fn must(&mut self, rule: Rule) -> Parsed<'a> {
        self.take(rule).unwrap_or_else(|| panic!("the grammar has a {rule:?} here"))
    }

    pub fn ident(&mut self) -> Ident {
        let pair = self.must(Rule::ident);
        self.ident_of(pair)
    }

    /// The unit that a value is counted in, if a clause with one is what follows.
    pub fn unit_if_any(&mut self) -> Result<Option<Unit>> {
        let Some(clause) = self.take(Rule::in_unit) else { return Ok(None) };
        let word = self.within(clause).unit_word();
        let unit = Unit::ALL.into_iter().find(|unit| unit.suffix() == &*word.text);
        unit.map(Some).ok_or_else(|| refusal::unknown_unit(&word))
    }

    /// The unit behind a value; none if none is said.
    pub fn unit(&mut self) -> Result<Unit> {
        Ok(self.unit_if_any()?.unwrap_or(Unit::None))
    }

    /// The word of a unit.
    pub fn unit_word(&mut self) -> Ident {
        let pair = self.must(Rule::unit);
        self.ident_of(pair)
    }

    pub fn ident_if_any(&mut self) -> Option<Ident> {
        let pair = self.take(Rule::ident)?;
        Some(self.ident_of(pair))
    }

    /// The name of an example: words and numbers joined by hyphens.
    pub fn example_if_any(&mut self) -> Option<Ident> {
        let pair = self.take(Rule::example)?;
        Some(self.ident_of(pair))
    }

    /// The name of a setting: words joined by hyphens.
    pub fn setting_if_any(&mut self) -> Option<Ident> {
        let pair = self.take(Rule::setting)?;
        Some(self.ident_of(pair))
    }

    fn ident_of(&self, pair: Parsed<'_>) -> Ident {
        Ident { text: Arc::from(pair.as_str()), span: self.span(pair) }
    }

    /// A word that is going to mean something from here on.
    pub fn declared_ident(&mut self) -> Result<Ident> {
        let ident = self.ident();
        refusal::reserved(&ident)?;
        Ok(ident)
    }

    pub fn name(&mut self) -> Result<Name> {
        let pair = self.must(Rule::name);
        let (name, _) = self.name_of(pair)?;
        refusal::reserved(&name.head)?;
        Ok(name)
    }

    pub fn name_if_any(&mut self) -> Result<Option<Name>> {
        if self.peek() == Some(Rule::name) { self.name().map(Some) } else { Ok(None) }
    }

    /// The name in `pair` and how deep the deepest expression in its brackets is.
    pub fn name_of(&self, pair: Parsed<'a>) -> Result<(Name, usize)> {
        let span = self.span(pair);
        let mut inner = self.within(pair);
        let head = inner.ident();
        let mut parts = Vec::with_capacity(inner.pairs.clone().count());
        let mut depth = 0;
        while let Some(part) = inner.next() {
            let span = self.span(part);
            let kind = if part.rule() == Rule::member {
                PartKind::Member(inner.within(part).ident().text)
            } else {
                let index = inner.within(part).tree()?;
                depth = depth.max(index.depth);
                PartKind::Index(index.expr)
            };
            parts.push(NamePart { kind, span });
        }
        if parts.len() > MAX_DEPTH {
            return Err(refusal::too_long(span));
        }
        Ok((Name { head, parts: parts.into_boxed_slice(), span }, depth))
    }

    /// Every name that follows, one at least.
    pub fn names(&mut self) -> Result<Vec<Name>> {
        let mut names = Vec::new();
        loop {
            match self.peek() {
                Some(Rule::name) => names.push(self.name()?),
                Some(Rule::names) => {
                    let list = self.must(Rule::names);
                    names.append(&mut self.within(list).names()?);
                }
                _ => return Ok(names),
            }
        }
    }

    pub fn selection(&mut self) -> Result<Selection> {
        let pair = self.must(Rule::selection);
        let mut inner = self.within(pair);
        if inner.flag(Rule::kw_all) {
            return Ok(Selection::All);
        }
        inner.names().map(Selection::Names)
    }

    pub fn pair(&mut self) -> Result<Pair> {
        let pair = self.must(Rule::pair);
        let mut inner = self.within(pair);
        Ok(Pair { from: inner.name()?, to: inner.name()? })
    }

    pub(super) fn tree(&mut self) -> Result<Tree> {
        let pair = self.must(Rule::expr);
        lower_expr(self, pair)
    }

    pub fn expr(&mut self) -> Result<Expr> {
        self.tree().map(|tree| tree.expr)
    }

    pub fn expr_if_any(&mut self) -> Result<Option<Expr>> {
        if self.peek() == Some(Rule::expr) { self.expr().map(Some) } else { Ok(None) }
    }

    /// Every expression that follows.
    pub fn exprs(&mut self) -> Result<Vec<Expr>> {
        let mut exprs = Vec::new();
        while let Some(expr) = self.expr_if_any()? {
            exprs.push(expr);
        }
        Ok(exprs)
    }

    /// The expression of a clause like `speed e`, if that is what follows.
    pub fn clause(&mut self, rule: Rule) -> Result<Option<Expr>> {
        match self.take(rule) {
            Some(clause) => self.within(clause).expr().map(Some),
            None => Ok(None),
        }
    }

    /// Clauses in any order, each of `rules` at most once.
    pub fn clauses<const N: usize>(&mut self, rules: [Rule; N]) -> Result<[Option<Expr>; N]> {
        let mut found: [Option<(Expr, Span)>; N] = [const { None }; N];
        while let Some(slot) = rules.iter().position(|&rule| self.peek() == Some(rule)) {
            let clause = self.must(rules[slot]);
            let mut inner = self.within(clause);
            let word = inner.pairs.peek().expect("a clause begins with its word");
            let span = self.span(word);
            if let Some((_, first)) = &found[slot] {
                return Err(refusal::twice(word.as_str(), *first, span));
            }
            found[slot] = Some((inner.expr()?, span));
        }
        Ok(found.map(|clause| clause.map(|(expr, _)| expr)))
    }

    pub fn promise(&mut self) -> Result<Promise> {
        let [within, in_time] = self.clauses([Rule::within, Rule::in_time])?;
        Ok(Promise { within, in_time })
    }

    pub fn range(&mut self) -> Result<Range> {
        let pair = self.must(Rule::range);
        let mut inner = self.within(pair);
        Ok(Range { from: inner.expr()?, to: inner.expr()? })
    }

    pub fn relation_if_any(&mut self) -> Result<Option<Relation>> {
        let Some(relation) = self.take(Rule::relation) else { return Ok(None) };
        let mut inner = self.within(relation);
        let sign = inner.pairs.peek().map(Parsed::rule);
        if sign == Some(Rule::kw_in) {
            return inner.range().map(|range| Some(Relation::In(range)));
        }
        inner.pairs.next();
        let value = inner.expr()?;
        Ok(Some(match sign {
            Some(Rule::less) => Relation::Less(value),
            Some(Rule::less_equal) => Relation::LessEqual(value),
            Some(Rule::greater) => Relation::Greater(value),
            Some(Rule::greater_equal) => Relation::GreaterEqual(value),
            _ => Relation::Equal(value),
        }))
    }

    pub fn text_if_any(&mut self) -> Result<Option<Text>> {
        if self.peek() == Some(Rule::string) { self.text().map(Some) } else { Ok(None) }
    }

    pub fn text(&mut self) -> Result<Text> {
        let pair = self.must(Rule::string);
        let span = self.span(pair);
        let quoted = pair.as_str();
        let inside = &quoted[1..quoted.len() - 1];
        if !inside.contains('\\') {
            return Ok(Text { value: Arc::from(inside), span });
        }
        let mut value = String::with_capacity(inside.len());
        let mut chars = inside.char_indices();
        while let Some((at, char)) = chars.next() {
            let escaped =
                if char == '\\' { chars.next().map(|(_, escaped)| escaped) } else { None };
            match escaped {
                None => value.push(char),
                Some('n') => value.push('\n'),
                Some(escaped @ ('"' | '\\')) => value.push(escaped),
                Some(escaped) => {
                    let start = span.start as usize + 1 + at;
                    return Err(self.reader.unknown_escape(start, escaped));
                }
            }
        }
        Ok(Text { value: Arc::from(value), span })
    }
}

/// Is it a mark or word that only holds other things apart?
fn only_separates(rule: Rule) -> bool {
    matches!(
        rule,
        Rule::EOI
            | Rule::comma
            | Rule::colon
            | Rule::dots
            | Rule::equals
            | Rule::open_paren
            | Rule::close_paren
            | Rule::open_bracket
            | Rule::close_bracket
            | Rule::kw_to
            | Rule::kw_about
            | Rule::kw_from
            | Rule::kw_through
            | Rule::kw_over
            | Rule::kw_on
            | Rule::kw_at
            | Rule::kw_ratio
            | Rule::kw_teeth
            | Rule::kw_radius
            | Rule::kw_speed
            | Rule::kw_phase
            | Rule::kw_every
            | Rule::kw_within
            | Rule::kw_for
            | Rule::kw_in
            | Rule::kw_width
            | Rule::kw_scale
            | Rule::kw_hole
            | Rule::kw_kerf
            | Rule::kw_as
            | Rule::kw_of
            | Rule::kw_against
            | Rule::kw_minimise
            | Rule::kw_maximise
            | Rule::kw_title
            | Rule::kw_x
            | Rule::kw_y
    )
}
