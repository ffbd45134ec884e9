//! What expressions are worth, against closed forms.

mod functions;
mod rates;
