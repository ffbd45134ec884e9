//! What a session says, as JSON, for programs: one object a line, of one schema (docs/json.md).

mod answers;
mod host;
mod objects;
mod request;

pub use answers::{problem_alone, study_alone};
pub use host::Objects;
pub(super) use objects::variant;
pub use request::{answer_request, is_request};

/// The number of the schema. Fields and types are added under the same number; what would break who
/// reads them takes the next one.
pub const VERSION: u32 = 1;
