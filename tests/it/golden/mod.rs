//! What is said, word for word, beside the texts it is said of.

mod lang_mistakes;
mod mistakes;
mod sessions;
