//! What expressions are worth, against closed forms.

mod functions;
mod long;
mod members;
mod rates;
mod turns;
