//! `linkwork lsp`: a language server on standard input and output, for editors.
//!
//! A document is reviewed whenever it changes: what is wrong with it is told with codes and what
//! to type. Hovering asks the catalogue, completion the words and names there are, formatting is
//! that of `fmt`.

mod answers;
mod places;

use std::collections::HashMap;

use lsp_server::{Connection, ErrorCode, Message, Notification, Request, Response};
use serde_json::{Value, json};

use super::run::ExitStatus;

/// Serves an editor until it leaves.
pub fn serve() -> ExitStatus {
    let (connection, threads) = Connection::stdio();
    let capabilities = json!({
        // The whole text with each change: scripts are short.
        "textDocumentSync": { "openClose": true, "change": 1 },
        "hoverProvider": true,
        "completionProvider": {},
        "documentFormattingProvider": true,
    });
    let status = match connection.initialize(capabilities) {
        Ok(_) => Server { connection: &connection, texts: HashMap::new() }.answer_all(),
        Err(_) => ExitStatus::Unreadable,
    };
    drop(connection);
    match threads.join() {
        Ok(()) => status,
        Err(_) => ExitStatus::Unreadable,
    }
}

struct Server<'a> {
    connection: &'a Connection,
    /// The documents that are open, by their addresses.
    texts: HashMap<String, String>,
}

impl Server<'_> {
    fn answer_all(mut self) -> ExitStatus {
        for message in &self.connection.receiver {
            match message {
                Message::Request(request) => {
                    match self.connection.handle_shutdown(&request) {
                        Ok(false) => {}
                        Ok(true) => return ExitStatus::Fine,
                        Err(_) => return ExitStatus::Unreadable,
                    }
                    let response = self.respond(request);
                    self.send(response.into());
                }
                Message::Notification(notification) => self.note(&notification),
                Message::Response(_) => {}
            }
        }
        ExitStatus::Fine
    }

    /// An editor that is gone hears nothing; the loop ends by itself.
    fn send(&self, message: Message) {
        drop(self.connection.sender.send(message));
    }

    fn respond(&self, request: Request) -> Response {
        let text = self.texts.get(address(&request.params)).map_or("", String::as_str);
        let result = match request.method.as_str() {
            "textDocument/hover" => answers::hover(text, &request.params["position"]),
            "textDocument/completion" => answers::completion(text, &request.params),
            "textDocument/formatting" => answers::formatting(text),
            unknown => {
                let message = format!("no answer to {unknown}");
                return Response::new_err(request.id, ErrorCode::MethodNotFound as i32, message);
            }
        };
        Response::new_ok(request.id, result)
    }

    fn note(&mut self, notification: &Notification) {
        let params = &notification.params;
        let text = match notification.method.as_str() {
            "textDocument/didOpen" => &params["textDocument"]["text"],
            "textDocument/didChange" => &params["contentChanges"][0]["text"],
            "textDocument/didClose" => {
                self.texts.remove(address(params));
                return;
            }
            _ => return,
        };
        let Some(text) = text.as_str() else { return };
        let address = address(params).to_owned();
        let problems = answers::problems(text, &address);
        self.texts.insert(address.clone(), text.to_owned());
        let params = json!({ "uri": address, "diagnostics": problems });
        let method = "textDocument/publishDiagnostics".to_owned();
        self.send(Message::Notification(Notification { method, params }));
    }
}

/// The address of the document that a message is about.
fn address(params: &Value) -> &str {
    params["textDocument"]["uri"].as_str().unwrap_or_default()
}
