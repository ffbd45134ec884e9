//! What a value is.

/// What an argument or a result is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A number.
    Number,
    /// A vector.
    Vector,
}

impl Shape {
    /// The word for a message.
    pub const fn noun(self) -> &'static str {
        match self {
            Self::Number => "number",
            Self::Vector => "vector",
        }
    }
}
