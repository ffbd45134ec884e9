//! The constraints of the language: a row says all of the statement of one but its rule.

use super::{Entry, Section};
use crate::lang::constraint::{Part, Role};
use crate::lang::grammar::Rule;

/// How the statement of a constraint is written.
#[derive(Debug)]
pub struct Pattern {
    /// Its parts, in canonical order. All but points can be changed.
    pub slots: &'static [Slot],
    /// What `change` can change, for a message.
    pub takes: &'static str,
    /// What `help` says of it.
    pub entry: Entry,
    /// The rule that reads it.
    pub(in crate::lang) rule: Rule,
}

/// A part of a statement, as it is written and what it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Slot {
    /// So many points in a row.
    Points(usize),
    /// All the points there are.
    AllPoints,
    /// The name of what is made.
    Defined,
    /// One point, said by a word, or with `on` a circle or an arc.
    Point(Role),
    /// The points of a line, or a circle or an arc.
    Touching,
    /// An expression that is held.
    Measure,
    /// Two points of a line; that which angles are measured from may be left out.
    Line(Role),
    /// What holds for the measured value: without one the present value is kept, or this one.
    Relation {
        /// The value that is meant where none is given.
        default: Option<f64>,
    },
    /// A number.
    Value(Role),
    /// A number that may be left out: then it is this one, or what the kind makes of it.
    Optional(Role, Option<f64>),
    /// The ratio of two wheels, or the teeth of both.
    Gearing,
    /// A vector.
    Place(Role),
    /// A word alone.
    Flag(Role),
}

impl Pattern {
    /// Where a part stands in the statement; points come first.
    pub(in crate::lang) fn place(&self, part: &Part) -> usize {
        self.slot(part).and_then(|slot| self.slots.iter().position(|s| *s == slot)).unwrap_or(0)
    }

    /// The slot that a part goes into, if there is one.
    pub fn slot(&self, part: &Part) -> Option<Slot> {
        let fits = |slot: &&Slot| match (slot, part) {
            (Slot::Relation { .. }, Part::Relation(_)) => true,
            (Slot::Line(role), Part::Line(given, _))
            | (
                Slot::Value(role) | Slot::Optional(role, _) | Slot::Place(role),
                Part::Value(given, _),
            )
            | (Slot::Point(role), Part::Point(given, _))
            | (Slot::Flag(role), Part::Flag(given)) => role == given,
            (Slot::Gearing, Part::Value(given, _)) => *given == Role::Ratio,
            (Slot::Gearing, Part::Values(given, _)) => *given == Role::Teeth,
            // Where on a bar a point is can be called a ratio too.
            _ => matches!((slot, part), (Slot::Value(Role::At), Part::Value(Role::Ratio, _))),
        };
        self.slots.iter().find(fits).copied()
    }

    /// How many groups of points come first, before any line.
    pub fn n_point_groups(&self) -> usize {
        let is_points = |slot: &&Slot| matches!(slot, Slot::Points(_) | Slot::AllPoints);
        self.slots.iter().filter(is_points).count()
    }

    /// Whether its statement can say what holds for the measured value.
    pub fn has_relation(&self) -> bool {
        self.slots.iter().any(|slot| matches!(slot, Slot::Relation { .. }))
    }
}

macro_rules! constraints {
    ($($Word:ident $rule:ident {
        slots: $slots:expr,
        takes: $takes:expr,
        usage: $usage:expr,
        summary: $summary:expr,
        help: $help:expr,
        example: $example:expr,
    })*) => {
        /// The words that state a constraint.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum ConstraintWord {
            $(
                #[doc = concat!("`", $usage, "`")]
                $Word,
            )*
        }

        impl ConstraintWord {
            /// All of them, in the order of the reference.
            pub const ALL: &'static [Self] = &[$(Self::$Word),*];

            /// The one that is written so.
            pub fn named(word: &str) -> Option<Self> {
                match word {
                    $(stringify!($rule) => Some(Self::$Word),)*
                    _ => None,
                }
            }

            /// How its statement is written.
            pub const fn pattern(self) -> &'static Pattern {
                match self {
                    $(Self::$Word => &Pattern {
                        slots: &$slots,
                        takes: $takes,
                        rule: Rule::$rule,
                        entry: Entry {
                            keyword: stringify!($rule),
                            section: Section::Constraints,
                            usage: $usage,
                            summary: $summary,
                            help: $help,
                            example: $example,
                        },
                    },)*
                }
            }
        }
    };
}

use Slot::{
    AllPoints, Defined, Flag, Gearing, Line, Measure, Optional, Place, Point, Points, Relation,
    Touching, Value,
};

/// What is said of one that is points and nothing else.
const NOTHING: &str = "this constraint has no part that can be changed";

// Each with the rule that reads it, which is called like its word. A new constraint is one more
// row.
constraints! {
    Coordinate coordinate {
        slots: [Points(1), Place(Role::At)],
        takes: "a coordinate takes `at (x, y)`",
        usage: "coordinate P at POSITION",
        summary: "a point stays at a place (3.1)",
        help: "",
        example: "coordinate A at (3, 4)",
    }
    Coincidence coincidence {
        slots: [Points(2)],
        takes: NOTHING,
        usage: "coincidence P Q",
        summary: "two points are in one place (3.2)",
        help: "",
        example: "coincidence A B",
    }
    Equivalence equivalence {
        slots: [Points(2), Points(2)],
        takes: NOTHING,
        usage: "equivalence A B, C D",
        summary: "the vector AB equals the vector CD (3.3)",
        help: "",
        example: "equivalence A B, C D",
    }
    Equal equal {
        slots: [
            Points(2),
            Points(2),
            Optional(Role::Ratio, Some(1.0)),
            Relation { default: Some(0.0) },
        ],
        takes: "this takes `ratio r`, `= value`, `<= value`, `>= value` or `in a..b`",
        usage: "equal A B, C D [ratio R] [RELATION]",
        summary: "the distances AB and CD are equal, or AB is R times CD (3.4)",
        help: "With `in a..b`, `<= e` or `>= e` what is bounded is the difference AB - R CD.",
        example: "equal A B, C D\n\
             equal A B, C D ratio 2\n\
             equal A B, C D ratio 2 in -1..1",
    }
    Length length {
        slots: [Points(2), Relation { default: None }],
        takes: "this takes `= value`, `<= value`, `>= value` or `in a..b`",
        usage: "length A B [RELATION]",
        summary: "the distance of two points (3.5)",
        help: "The relation is `= e`, `<= e`, `>= e` or `in a..b`; without one the present value is kept.\n\
             A cord is `<=`, a telescope `in`; an expression with `time` makes an actuator.",
        example: "coupler: length B C = 3.5\n\
             length A B <= 5\n\
             length A B in 2..5",
    }
    Orientation orientation {
        slots: [Points(2), Points(2), Relation { default: None }],
        takes: "an orientation takes `= angle`, `<= angle`, `>= angle` or `in a..b`",
        usage: "orientation A B, C D [RELATION]",
        summary: "the angle from AB to CD, counter-clockwise positive (3.6)",
        help: "The relation is `= e`, `<= e`, `>= e` or `in a..b`; without one the present value is kept.",
        example: "orientation A B, C D = 90deg",
    }
    Motor motor {
        slots: [
            Points(2),
            Line(Role::From),
            Optional(Role::Radius, None),
            Optional(Role::Speed, None),
            Optional(Role::Phase, None),
        ],
        takes: "a motor takes `radius`, `speed`, `phase` and `from A B`",
        usage: "motor O P [radius R] [speed W] [phase PHI] [from A B]",
        summary: "P goes round O (3.7)",
        help: "The parts come in any order. Radius and phase are the present ones unless given.\n\
             The angle grows by speed times dt each frame, so a change of speed makes no jump.\n\
             It is measured from the x axis, or from the direction AB: a motor between two links.",
        example: "crank: motor O P radius 1 speed 1rev phase 90deg\n\
             motor E H speed 1rev from S E",
    }
    Glider glider {
        slots: [Points(1), Line(Role::On), Point(Role::On), Flag(Role::Unbounded)],
        takes: "a glider takes `on A B` and `unbounded`",
        usage: "glider P on A B|CURVE [unbounded]",
        summary: "P slides on the segment AB, on the whole line (3.8), or on a circle or an arc",
        help: "The ends of a segment and of an arc are end stops; `unbounded` stands for the whole line, and\n\
             for the whole circle of an arc.",
        example: "glider P on A B\n\
             glider P on A B unbounded\n\
             glider P on c",
    }
    Hinge hinge {
        slots: [Points(1), Line(Role::On), Value(Role::At)],
        takes: "a hinge takes `on A B` and `at ratio`",
        usage: "hinge P on A B at RATIO",
        summary: "P is fixed on the bar AB: P = A + ratio (B - A) (3.9)",
        help: "An engineer's pin, about which two bars turn, is a point that both share: `length A P` and\n\
             `length P B` meet in the pin P. A hinge fixes a point on a bar, between its ends or beyond.",
        example: "hinge P on A B at 1/3",
    }
    Cog cog {
        slots: [Points(2), Points(2), Gearing, Flag(Role::Inside)],
        takes: "cogs take `ratio r`, `teeth n1, n2` and `inside`",
        usage: "cog O1 A, O2 B ratio R | teeth N1, N2 [inside]",
        summary: "two wheels roll on each other, R the ratio of their radii (3.10)",
        help: "A is on the rim of the wheel round O1, B of that round O2; R = r2 / r1.\n\
             A negative ratio, or `inside`, is for internal contact. By teeth, R = N2 / N1.",
        example: "cog O1 A, O2 B ratio 4\n\
             cog O1 A, O2 B teeth 20, 60 inside",
    }
    Distance distance {
        slots: [Points(1), Line(Role::To), Relation { default: None }],
        takes: "a distance takes `= value`, `<= value`, `>= value`, `in a..b` and `to A B`",
        usage: "distance P to A B [RELATION]",
        summary: "the distance of P from the line AB, positive on its left",
        help: "The relation is `= e`, `<= e`, `>= e` or `in a..b`; without one the present value is kept.",
        example: "distance P to A B = 2",
    }
    Parallel parallel {
        slots: [Points(2), Points(2)],
        takes: NOTHING,
        usage: "parallel A B, C D",
        summary: "AB and CD have one direction, or opposite ones",
        help: "The nearest of the two.",
        example: "parallel A B, C D",
    }
    Perpendicular perpendicular {
        slots: [Points(2), Points(2)],
        takes: NOTHING,
        usage: "perpendicular A B, C D",
        summary: "AB and CD are at right angles",
        help: "The nearest of the two senses.",
        example: "perpendicular A B, C D",
    }
    Rigid rigid {
        slots: [AllPoints],
        takes: NOTHING,
        usage: "rigid A B C ...",
        summary: "points keep their present shape",
        help: "One constraint for all of them.",
        example: "rigid A B C D",
    }
    Rack rack {
        slots: [Points(2), Line(Role::On), Optional(Role::Radius, None)],
        takes: "a rack takes `on P Q` and `radius r`",
        usage: "rack O A on P Q [radius R]",
        summary: "a wheel rolls along a line without slipping",
        help: "O is the centre of the wheel and A a point of its rim, or any other point that turns with \
             it. The radius is the height of O over the line as it stands: where the rim touches.\n\
             With `radius` it is the pitch radius R at any height, on the side of the line where O is\n\
             at the start, the left if on none. The height is not held.",
        example: "rack O A on P Q\n\
             rack O A on P Q radius 0.13",
    }
    Horizontal horizontal {
        slots: [Points(2)],
        takes: NOTHING,
        usage: "horizontal A B",
        summary: "A and B have one y: the line through them is horizontal",
        help: "Either may be on the left, and they may be in one place.",
        example: "horizontal A B",
    }
    Vertical vertical {
        slots: [Points(2)],
        takes: NOTHING,
        usage: "vertical A B",
        summary: "A and B have one x: the line through them is vertical",
        help: "Either may be on top, and they may be in one place.",
        example: "vertical A B",
    }
    Symmetric symmetric {
        slots: [Points(2), Line(Role::About)],
        takes: "a symmetry takes `about P Q`",
        usage: "symmetric A B about P Q",
        summary: "B is the mirror image of A in the line PQ",
        help: "All four may move: the axis gives way as the points do.",
        example: "symmetric A B about P Q",
    }
    Belt belt {
        slots: [Points(2), Points(2), Gearing, Flag(Role::Crossed)],
        takes: "a belt takes `ratio r`, `teeth n1, n2` and `crossed`",
        usage: "belt O1 A, O2 B ratio R | teeth N1, N2 [crossed]",
        summary: "a belt turns two wheels together, R the ratio of their radii",
        help: "A turns with the wheel round O1, B with that round O2; R = r2 / r1, at any distance.\n\
             Both turn the same way, or with `crossed` opposite ways. What counts is how far each turns\n\
             against the line O1 O2: where one centre is carried round the other, the wheels turn too.\n\
             The distance is not held: a belt has a tensioner.",
        example: "belt O1 A, O2 B ratio 2\n\
             belt O1 A, O2 B teeth 20, 40 crossed",
    }
    Hold hold {
        slots: [Measure, Relation { default: None }],
        takes: "this takes `= value`, `<= value`, `>= value` or `in a..b`",
        usage: "hold EXPRESSION RELATION",
        summary: "an equation or inequality between whatever can be measured",
        help: "The expressions are numbers, or with `=` vectors. Both sides give way: all points that they \
             measure may move, but for frozen ones.\n\
             `change h = 5` puts something else on the right side.",
        example: "rope: hold distance(A, B) + 2 * distance(B, C) = 9\n\
             hold A.x = 4\n\
             hold P = midpoint(A, B)\n\
             hold angle(A, B) in -30deg..30deg",
    }
    Circle circle {
        slots: [Defined, Points(1), Optional(Role::Radius, None), Point(Role::Through)],
        takes: "a circle takes `radius r`",
        usage: "circle NAME = O radius R | through P",
        summary: "a circle, to be named by others",
        help: "It asks for nothing by itself: P is free to turn round O and to change the radius, unless others\n\
             hold it. `glider` and `tangent` name it, and `NAME.radius` is its radius.",
        example: "circle c = O radius 5\n\
             circle d = O through R",
    }
    Arc arc {
        slots: [Defined, Points(1), Point(Role::From), Point(Role::To)],
        takes: NOTHING,
        usage: "arc NAME = O from P to Q",
        summary: "the part of a circle round O from P counter-clockwise to Q",
        help: "It keeps OP and OQ equal. `glider` and `tangent` name it, and `NAME.radius` is its radius.",
        example: "arc a = O from P to Q",
    }
    Tangent tangent {
        slots: [Touching, Touching, Flag(Role::Inside), Point(Role::At)],
        takes: NOTHING,
        usage: "tangent A B|CURVE to CURVE|A B [inside] [at P]",
        summary: "a line touches a circle, or two circles each other",
        help: "A line touches on the side where it is at the start; two circles touch outside, or with\n\
             `inside` one in the other. An arc means its whole circle.\n\
             With `at P`, P is on both already, as a common end or a glider: only the common direction is\n\
             asked for, with the sense of the start.",
        example: "tangent A B to c\n\
             tangent c to d inside\n\
             tangent A B to a at B",
    }
}
