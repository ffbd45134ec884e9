//! `linkwork lsp`, talked to as an editor does.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

struct Editor {
    server: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    n_asked: u64,
}

const DOCUMENT: &str = "file:///nowhere/a%20script.link";

impl Editor {
    /// An editor that has greeted the server.
    fn open() -> Self {
        let mut server = Command::new(env!("CARGO_BIN_EXE_linkwork"))
            .arg("lsp")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let to = server.stdin.take().expect("a pipe");
        let from = BufReader::new(server.stdout.take().expect("a pipe"));
        let mut editor = Self { server, to, from, n_asked: 0 };
        let said = editor.ask("initialize", &json!({ "capabilities": {} }));
        assert_eq!(said["capabilities"]["hoverProvider"], true, "{said}");
        editor.tell("initialized", &json!({}));
        editor
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        write!(self.to, "Content-Length: {}\r\n\r\n{text}", text.len()).expect("the server reads");
    }

    fn tell(&mut self, method: &str, params: &Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn ask(&mut self, method: &str, params: &Value) -> Value {
        self.n_asked += 1;
        let id = self.n_asked;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        let answer = self.hear();
        assert_eq!(answer["id"], id, "{answer}");
        answer["result"].clone()
    }

    fn hear(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            self.from.read_line(&mut line).expect("the server answers");
            match line.trim_end().strip_prefix("Content-Length: ") {
                Some(text) => length = text.parse().expect("a number"),
                None if line.trim().is_empty() => break,
                None => {}
            }
        }
        let mut text = vec![0; length];
        self.from.read_exact(&mut text).expect("the server answers");
        serde_json::from_slice(&text).expect("an object")
    }

    /// Opens a document; gives what is wrong with it.
    fn open_text(&mut self, text: &str) -> Value {
        let document =
            json!({ "uri": DOCUMENT, "languageId": "linkwork", "version": 1, "text": text });
        self.tell("textDocument/didOpen", &json!({ "textDocument": document }));
        self.hear()["params"]["diagnostics"].clone()
    }

    /// Changes it.
    fn change_text(&mut self, text: &str) -> Value {
        let document = json!({ "uri": DOCUMENT, "version": 2 });
        let changes = json!([{ "text": text }]);
        self.tell(
            "textDocument/didChange",
            &json!({ "textDocument": document, "contentChanges": changes }),
        );
        self.hear()["params"]["diagnostics"].clone()
    }

    fn ask_at(&mut self, method: &str, line: u32, character: u32) -> Value {
        let position = json!({ "line": line, "character": character });
        self.ask(method, &json!({ "textDocument": { "uri": DOCUMENT }, "position": position }))
    }

    fn leave(mut self) {
        assert_eq!(self.ask("shutdown", &Value::Null), Value::Null);
        self.tell("exit", &Value::Null);
        assert!(self.server.wait().expect("it ends").success());
    }
}

#[test]
fn mistakes_are_told_where_they_are() {
    let mut editor = Editor::open();
    let found = editor.open_text("point A = (0, 0)\nlength A Bee = 3\nstep 1000000\nlenght A B\n");
    assert_eq!(found.as_array().map(Vec::len), Some(2), "{found}");
    assert_eq!(found[0]["code"], "E0201");
    assert_eq!(found[0]["range"]["start"], json!({ "line": 1, "character": 9 }));
    assert_eq!(found[0]["range"]["end"], json!({ "line": 1, "character": 12 }));
    assert_eq!(found[1]["code"], "E0101");
    let message = found[1]["message"].as_str().expect("a message");
    assert!(message.contains("did you mean `length`?"), "{message}");
    assert_eq!(editor.change_text("point A = (0, 0)\n"), json!([]));
    editor.leave();
}

#[test]
fn what_follows_from_a_mistake_is_not_told() {
    let mut editor = Editor::open();
    let found = editor.open_text("point A = (0, 0), B = (1, 1\nlength A B = 1\n");
    assert_eq!(found.as_array().map(Vec::len), Some(1), "{found}");
    let found = editor.change_text("point A = (Q, 0), B = (1, 1)\nlength A B = 1\nfreeze A\n");
    assert_eq!(found.as_array().map(Vec::len), Some(1), "{found}");
    assert_eq!(found[0]["code"], "E0201");
    editor.leave();
}

#[test]
fn words_are_explained_and_completed() {
    let mut editor = Editor::open();
    editor.open_text("point Anchor = (0, 0)\nmotor Anchor B\nfreeze An\nmot");
    let said = editor.ask_at("textDocument/hover", 1, 2);
    assert!(
        said["contents"]["value"].as_str().is_some_and(|text| text.contains("motor O P")),
        "{said}"
    );
    assert_eq!(editor.ask_at("textDocument/hover", 2, 8), Value::Null);
    let said = editor.ask_at("textDocument/completion", 2, 9);
    assert_eq!(said[0]["label"], "Anchor", "{said}");
    let said = editor.ask_at("textDocument/completion", 3, 3);
    assert_eq!(said[0]["label"], "motor", "{said}");
    editor.leave();
}

#[test]
fn a_document_is_formatted() {
    let mut editor = Editor::open();
    editor.open_text("point   A=(0,0)  # here\n");
    let options = json!({ "tabSize": 2, "insertSpaces": true });
    let params = json!({ "textDocument": { "uri": DOCUMENT }, "options": options });
    let edits = editor.ask("textDocument/formatting", &params);
    assert_eq!(edits[0]["newText"], "point A = (0, 0)  # here\n", "{edits}");
    editor.change_text("point A = (0, 0");
    assert_eq!(editor.ask("textDocument/formatting", &params), json!([]));
    editor.leave();
}
