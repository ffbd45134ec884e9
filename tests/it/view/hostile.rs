//! Those who mean no good, and those who cannot help it: strangers, the slow, the loud.

use std::io::Write;
use std::net::TcpStream;

use serde_json::json;

use super::browser::{Page, Viewed};

const SCENE: &str = "point A = (0, 0) frozen, B = (3, 0), C = (6, 0)\nlength A B; length B C";

#[test]
fn strangers_get_nothing() {
    let viewed = Viewed::on(SCENE);
    let (port, token) = (viewed.port, &viewed.token);
    let status = |head: &str| {
        let answer = viewed.request(head);
        answer.split(' ').nth(1).unwrap_or_default().to_owned()
    };
    let upgrade = "Connection: Upgrade\nUpgrade: websocket\nSec-WebSocket-Version: 13\n\
                   Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==";
    let own = format!("Host: 127.0.0.1:{port}");
    assert_eq!(status(&format!("GET /{token}/ HTTP/1.1\n{own}")), "200");
    for what in ["", "ws"] {
        let ask = |path: &str, headers: &str| {
            status(&format!("GET {path} HTTP/1.1\n{headers}\n{upgrade}"))
        };
        let path = format!("/{token}/{what}");
        assert_eq!(ask(&path, "Host: evil.example"), "403");
        assert_eq!(ask(&path, &format!("Host: evil.example:{port}")), "403");
        assert_eq!(ask(&path, &format!("{own}\nOrigin: http://evil.example")), "403");
        assert_eq!(ask(&path, &format!("{own}\nOrigin: null")), "403");
        let other = token.replace(|c: char| c.is_ascii_digit(), "x");
        assert_eq!(ask(&format!("/{other}/{what}"), &own), "403");
        assert_eq!(ask(&format!("/{what}"), &own), "403");
    }
    assert_eq!(status(&format!("GET /{token}/ws HTTP/1.1\n{own}")), "426");
    assert_eq!(status("no request at all"), "400");
    // Whoever may come still does.
    viewed.open();
}

#[test]
fn a_long_message_ends_its_socket_alone() {
    let viewed = Viewed::on(SCENE);
    let (mut loud, mut other) = (viewed.open(), viewed.open());
    let text = "#".repeat(100_000);
    loud.try_send(json!({ "do": "exec", "text": text }).to_string());
    assert_eq!(loud.until_closed().map(|end| u16::from(end.code)), Some(1009));
    assert_eq!(other.print("A"), ["(0, 0)"]);
}

#[test]
fn what_is_no_message_is_refused() {
    let viewed = Viewed::on(SCENE);
    let mut page = viewed.open();
    for text in ["", "{", "[]", "{\"do\":7}", "{\"do\":\"fly\"}", "{\"do\":\"move\",\"to\":[1]}"] {
        page.send(text);
        page.until(|message| message["refused"].is_string());
        page.heard.clear();
    }
    assert_eq!(page.print("A"), ["(0, 0)"]);
}

#[test]
fn connections_that_ask_for_nothing_keep_nobody_out() {
    let viewed = Viewed::on(SCENE);
    let connect = || {
        let mut stream = TcpStream::connect(("127.0.0.1", viewed.port)).expect("it listens");
        drop(stream.write_all(b"GET /"));
        stream
    };
    let silent: Vec<TcpStream> = (0..300).map(|_| connect()).collect();
    let mut page = viewed.open();
    assert_eq!(page.print("A"), ["(0, 0)"]);
    drop(silent);
}

#[test]
fn there_are_so_many_pages_and_no_more() {
    let viewed = Viewed::on(SCENE);
    let mut pages: Vec<_> = (0..64).map(|_| viewed.open()).collect();
    let mut late = viewed.knock().expect("it is told why it may not stay");
    assert_eq!(late.until_closed().map(|end| u16::from(end.code)), Some(1013));
    assert_eq!(pages[0].print("A"), ["(0, 0)"]);
    // Who leaves makes room; that this was noticed shows in time.
    pages.pop();
    while viewed.knock().expect("a socket").try_hear_hello().is_err() {}
}

#[test]
fn who_never_reads_holds_nobody_up() {
    let viewed = Viewed::on(SCENE);
    let mut deaf = viewed.open();
    let mut page = viewed.open();
    deaf.say(&json!({ "do": "hello", "protocol": 1 }));
    for k in 0..300 {
        assert_eq!(page.exec(&format!("move A to ({k}, 0)"))["ok"], true);
    }
    while page.at(0) != [299.0, 0.0] {
        page.until_frame();
    }
    // It was told of no more frames than it may have ahead.
    deaf.sees = false;
    deaf.frame.clear();
    let mut n_frames = 0;
    let answer = json!(77);
    deaf.say(&json!({ "do": "pause", "id": answer }));
    while deaf.heard.last().is_none_or(|it| it["answer"] != answer) {
        deaf.frame.clear();
        deaf.hear();
        n_frames += u32::from(!deaf.frame.is_empty());
    }
    assert!(n_frames <= 4, "{n_frames} frames");
}

#[cfg(target_os = "linux")]
#[test]
fn twenty_thousand_moves_take_no_memory() {
    let viewed = Viewed::on(SCENE);
    let resident = || {
        let status = std::fs::read_to_string(format!("/proc/{}/status", viewed.id()));
        let status = status.expect("the program runs");
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        let words = line.expect("its memory").split_whitespace().next().expect("a number");
        words.parse::<u64>().expect("a number") * 1024
    };
    let mut page = viewed.open();
    page.ask(json!({ "do": "grab", "point": 2 }));
    let mut moves = |n: u32| {
        for k in 0..n {
            let phi = f64::from(k) / 100.0;
            page.say(&json!({ "do": "move", "to": [4.0 * phi.cos(), 4.0 * phi.sin()] }));
            if k % 100 == 0 {
                page.ask(json!({ "do": "keep" }));
            }
        }
        page.ask(json!({ "do": "keep" }));
    };
    moves(1000);
    let before = resident();
    moves(20_000);
    let after = resident();
    assert!(after < before + (16 << 20), "{before} bytes, then {after}");
    assert_eq!(page.ask(json!({ "do": "release" }))["ok"], true);
}

#[test]
fn the_limits_of_a_session_hold_for_pages() {
    let viewed = Viewed::with(SCENE, &["--limit", "points=4", "--limit", "frames=100"]);
    let mut page = viewed.open();
    assert_eq!(page.exec("step 101")["ok"], false);
    for path in ["../x.svg", "/x.svg"] {
        assert_eq!(page.exec(&format!("svg \"{path}\""))["ok"], false);
    }
    let answer = page.exec("svg \"x.svg\"");
    assert_eq!(answer["ok"], true, "{answer}");
    assert!(viewed.folder.path().join("x.svg").exists());
    assert_eq!(page.exec("point E = (1, 1)")["ok"], true);
    let answer = page.exec("point F = (1, 1)");
    assert_eq!(answer["ok"], false);
    assert!(answer["said"][0]["message"].as_str().expect("a text").contains("points"), "{answer}");
}

#[test]
fn no_file_is_given_but_those_that_statements_wrote() {
    let mut viewed = Viewed::on(&format!("{SCENE}\nsvg \"first.svg\""));
    std::fs::write(viewed.folder.path().join("own.svg"), "<svg/>").expect("it can be written");
    let mut page = viewed.open();
    let ask = |page: &mut Page, name: &str| {
        page.ask(json!({ "do": "file", "kind": "written", "name": name }))
    };
    let names = [
        "/etc/passwd",
        "scene.link",
        "./scene.link",
        "./own.svg",
        "./folder/../own.svg",
        "<examples>/klann",
        "",
        ".",
    ];
    for name in names {
        let answer = ask(&mut page, name);
        assert_eq!(answer["ok"], false, "{name}: {answer}");
        assert_eq!(answer["said"][0]["text"], "no statement wrote that", "{name}");
    }
    // Whether a page said it, the prompt, or the script before there were pages.
    let wrote = page.exec("svg \"now.svg\"")["wrote"][0].clone();
    viewed.enter("svg \"typed.svg\"; point E = (9, 9)");
    page.until(|message| message["journal"][0]["by"] == "prompt");
    for name in [wrote.as_str().expect("a name"), "./typed.svg", "./first.svg"] {
        let answer = ask(&mut page, name);
        assert_eq!(answer["ok"], true, "{name}: {answer}");
        assert!(answer["text"].as_str().expect("a text").starts_with("<svg"), "{name}");
    }
}

#[cfg(unix)]
#[test]
fn a_link_in_the_way_of_a_written_file_leads_nowhere() {
    use std::os::unix::fs::symlink;
    // Also who may write anywhere gives away only what was written.
    for args in [&[][..], &["--allow-any-path"]] {
        let viewed = Viewed::with(SCENE, args);
        let mut page = viewed.open();
        let folder = viewed.folder.path();
        page.exec("svg \"link.svg\"; svg \"below/now.svg\"");
        let mut is_given = |name: &str| {
            page.ask(json!({ "do": "file", "kind": "written", "name": name }))["ok"] == true
        };
        let names = ["./link.svg", "./below/now.svg"];
        assert!(names.iter().all(|name| is_given(name)), "{args:?}");
        std::fs::write(folder.join("secret"), "secret").expect("it can be written");
        std::fs::remove_file(folder.join("link.svg")).expect("it is there");
        symlink(folder.join("secret"), folder.join("link.svg")).expect("links are made");
        std::fs::create_dir(folder.join("other")).expect("it can be made");
        std::fs::write(folder.join("other/now.svg"), "secret").expect("it can be written");
        std::fs::rename(folder.join("below"), folder.join("moved")).expect("it is there");
        symlink(folder.join("other"), folder.join("below")).expect("links are made");
        for name in names {
            assert!(!is_given(name), "{name} {args:?}");
        }
    }
}

#[cfg(unix)]
#[test]
fn what_was_written_through_a_link_of_the_user_is_given() {
    let viewed = Viewed::on(SCENE);
    let folder = viewed.folder.path();
    std::fs::write(folder.join("real.svg"), "").expect("it can be written");
    std::os::unix::fs::symlink("real.svg", folder.join("now.svg")).expect("links are made");
    let mut page = viewed.open();
    page.exec("svg \"now.svg\"");
    let answer = page.ask(json!({ "do": "file", "kind": "written", "name": "./now.svg" }));
    assert!(answer["text"].as_str().is_some_and(|text| text.starts_with("<svg")), "{answer}");
}

#[test]
fn a_text_in_pieces_has_an_end() {
    let viewed = Viewed::with(SCENE, &["--limit", "source-bytes=1000"]);
    let mut page = viewed.open();
    let piece = |text: &str| json!({ "do": "exec", "text": text, "more": true });
    page.say(&piece("point P = (0, 0)\n"));
    page.say(&piece(&"#".repeat(990)));
    // What follows is a piece of it still, however short it is.
    page.say(&piece("\npoint Q = (0, 0)"));
    let answer = page.exec("\npoint R = (0, 0)");
    assert_eq!(answer["ok"], false);
    assert!(
        answer["said"][0]["text"].as_str().expect("a text").contains("source-bytes"),
        "{answer}"
    );
    for name in ["P", "Q", "R"] {
        assert_eq!(page.exec(&format!("print {name}"))["ok"], false, "{name} is not there");
    }
    // The next is another text.
    page.say(&piece("print "));
    assert_eq!(page.print("A"), ["(0, 0)"]);
}

#[test]
fn long_statements_lock_nobody_out() {
    let mut viewed = Viewed::on(SCENE);
    let mut page = viewed.open();
    for (k, n_bytes) in [1_500_000, 1_500_000, 1_500_000, 5_000_000, 10].into_iter().enumerate() {
        let room = " ".repeat(n_bytes);
        viewed.enter(&format!("for i in 1..1 {{ move C to ({k}, 0){room}}}"));
        page.until(|message| message["journal"][0]["number"] == k);
    }
    let late = viewed.open();
    let journal = late.last("journal").as_array().expect("a list");
    assert!(late.last("journal").to_string().len() <= 4 << 20);
    let texts: Vec<&str> = journal.iter().map(|it| it["text"].as_str().expect("a text")).collect();
    // The last are there; of the one that is longer than all may be, its beginning.
    let [.., cut, last] = &texts[..] else { panic!("{} statements", texts.len()) };
    assert!(cut.starts_with("for i in 1..1 { move C to (3, 0) ") && cut.ends_with('…'));
    assert_eq!(*last, format!("for i in 1..1 {{ move C to (4, 0){}}}", " ".repeat(10)));
    assert_eq!(journal[0]["number"], 1);
}

#[test]
fn a_page_may_stop_what_it_asked_for() {
    let viewed = Viewed::on(SCENE);
    let (mut page, mut other) = (viewed.open(), viewed.open());
    let before = page.script();
    page.say(&json!({ "do": "exec", "id": "long", "text": "relax 1e12" }));
    // What comes before the work has begun stops nothing: it is said until it does.
    loop {
        other.say(&json!({ "do": "stop" }));
        page.try_hear_within_a_moment();
        if let Some(answer) = page.heard.iter().find(|it| it["answer"] == "long") {
            assert_eq!(answer["stopped"], true, "{answer}");
            break;
        }
    }
    // What it did is what the journal says: nothing of it depends on when it was stopped.
    let journal = page.journal();
    let done = journal.last().expect("it did something");
    assert!(done.starts_with("relax "), "{done}");
    let mut again = linkwork::Session::new();
    again.run(SCENE).expect("the script is right");
    again.run(done).expect("the statement is right");
    assert_eq!(page.script(), again.to_script());
    // Where it was stopped before its first round there is nothing to take back.
    if page.script() != before {
        page.exec("undo");
    }
    assert_eq!(page.script(), before);
}
