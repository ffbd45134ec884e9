//! What the law tests cannot tell: which tree a text gives, and where its parts lie.

use crate::diag::{SourceId, Sources, Span};
use crate::lang::ast::{Command, Looking, Node, Part, Relation, Statement};
use crate::lang::{is_incomplete, parse};

/// The canonical form of each statement of `text`, or its mistake.
fn canonical(text: &str) -> Vec<String> {
    parse(SourceId(0), text)
        .map(|statement| match statement {
            Ok(statement) => statement.to_string(),
            Err(problem) => format!("error: {}", problem.message),
        })
        .collect()
}

fn only(text: &str) -> Statement {
    let mut statements = parse(SourceId(0), text);
    let first = statements.next().expect("a statement").expect("without mistakes");
    assert_eq!(statements.next(), None);
    first
}

#[test]
fn keywords_are_names_where_no_keyword_is_expected() {
    let check = |text: &str| assert_eq!(canonical(text), [text]);
    check("glider on on a b");
    check("glider P on on on unbounded");
    check("length length on = 3");
    check("drag to to (3, 4) over 60");
    check("freeze step");
    check("freeze all on");
    check("point r = (0, 0), t = r, e = t + s frozen, step = frozen frozen");
    check("on: length at to <= in");
    check("add: motor radius speed radius phase");
    check("coordinate at at at");
    check("distance to to to to in in..in");
    check("delete cascade");
    check("delete A, cascade");
    check("delete A cascade");
    check("trace every every every");
    check("set for (for) for for");
    check("step (within) within in in in");
    check("print sin, sin(sin), distance, e, s, ms");
    check("for in in in..in {}");
    check("use use(as) as as");
    check("restore restore restore = restore");
    check("let let = 3");
}

#[test]
fn texts_are_brought_into_canonical_form() {
    let check = |text: &str, wanted: &[&str]| assert_eq!(canonical(text), wanted, "of {text}");
    check("", &[]);
    check(" ;; # nothing\n\t\r\n;", &[]);
    check("\u{feff}step", &["step"]);
    check("add length B C=3.50", &["length B C = 3.5"]);
    check("c :add length B C", &["c: length B C"]);
    check("add point A=(0,0)frozen", &["point A = (0, 0) frozen"]);
    check("freeze A, B,C", &["freeze A B C"]);
    check("motor A B phase 90deg speed 1rev", &["motor A B speed 1rev phase 90deg"]);
    check("exit", &["quit"]);
    check("let r = 3 step # no separator", &["error: unexpected `step`"]);
    check("let r = (1\n+ # one\n2)\nstep", &["let r = 1 + 2", "step"]);
    check("point A = (0, 0),\n\n# B\n  B = A", &["point A = (0, 0), B = A"]);
    check("length A \\\n B", &["length A B"]);
    check("print \"# no comment; (\" # \"", &["print \"# no comment; (\""]);
    check("print \"a\\\"b\\\\\\n\"", &["print \"a\\\"b\\\\\\n\""]);
    check("for i in 2..5{step;step}", &["for i in 2..5 {\n  step\n  step\n}"]);
    check("length A B in .5...75", &["length A B in 0.5..0.75"]);
    check("equal A B, C D > -1", &["equal A B, C D > -1"]);
}

#[test]
fn precedence_is_that_of_mathematics() {
    let check = |text: &str, wanted: &str| {
        assert_eq!(canonical(&format!("print {text}")), [format!("print {wanted}")]);
    };
    check("-2^2", "-2^2");
    check("(-2)^2", "(-2)^2");
    check("-(2^2)", "-2^2");
    check("2^3^4", "2^3^4");
    check("(2^3)^4", "(2^3)^4");
    check("2^(3^4)", "2^3^4");
    check("2^-3*4", "2^-3 * 4");
    check("2^-3^4", "2^-3^4");
    check("2^(-3)^4", "2^(-3)^4");
    check("-a*b", "-a * b");
    check("-(a*b)", "-(a * b)");
    check("a-(b-c)", "a - (b - c)");
    check("(a-b)-c", "a - b - c");
    check("a/(b*c)", "a / (b * c)");
    check("a--b", "a - -b");
    check(
        "(A).x + A.x + (A + B).x.y + velocity(P) .y",
        "(A).x + A.x + (A + B).x.y + velocity(P).y",
    );
    check("p[i-1][j].x", "p[i - 1][j].x");
    check("sin ( 1 )", "sin(1)");
}

#[test]
fn numbers_keep_their_suffix_and_have_its_value() {
    let check = |text: &str, wanted: f64| {
        let Command::Looking(Looking::Print(items)) = only(&format!("print {text}")).command else {
            panic!("a print")
        };
        let [crate::lang::ast::PrintItem::Value(value)] = &*items else { panic!("one value") };
        let Node::Number(number) = value.node else { panic!("a number") };
        assert_eq!(number.value(), wanted, "of {text}");
    };
    check("90deg", std::f64::consts::FRAC_PI_2);
    check("180deg", std::f64::consts::PI);
    check("1rev", std::f64::consts::TAU);
    check("60rpm", std::f64::consts::TAU);
    check("5ms", 0.005);
    check("2s", 2.0);
    check("1.5rad", 1.5);
    check(".5e1", 5.0);
    check("1E3", 1000.0);
}

#[test]
fn spans_point_at_the_text() {
    let text = "# first\n bar :  length  p[i-1] q.B = (1+2).x # end\n";
    let mut sources = Sources::new();
    let id = sources.add("a.link", text);
    let statement = parse(id, text).next().expect("a statement").expect("no mistake");
    let at = |span: Span| sources.slice(span);
    assert_eq!(at(statement.span), "bar :  length  p[i-1] q.B = (1+2).x");
    let Command::Constrain(decl) = &statement.command else { panic!("a constraint") };
    assert_eq!(at(decl.label.as_ref().expect("a label").span), "bar");
    let [Part::Points(points), Part::Relation(Relation::Equal(value))] = &*decl.constraint.parts
    else {
        panic!("a length")
    };
    let [from, to] = &**points else { panic!("two points") };
    assert_eq!(at(from.span), "p[i-1]");
    assert_eq!(at(from.parts[0].span), "[i-1]");
    assert_eq!(at(to.parts[0].span), ".B");
    assert_eq!(at(value.span), "(1+2).x");
    let Node::Component(sum, _) = &value.node else { panic!("a component") };
    assert_eq!(at(sum.span), "(1+2)");
    let Node::Binary(_, operands) = &sum.node else { panic!("a sum") };
    assert_eq!(at(operands[1].span), "2");
}

#[test]
fn a_statement_is_read_when_it_is_asked_for() {
    let mut statements = parse(SourceId(0), "step\nlenght A\nstep\nprint (");
    assert!(matches!(statements.next(), Some(Ok(_))));
    assert!(matches!(statements.next(), Some(Err(_))));
    assert!(matches!(statements.next(), Some(Ok(_))));
    assert!(matches!(statements.next(), Some(Err(_))));
    assert_eq!(statements.next(), None);
}

#[test]
fn many_shapes_are_told_apart() {
    let word = |i: usize| "ab".repeat(i);
    // Each three times, then all of them again.
    let shapes = (0..2).flat_map(|_| 1..200).flat_map(|i| [(i, 3), (i, 40), (i, 500)]);
    let texts: Vec<String> = shapes
        .map(|(i, n)| format!("{}{n}: length {} p[{n}] = {i}.5", word(i % 90 + 1), word(i)))
        .collect();
    assert_eq!(canonical(&texts.join("\n")), texts);
}

#[test]
fn the_grammar_takes_digits_as_they_come() {
    let grammar = include_str!("../../../grammar/linkwork.pest");
    for line in grammar.lines().filter(|line| !line.starts_with("//")) {
        assert!(!line.contains(|c: char| c.is_ascii_digit()), "{line}");
        let looks_at_one = |rule: &str| {
            let mut uses = line.match_indices(rule);
            uses.any(|(at, _)| {
                let (before, behind) = (&line[..at], &line[at + rule.len()..]);
                !before.ends_with('!') && !behind.starts_with(['*', '+'])
            })
        };
        assert!(!looks_at_one("ASCII_DIGIT"), "{line}");
        let defines = line.starts_with("word_char =");
        assert!(defines || !looks_at_one("word_char"), "{line}");
        assert!(defines || !line.contains("ASCII_ALPHANUMERIC"), "{line}");
    }
}

#[test]
fn a_function_is_told_by_its_digits() {
    let atan = |n| format!("let a{n} = atan{n}(1, {n})");
    let read = canonical(&[atan(2), atan(2), atan(2), atan(31), atan(2)].join("\n"));
    let refused = canonical(&atan(31)).concat();
    assert!(refused.starts_with("error: "), "{refused}");
    assert_eq!(read, [atan(2), atan(2), atan(2), refused, atan(2)]);
}

#[test]
fn a_session_knows_when_to_ask_for_more() {
    let check = |text: &str, wanted| assert_eq!(is_incomplete(text), wanted, "of {text:?}");
    for open in [
        "for i in 1..3 {",
        "for i in 1..3 {\n  step",
        "for i in 1..3 { for j in 1..i {\n",
        "for i in 1..3 { lenght A B\n",
        "define d(A,\n",
        "print (1 +",
        "print p[",
        "print max(1, # more\n",
        "point A = (0, 0),",
        "point A = (0, 0),  # and\n",
        "length A \\",
        "length A B \\\n",
        "step; print 1,",
    ] {
        check(open, true);
    }
    for whole in [
        "",
        "step",
        "length A",
        "length A B =",
        "for i in 1..3 { step }",
        "for i in 1..3",
        "lenght A (",
        "for i on 1..3 {",
        "for i in 1..3 { )",
        "print )(",
        "print (1]",
        "print \"(",
        "print # (",
        "nonsense here,",
        "print 1 2,",
        "print (1 2",
        "print (1; step",
    ] {
        check(whole, false);
    }
}
