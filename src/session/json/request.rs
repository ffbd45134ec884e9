//! Requests of a program that holds a session: a text to be run whole, or a question, each answered by
//! objects of which the last says that it is done.

use serde_json::{Value, json};

use super::host::Objects;
use super::objects;
use crate::diag::Diagnostic;
use crate::errors;
use crate::render::svg;
use crate::session::Session;
use crate::session::execution::Flow;
use crate::session::host::Host as _;
use crate::session::transcript::{Outcome, Transcript};

/// What a request may ask for.
const QUESTIONS: [&str; 4] = ["traces", "measures", "svg", "script"];

/// Whether a line is a request: no statement begins with a brace.
pub fn is_request(line: &str) -> bool {
    line.trim_start().starts_with('{')
}

/// Answers a request, in objects.
pub fn answer_request(line: &str, session: &mut Session, host: &mut Objects) -> Outcome {
    let request: Value = match serde_json::from_str(line) {
        Ok(request) => request,
        Err(e) => return refuse(format!("this is no request: {e}"), &Value::Null, session, host),
    };
    let id = &request["id"];
    let outcome = match (request["run"].as_str(), request["get"].as_str()) {
        (Some(text), None) => Transcript::request("<request>").enter(text, session, host),
        (None, Some("traces")) => say(&objects::traces(session.world()), host),
        (None, Some("measures")) => say(&objects::measures(session.world()), host),
        (None, Some("svg")) => {
            let options = session.picture_options();
            let picture = svg(&session.scene(), &options);
            say(&json!({ "type": "svg", "svg": picture }), host)
        }
        (None, Some("script")) => {
            say(&json!({ "type": "script", "script": session.to_script() }), host)
        }
        (None, Some(other)) => {
            let known = QUESTIONS.join(", ");
            return refuse(format!("`get` knows {known}, not `{other}`"), id, session, host);
        }
        _ => {
            let message = "expected `{\"run\": \"STATEMENTS\"}` or `{\"get\": \"traces\"}`";
            return refuse(message.to_owned(), id, session, host);
        }
    };
    let is_done = outcome.failure.is_none() && outcome.flow != Flow::Stopped;
    host.put(&objects::done(id, is_done));
    outcome
}

fn say(object: &Value, host: &mut Objects) -> Outcome {
    host.put(object);
    Outcome { flow: Flow::On, failure: None }
}

fn refuse(message: String, id: &Value, session: &Session, host: &mut Objects) -> Outcome {
    let problem = Diagnostic::error(errors::NO_REQUEST, message);
    host.tell(&problem, session.sources());
    host.put(&objects::done(id, false));
    Outcome { flow: Flow::On, failure: Some(problem) }
}
