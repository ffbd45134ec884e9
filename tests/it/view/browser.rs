//! A session of `linkwork view`, and what a browser does with it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, ChildStdin, Command, ExitStatus, Stdio};

use serde_json::{Value, json};
use tempfile::TempDir;
use tungstenite::client::IntoClientRequest;
use tungstenite::protocol::CloseFrame;
use tungstenite::{Message, WebSocket};

use crate::support::program::{PROGRAM, folder};

/// The program with a page, in a folder of its own.
pub struct Viewed {
    child: Child,
    stdin: Option<ChildStdin>,
    pub folder: TempDir,
    pub port: u16,
    pub token: String,
}

impl Viewed {
    /// A session on a script.
    pub fn on(script: &str) -> Self {
        Self::with(script, &[])
    }

    /// The same with arguments of the command line.
    pub fn with(script: &str, args: &[&str]) -> Self {
        let folder = folder(&[("scene.link", script)]);
        let mut child = Command::new(PROGRAM)
            .args(["view", "scene.link"])
            .args(args)
            .current_dir(folder.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let mut out = BufReader::new(child.stdout.take().expect("it is piped"));
        let mut line = String::new();
        out.read_line(&mut line).expect("it says where the page is");
        let address = line.trim().strip_prefix("http://127.0.0.1:").expect("an address");
        let (port, token) = address.trim_end_matches('/').split_once('/').expect("a token");
        let (port, token) = (port.parse().expect("a port"), token.to_owned());
        // What else it says is not looked at, and must not fill the pipe.
        std::thread::spawn(move || drop(out.read_to_end(&mut Vec::new())));
        let stdin = child.stdin.take();
        Self { child, stdin, folder, port, token }
    }

    /// Types a line at the prompt.
    pub fn enter(&mut self, line: &str) {
        let stdin = self.stdin.as_mut().expect("the session goes on");
        writeln!(stdin, "{line}").expect("the program reads");
    }

    /// Leaves the session; how the program ended.
    pub fn leave(&mut self) -> ExitStatus {
        drop(self.stdin.take());
        self.child.wait().expect("the program ends")
    }

    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Sends the head of a request, lines with single ends; gives all that is answered.
    pub fn request(&self, head: &str) -> String {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("it listens");
        let head = format!("{}\r\n\r\n", head.replace('\n', "\r\n"));
        stream.write_all(head.as_bytes()).expect("it reads");
        let mut answer = Vec::new();
        // Who hangs up has said all.
        drop(stream.read_to_end(&mut answer));
        String::from_utf8_lossy(&answer).into_owned()
    }

    /// A page that has said hello and was told everything.
    pub fn open(&self) -> Page {
        let mut page = self.knock().expect("there is room for a page");
        page.say(&json!({ "do": "hello", "protocol": 1 }));
        page.until_frame();
        page
    }

    /// A socket, if it is given one.
    pub fn knock(&self) -> Result<Page, tungstenite::Error> {
        let address = format!("ws://127.0.0.1:{}/{}/ws", self.port, self.token);
        let mut request = address.into_client_request()?;
        let origin = format!("http://127.0.0.1:{}", self.port);
        request.headers_mut().insert("Origin", origin.parse().expect("a header"));
        let stream = TcpStream::connect(("127.0.0.1", self.port))?;
        let (socket, _) =
            tungstenite::client(request, stream).map_err(|problem| match problem {
                tungstenite::HandshakeError::Failure(problem) => problem,
                tungstenite::HandshakeError::Interrupted(_) => unreachable!("the stream blocks"),
            })?;
        Ok(Page { socket, asked: 0, heard: Vec::new(), frame: Vec::new(), sees: true })
    }
}

impl Drop for Viewed {
    fn drop(&mut self) {
        drop(self.stdin.take());
        // It may have ended already.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

/// A page at a session.
pub struct Page {
    socket: WebSocket<TcpStream>,
    asked: u64,
    /// Texts that it was told, in their order.
    pub heard: Vec<Value>,
    /// The last frame.
    pub frame: Vec<u8>,
    /// Whether it says which frames it has shown.
    pub sees: bool,
}

impl Page {
    pub fn say(&mut self, message: &Value) {
        self.send(&message.to_string());
    }

    pub fn send(&mut self, message: &str) {
        self.socket.send(Message::text(message)).expect("the session listens");
    }

    /// The same, where the other side may have hung up.
    pub fn try_send(&mut self, message: String) -> bool {
        self.socket.send(Message::text(message)).is_ok()
    }

    /// Asks, and waits for the answer.
    pub fn ask(&mut self, mut message: Value) -> Value {
        self.asked += 1;
        let id = json!(self.asked);
        message["id"] = id.clone();
        self.say(&message);
        loop {
            self.hear();
            if let Some(answer) = self.heard.last().filter(|it| it["answer"] == id) {
                return answer.clone();
            }
        }
    }

    /// Carries out statements.
    pub fn exec(&mut self, text: &str) -> Value {
        self.ask(json!({ "do": "exec", "text": text }))
    }

    /// What a statement prints.
    pub fn print(&mut self, text: &str) -> Vec<String> {
        let answer = self.exec(text);
        assert_eq!(answer["ok"], true, "{answer}");
        let said = answer["said"].as_array().expect("a list").iter();
        let lines = said.filter(|it| it["kind"] == "line");
        lines.map(|it| it["text"].as_str().expect("a text").to_owned()).collect()
    }

    /// The script that makes the world as it is.
    pub fn script(&mut self) -> String {
        let answer = self.ask(json!({ "do": "file", "kind": "script" }));
        answer["text"].as_str().expect("a script").to_owned()
    }

    /// Hears one message; none if the other side has hung up.
    pub fn try_hear(&mut self) -> Result<(), Option<CloseFrame>> {
        match self.socket.read() {
            Ok(Message::Text(text)) => {
                self.heard.push(serde_json::from_str(&text).expect("JSON"));
            }
            Ok(Message::Binary(frame)) => {
                self.frame = frame.to_vec();
                if self.sees {
                    let seq = u64::from_le_bytes(self.frame[..8].try_into().expect("eight bytes"));
                    self.try_send(json!({ "do": "seen", "seq": seq }).to_string());
                }
            }
            Ok(Message::Close(frame)) => return Err(frame),
            Ok(_) => {}
            Err(_) => return Err(None),
        }
        Ok(())
    }

    pub fn hear(&mut self) {
        self.try_hear().expect("the session goes on");
    }

    /// Hears until the other side hangs up, and why it does.
    pub fn until_closed(&mut self) -> Option<CloseFrame> {
        loop {
            if let Err(frame) = self.try_hear() {
                return frame;
            }
        }
    }

    /// Hears until the next frame.
    pub fn until_frame(&mut self) {
        self.frame.clear();
        while self.frame.is_empty() {
            self.hear();
        }
    }

    /// What the clock of the last frame shows.
    pub fn time(&self) -> f64 {
        f64::from_le_bytes(self.frame[12..20].try_into().expect("eight bytes"))
    }

    /// Hears until time has passed.
    pub fn until_later(&mut self) {
        let before = self.time();
        while self.time() <= before {
            self.until_frame();
        }
    }

    /// Hears until something was told that fits.
    pub fn until(&mut self, fits: impl Fn(&Value) -> bool) -> Value {
        let mut n = 0;
        loop {
            if let Some(found) = self.heard[n..].iter().find(|it| fits(it)) {
                return found.clone();
            }
            n = self.heard.len();
            self.hear();
        }
    }

    /// The last message of a kind.
    pub fn last(&self, kind: &str) -> &Value {
        let of_kind = self.heard.iter().rev().filter_map(|message| message.get(kind));
        of_kind.into_iter().next().expect("it was told")
    }

    /// Where a point is, by the last frame.
    pub fn at(&self, handle: usize) -> [f64; 2] {
        let number = |k: usize| {
            let from = 24 + 16 * handle + 8 * k;
            f64::from_le_bytes(self.frame[from..from + 8].try_into().expect("eight bytes"))
        };
        [number(0), number(1)]
    }

    /// The statements of the journal that it was told, in their order.
    pub fn journal(&self) -> Vec<String> {
        let entries = self.heard.iter().filter_map(|message| message.get("journal")?.as_array());
        let texts = entries.flatten().map(|entry| entry["text"].as_str().expect("a text"));
        texts.map(str::to_owned).collect()
    }
}

impl Page {
    /// Says hello; an error if it is sent away.
    pub fn try_hear_hello(&mut self) -> Result<(), Option<CloseFrame>> {
        self.try_send(json!({ "do": "hello", "protocol": 1 }).to_string());
        self.try_hear()
    }

    /// Hears a message if one comes soon.
    pub fn try_hear_within_a_moment(&mut self) {
        let moment = std::time::Duration::from_millis(50);
        self.socket.get_ref().set_read_timeout(Some(moment)).expect("a time to wait");
        drop(self.try_hear());
        self.socket.get_ref().set_read_timeout(None).expect("no time to wait");
    }
}
