//! Trees of every sort of statement, as random as the parser could make them.

use std::sync::Arc;

use linkwork::diag::{SourceId, Span};
use linkwork::lang::ast::*;
use linkwork::lang::catalogue::Slot;
use proptest::collection::vec;
use proptest::option::of;
use proptest::prelude::*;
use proptest::sample::select;

/// Any statement, blocks within blocks included.
pub fn statement() -> BoxedStrategy<Statement> {
    let leaf = simple_command().prop_map(stated).boxed();
    leaf.prop_recursive(3, 12, 4, |inner| {
        let body = vec(inner, 0..4).prop_map(Body::from).boxed();
        prop_oneof![
            simple_command().prop_map(stated),
            (ident(), range(), body.clone()).prop_map(|(variable, range, body)| {
                stated(Building::For { variable, range, body })
            }),
            (ident(), vec(ident(), 0..4), body).prop_map(|(name, mut parameters, body)| {
                let mut seen: Vec<Ident> = Vec::new();
                parameters.retain(|parameter| {
                    let is_new = !seen.contains(parameter);
                    seen.push(parameter.clone());
                    is_new
                });
                stated(Building::Define(Arc::new(Definition { name, parameters, body })))
            }),
        ]
    })
    .boxed()
}

fn stated(command: impl Into<Command>) -> Statement {
    Statement { command: command.into(), span: SPAN }
}

const SPAN: Span = Span { source: SourceId(0), start: 0, end: 0 };

fn simple_command() -> BoxedStrategy<Command> {
    prop_oneof![
        15 => constraint_decl().prop_map(|decl| Command::Constrain(Box::new(decl))),
        8 => making().prop_map(Command::from),
        12 => changing().prop_map(Command::from),
        6 => running().prop_map(Command::from),
        12 => looking().prop_map(Command::from),
        4 => measuring().prop_map(Command::from),
        8 => pictures().prop_map(Command::from),
        6 => building().prop_map(Command::from),
    ]
    .boxed()
}

fn making() -> BoxedStrategy<Making> {
    let binding = (name(), expr()).prop_map(|(name, value)| Binding { name, value });
    let point = (name(), expr(), any::<bool>()).prop_map(|(name, at, frozen)| PointDecl {
        name,
        at,
        frozen,
    });
    let targets = || {
        let target = (name(), vec(expr(), 1..4));
        vec(target.prop_map(|(point, places)| DragTarget { point, places }), 1..3)
    };
    prop_oneof![
        vec(binding, 1..3).prop_map(Making::Let),
        vec(point, 1..3).prop_map(Making::Point),
        selection().prop_map(Making::Freeze),
        selection().prop_map(Making::Thaw),
        (name(), expr()).prop_map(|(point, to)| Making::Move { point, to }),
        (targets(), of(expr())).prop_map(|(targets, over)| Making::Drag { targets, over }),
        (targets(), of(expr())).prop_map(|(targets, over)| Making::Pull { targets, over }),
    ]
    .boxed()
}

fn constraint_decl() -> BoxedStrategy<ConstraintDecl> {
    (of(name()), constraint())
        .prop_map(|(label, constraint)| ConstraintDecl { label, constraint })
        .boxed()
}

/// Any of them, each part that may be left out there or not.
fn constraint() -> BoxedStrategy<Constraint> {
    let parts = |word: ConstraintWord| {
        let slots = word.pattern().slots.iter().map(|&slot| slot_part(word, slot));
        slots.collect::<Vec<_>>().prop_map(move |parts| Constraint {
            word,
            parts: parts.into_iter().flatten().collect(),
        })
    };
    select(ConstraintWord::ALL).prop_flat_map(parts).boxed()
}

/// A name that is no word of a statement with gliders or tangents.
fn plain_name() -> BoxedStrategy<Name> {
    let words = ["inside", "unbounded", "at", "to"];
    name().prop_filter("a word", move |name| !words.contains(&&*name.to_string())).boxed()
}

/// What may stand in a slot of a statement.
fn slot_part(word: ConstraintWord, slot: Slot) -> BoxedStrategy<Option<Part>> {
    match slot {
        Slot::Points(n) => vec(name(), n).prop_map(|names| Some(Part::Points(names))).boxed(),
        Slot::AllPoints => vec(name(), 2..5).prop_map(|names| Some(Part::Points(names))).boxed(),
        Slot::Line(role) if word == ConstraintWord::Glider => (name(), plain_name())
            .prop_map(move |(from, to)| Some(Part::Line(role, Pair { from, to })))
            .boxed(),
        Slot::Line(role) => pair().prop_map(move |pair| Some(Part::Line(role, pair))).boxed(),
        Slot::Defined => name().prop_map(|name| Some(Part::Defined(name))).boxed(),
        Slot::Point(Role::On) => Just(None).boxed(),
        Slot::Point(role) if word == ConstraintWord::Arc => {
            name().prop_map(move |name| Some(Part::Point(role, name))).boxed()
        }
        Slot::Point(role) if word == ConstraintWord::Tangent => {
            of(name()).prop_map(move |name| Some(Part::Point(role, name?))).boxed()
        }
        Slot::Point(_) => Just(None).boxed(),
        // What may be a word of the statement is taken for one.
        Slot::Touching => {
            vec(plain_name(), 1..3).prop_map(|names| Some(Part::Points(names))).boxed()
        }
        Slot::Optional(role, _) if word == ConstraintWord::Circle => {
            expr().prop_map(move |value| Some(Part::Value(role, value))).boxed()
        }
        Slot::Measure => expr().prop_map(|value| Some(Part::Measure(value))).boxed(),
        Slot::Relation { .. } if word == ConstraintWord::Hold => {
            relation().prop_map(|relation| Some(Part::Relation(relation))).boxed()
        }
        Slot::Relation { .. } => of(relation()).prop_map(|of| of.map(Part::Relation)).boxed(),
        Slot::Optional(role, _) => {
            of(expr()).prop_map(move |value| Some(Part::Value(role, value?))).boxed()
        }
        Slot::Value(role) | Slot::Place(role) => {
            expr().prop_map(move |value| Some(Part::Value(role, value))).boxed()
        }
        Slot::Gearing => prop_oneof![
            expr().prop_map(|ratio| Part::Value(Role::Ratio, ratio)),
            [expr(), expr()].prop_map(|teeth| Part::Values(Role::Teeth, Box::new(teeth))),
        ]
        .prop_map(Some)
        .boxed(),
        Slot::Flag(role) => {
            any::<bool>().prop_map(move |is_said| is_said.then_some(Part::Flag(role))).boxed()
        }
    }
}

fn changing() -> BoxedStrategy<Changing> {
    prop_oneof![
        (names(), any::<bool>()).prop_map(|(names, cascade)| Changing::Delete { names, cascade }),
        names().prop_map(Changing::Off),
        names().prop_map(Changing::On),
        (name(), change_parts()).prop_map(|(name, parts)| Changing::Change { name, parts }),
        of(ident()).prop_map(Changing::Settings),
        (ident(), expr(), vec(name(), 0..3)).prop_map(|(setting, value, targets)| Changing::Set {
            setting,
            value,
            targets
        }),
        of(expr()).prop_map(Changing::Undo),
        of(expr()).prop_map(Changing::Redo),
        Just(Changing::Reset),
        Just(Changing::Clear),
    ]
    .boxed()
}

/// Each sort of part at most once, one at least.
fn change_parts() -> BoxedStrategy<Vec<Part>> {
    let all =
        (relation(), vec(expr(), 5), pair(), pair()).prop_map(|(relation, values, on, to)| {
            let roles = [Role::Radius, Role::Speed, Role::Phase, Role::At, Role::Ratio];
            let values = roles.into_iter().zip(values).map(|(role, e)| Part::Value(role, e));
            let flags = [Role::Inside, Role::Crossed, Role::Unbounded].map(Part::Flag);
            let lines = [Part::Line(Role::On, on), Part::Line(Role::To, to)];
            let relation = [Part::Relation(relation)];
            relation.into_iter().chain(values).chain(flags).chain(lines).collect::<Vec<_>>()
        });
    all.prop_shuffle().prop_flat_map(|all| proptest::sample::subsequence(all, 1..=3)).boxed()
}

fn running() -> BoxedStrategy<Running> {
    prop_oneof![
        (of(expr()), promise()).prop_map(|(frames, promise)| Running::Step { frames, promise }),
        (expr(), promise()).prop_map(|(time, promise)| Running::Run { time, promise }),
        of(expr()).prop_map(Running::Relax),
        promise().prop_map(Running::Solve),
    ]
    .boxed()
}

fn looking() -> BoxedStrategy<Looking> {
    let item = prop_oneof![
        expr().prop_map(PrintItem::Value),
        (expr(), select(Unit::ALL.to_vec())).prop_map(|(e, unit)| PrintItem::InUnit(e, unit)),
        text().prop_map(PrintItem::Text)
    ];
    prop_oneof![
        of(select(ListWhat::ALL.to_vec())).prop_map(Looking::List),
        of(name()).prop_map(Looking::Show),
        vec(item.clone(), 1..4).prop_map(Looking::Print),
        vec(item, 1..4).prop_map(Looking::Bare),
        Just(Looking::Check),
        name().prop_map(Looking::Why),
        name().prop_map(Looking::Limits),
        Just(Looking::Effects),
        promise().prop_map(Looking::Accuracy),
        (expr(), relation(), of(expr())).prop_map(|(left, relation, within)| Looking::Assert {
            left,
            relation,
            within
        }),
        of(ident()).prop_map(Looking::Help),
        of(ident()).prop_map(Looking::Examples),
        Just(Looking::History),
        Just(Looking::Quit),
    ]
    .boxed()
}

fn fit_range() -> BoxedStrategy<FitRange> {
    (name(), range()).prop_map(|(name, range)| FitRange { name, range }).boxed()
}

fn goal() -> BoxedStrategy<Goal> {
    prop_oneof![
        expr().prop_map(Goal::Minimise),
        expr().prop_map(Goal::Maximise),
        text().prop_map(Goal::Path),
    ]
    .boxed()
}

fn column() -> BoxedStrategy<Column> {
    let unit = prop_oneof![Just(Unit::None), select(Unit::ALL.to_vec())];
    (expr(), unit).prop_map(|(value, unit)| Column { value, unit }).boxed()
}

fn curves() -> BoxedStrategy<Curves> {
    (vec(expr(), 1..3), expr()).prop_map(|(up, against)| Curves { up, against }).boxed()
}

fn measuring() -> BoxedStrategy<Measuring> {
    let unit = || prop_oneof![Just(Unit::None), select(Unit::ALL.to_vec())];
    let label = prop_oneof![name().prop_map(Label::Name), text().prop_map(Label::Text)];
    let item =
        (label, expr(), unit()).prop_map(|(label, value, unit)| ResultItem { label, value, unit });
    prop_oneof![
        (name(), expr(), unit()).prop_map(|(name, value, unit)| Measuring::Measure {
            name,
            value,
            unit
        }),
        vec(item, 1..4).prop_map(Measuring::Result),
        (vec(fit_range(), 1..3), goal(), of(expr()))
            .prop_map(|(ranges, goal, over)| Measuring::Fit { ranges, goal, over }),
    ]
    .boxed()
}

fn pictures() -> BoxedStrategy<Drawing> {
    prop_oneof![
        (names(), of(text()), of(expr())).prop_map(|(names, label, every)| Drawing::Trace {
            names,
            label,
            every
        }),
        selection().prop_map(Drawing::Untrace),
        text().prop_map(Drawing::UntraceLabel),
        Just(Drawing::Expose(Expose::Now)),
        expr().prop_map(|frames| Drawing::Expose(Expose::Every(frames))),
        Just(Drawing::Expose(Expose::Off)),
        (text(), look()).prop_map(|(path, parts)| Drawing::Svg { path, parts }),
        (text(), vec(column(), 0..3), of(expr()), look()).prop_map(
            |(path, columns, every, parts)| { Drawing::Record { path, columns, every, parts } }
        ),
        (text(), export()).prop_map(|(path, parts)| Drawing::Export { path, parts }),
        Just(Drawing::RecordStop),
        (text(), vec(expr(), 1..4)).prop_map(|(series, values)| Drawing::Sample { series, values }),
        (of(text()), of(curves()), any::<bool>(), of(text()), of(text()), of(text())).prop_map(
            |(path, curves, is_log, title, x, y)| {
                let parts = [
                    is_log.then_some(PlotPart::Log),
                    title.map(PlotPart::Title),
                    x.map(PlotPart::X),
                    y.map(PlotPart::Y),
                ];
                Drawing::Plot { path, curves, parts: parts.into_iter().flatten().collect() }
            }
        ),
    ]
    .boxed()
}

fn look() -> BoxedStrategy<Vec<PicturePart>> {
    (of(expr()), any::<[bool; 3]>(), of(text()))
        .prop_map(|(width, [is_dark, is_transparent, is_nameless], title)| {
            let parts = [
                width.map(PicturePart::Width),
                is_dark.then_some(PicturePart::Dark),
                is_transparent.then_some(PicturePart::Transparent),
                is_nameless.then_some(PicturePart::WithoutNames),
                title.map(PicturePart::Title),
            ];
            parts.into_iter().flatten().collect()
        })
        .boxed()
}

fn export() -> BoxedStrategy<Vec<ExportPart>> {
    (of(ident()), of(expr()), of(expr()), of(expr()), of(expr()))
        .prop_map(|(unit, scale, width, hole, kerf)| {
            let parts = [
                unit.map(ExportPart::In),
                scale.map(ExportPart::Scale),
                width.map(ExportPart::Width),
                hole.map(ExportPart::Hole),
                kerf.map(ExportPart::Kerf),
            ];
            parts.into_iter().flatten().collect()
        })
        .boxed()
}

fn building() -> BoxedStrategy<Building> {
    prop_oneof![
        (ident(), vec(expr(), 0..4), of(name())).prop_map(|(definition, arguments, instance)| {
            Building::Use { definition, arguments, instance }
        }),
        text().prop_map(Building::Include),
        text().prop_map(Building::Save),
        text().prop_map(Building::SaveHistory),
        text().prop_map(Building::Load),
        (ident(), of(name()), vec(expr(), 0..5))
            .prop_map(|(what, name, values)| Building::Restore { what, name, values }),
    ]
    .boxed()
}

fn promise() -> BoxedStrategy<Promise> {
    (of(expr()), of(expr())).prop_map(|(within, in_time)| Promise { within, in_time }).boxed()
}

fn relation() -> BoxedStrategy<Relation> {
    prop_oneof![
        expr().prop_map(Relation::Equal),
        expr().prop_map(Relation::Less),
        expr().prop_map(Relation::LessEqual),
        expr().prop_map(Relation::Greater),
        expr().prop_map(Relation::GreaterEqual),
        range().prop_map(Relation::In),
    ]
    .boxed()
}

fn range() -> BoxedStrategy<Range> {
    (expr(), expr()).prop_map(|(from, to)| Range { from, to }).boxed()
}

fn selection() -> BoxedStrategy<Selection> {
    let names = names().prop_filter_map("`all` alone is every one", |names| match &*names {
        [name] if name.as_simple().is_some_and(|word| &*word.text == "all") => None,
        _ => Some(Selection::Names(names)),
    });
    prop_oneof![1 => Just(Selection::All), 4 => names].boxed()
}

fn names() -> BoxedStrategy<Vec<Name>> {
    vec(name(), 1..4).boxed()
}

fn pair() -> BoxedStrategy<Pair> {
    (name(), name()).prop_map(|(from, to)| Pair { from, to }).boxed()
}

fn text() -> BoxedStrategy<Text> {
    "[ -~é\n\t\\\\\"]{0,12}".prop_map(|value| Text { value: Arc::from(value), span: SPAN }).boxed()
}

/// Words, most of them also keywords somewhere.
fn ident() -> BoxedStrategy<Ident> {
    let words = [
        "A",
        "B",
        "p'",
        "_q1",
        "é",
        "r",
        "s",
        "ms",
        "deg",
        "e",
        "e1",
        "x",
        "y",
        "to",
        "in",
        "at",
        "on",
        "off",
        "all",
        "for",
        "as",
        "add",
        "over",
        "every",
        "within",
        "inside",
        "frozen",
        "cascade",
        "unbounded",
        "radius",
        "speed",
        "phase",
        "ratio",
        "step",
        "length",
        "point",
        "let",
        "stop",
        "sin",
        "distance",
        "set",
    ];
    select(words.to_vec()).prop_map(|word| Ident { text: Arc::from(word), span: SPAN }).boxed()
}

fn name() -> BoxedStrategy<Name> {
    name_over(leaf())
}

fn name_over(index: BoxedStrategy<Expr>) -> BoxedStrategy<Name> {
    let part = prop_oneof![
        ident().prop_map(|word| PartKind::Member(word.text)),
        index.prop_map(PartKind::Index),
    ]
    .prop_map(|kind| NamePart { kind, span: SPAN });
    let parts = prop_oneof![4 => Just(Vec::new()), 1 => vec(part, 1..3)];
    (ident(), parts)
        .prop_map(|(head, parts)| Name { head, parts: parts.into_boxed_slice(), span: SPAN })
        .boxed()
}

fn leaf() -> BoxedStrategy<Expr> {
    let size = prop_oneof![
        (0_u32..100).prop_map(f64::from),
        prop::num::f64::POSITIVE | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO,
    ];
    let unit = prop_oneof![Just(Unit::None), select(Unit::ALL.to_vec())];
    let number = (size, unit).prop_filter_map("finite", |(written, unit)| {
        let number = Number { written: written.abs(), unit };
        number.value().is_finite().then_some(Node::Number(number))
    });
    let name = name_over(number.clone().prop_map(node).boxed());
    prop_oneof![
        4 => number,
        4 => name.prop_map(Node::Name),
        1 => select([Node::Pi, Node::Tau, Node::Time].to_vec()),
    ]
    .prop_map(node)
    .boxed()
}

fn expr() -> BoxedStrategy<Expr> {
    use Operator::{Add, Divide, Multiply, Power, Subtract};
    leaf()
        .prop_recursive(4, 16, 4, |inner| {
            let two = || (inner.clone(), inner.clone()).prop_map(|(a, b)| Box::new([a, b]));
            let op = select([Add, Subtract, Multiply, Divide, Power].to_vec());
            let axis = select([Axis::X, Axis::Y].to_vec());
            let call = (select(Function::ALL.to_vec()), vec(inner.clone(), 4)).prop_map(
                |(function, mut arguments)| {
                    let n = (1..=4).rev().find(|&n| function.takes(n)).expect("four at most");
                    arguments.truncate(n);
                    Node::Call(function, arguments)
                },
            );
            prop_oneof![
                inner.clone().prop_map(|of| Node::Negate(Box::new(of))),
                (op, two()).prop_map(|(op, operands)| Node::Binary(op, operands)),
                two().prop_map(Node::Vector),
                (inner.clone(), axis).prop_map(|(of, axis)| Node::Component(Box::new(of), axis)),
                call,
            ]
            .prop_map(node)
        })
        .boxed()
}

fn node(node: Node) -> Expr {
    Expr { node, span: SPAN }
}
