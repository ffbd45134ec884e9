//! The methods, one file each, and what they have in common: a pose to improve, limits, and how
//! it ended.

pub mod anderson;
pub mod coefficient;
pub mod conjugate_gradient;
pub mod gauss_seidel;
pub mod gradient_descent;
pub mod limits;
pub mod minimum;
pub mod nesterov;
pub mod newton;
pub mod relaxation;
pub mod rows;
pub mod spectrum;
pub mod sweep;
pub mod workspace;

pub(crate) use limits::{Limits, Outcome};
pub(crate) use workspace::{Pose, Stiffness, Workspace};

use super::island::Island;
use super::report::Counters;
use super::settings::{Method, Settings};

/// One round of a method: at most the iterations that the limits allow. Gives the coefficient of
/// relaxation too, if the user's had to be lowered.
pub(crate) type Round =
    fn(&mut Island, &Settings, &Limits, &mut Counters) -> (Outcome, Option<f64>);

/// What a method does in a round; none for [`Method::Auto`], which is no one iteration.
pub(crate) fn round_of(method: Method) -> Option<Round> {
    match method {
        Method::Auto => None,
        Method::Relaxation => Some(relaxation::round),
        Method::Successive => Some(gauss_seidel::round),
        Method::Descent => Some(gradient_descent::round),
        Method::Newton => Some(newton::round),
        Method::Conjugate => Some(conjugate_gradient::round),
        Method::Nesterov => Some(nesterov::round),
        Method::Anderson => Some(anderson::round),
    }
}
