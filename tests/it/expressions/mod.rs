//! What expressions are worth, against closed forms.

mod functions;
mod members;
mod rates;
mod turns;
