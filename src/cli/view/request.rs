//! The heads of requests: who asks for what, and whether they may.

use super::token;

/// Headers of a request, at most.
const MOST_HEADERS: usize = 64;

/// What a server expects to be called, and to be told.
#[derive(Debug, Clone)]
pub struct Door {
    /// Where it listens.
    pub port: u16,
    /// What an address has to begin with.
    pub token: String,
}

/// What is to be done about a request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// It is shown the page.
    Page,
    /// It gets a socket; this is its key.
    Socket(String),
    /// It gets nothing but a status.
    Refused(u16, &'static str),
}

const FORBIDDEN: Verdict = Verdict::Refused(403, "Forbidden");
const BAD: Verdict = Verdict::Refused(400, "Bad Request");

impl Door {
    /// The names under which a browser on this machine may know the server.
    fn hosts(&self) -> [String; 2] {
        [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)]
    }

    /// Judges a request by its whole head.
    pub fn judge(&self, head: &[u8]) -> Verdict {
        let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
        let mut request = httparse::Request::new(&mut headers);
        if !request.parse(head).is_ok_and(|status| status.is_complete()) {
            return BAD;
        }
        let all = |name: &str| {
            let named = request.headers.iter().filter(move |it| it.name.eq_ignore_ascii_case(name));
            named.map(|it| str::from_utf8(it.value).unwrap_or_default()).collect::<Vec<_>>()
        };
        let hosts = self.hosts();
        // A name that somebody else's name server answers with this address is none of ours.
        if !matches!(&all("host")[..], [host] if hosts.iter().any(|it| it == host)) {
            return FORBIDDEN;
        }
        // Browsers say where a script comes from that asks; other programs have no origin.
        let is_ours = |origin: &&str| {
            origin.strip_prefix("http://").is_some_and(|it| hosts.iter().any(|host| host == it))
        };
        if !all("origin").iter().all(is_ours) {
            return FORBIDDEN;
        }
        let path = request.path.unwrap_or_default();
        let path = path.split(['?', '#']).next().unwrap_or_default();
        let rest = path.strip_prefix('/').and_then(|path| path.split_once('/'));
        let Some((_, rest)) = rest.filter(|(word, _)| token::is_same(word, &self.token)) else {
            return FORBIDDEN;
        };
        if request.method != Some("GET") {
            return Verdict::Refused(405, "Method Not Allowed");
        }
        match rest {
            "" => Verdict::Page,
            "ws" => {
                let has = |name: &str, word: &str| {
                    let values = all(name);
                    let mut words = values.iter().flat_map(|value| value.split(','));
                    words.any(|it| it.trim().eq_ignore_ascii_case(word))
                };
                let is_upgrade = has("upgrade", "websocket") && has("connection", "upgrade");
                match &all("sec-websocket-key")[..] {
                    [key] if is_upgrade && has("sec-websocket-version", "13") => {
                        Verdict::Socket((*key).to_owned())
                    }
                    _ => Verdict::Refused(426, "Upgrade Required"),
                }
            }
            _ => Verdict::Refused(404, "Not Found"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judge(head: &str) -> Verdict {
        let door = Door { port: 8080, token: "secret".to_owned() };
        door.judge(format!("{}\r\n\r\n", head.replace('\n', "\r\n")).as_bytes())
    }

    #[test]
    fn the_page_is_for_who_knows_the_token() {
        assert_eq!(judge("GET /secret/ HTTP/1.1\nHost: 127.0.0.1:8080"), Verdict::Page);
        assert_eq!(judge("GET /secret/?x HTTP/1.1\nhost: localhost:8080"), Verdict::Page);
        for head in [
            "GET / HTTP/1.1\nHost: 127.0.0.1:8080",
            "GET /secret HTTP/1.1\nHost: 127.0.0.1:8080",
            "GET /Secret/ HTTP/1.1\nHost: 127.0.0.1:8080",
            "GET /secret2/ HTTP/1.1\nHost: 127.0.0.1:8080",
            "GET /x/secret/ HTTP/1.1\nHost: 127.0.0.1:8080",
            "GET /secret/ HTTP/1.1",
            "GET /secret/ HTTP/1.1\nHost: evil.example:8080",
            "GET /secret/ HTTP/1.1\nHost: 127.0.0.1",
            "GET /secret/ HTTP/1.1\nHost: 127.0.0.1:80800",
            "GET /secret/ HTTP/1.1\nHost: 127.0.0.1:8080\nHost: evil.example",
            "GET /secret/ HTTP/1.1\nHost: 127.0.0.1:8080\nOrigin: http://evil.example",
            "GET /secret/ HTTP/1.1\nHost: 127.0.0.1:8080\nOrigin: null",
            "GET /secret/ HTTP/1.1\nHost: 127.0.0.1:8080\nOrigin: https://127.0.0.1:8080",
        ] {
            assert_eq!(judge(head), FORBIDDEN, "{head}");
        }
        let refused = |head: &str| match judge(head) {
            Verdict::Refused(status, _) => status,
            verdict => panic!("{verdict:?}"),
        };
        assert_eq!(refused("POST /secret/ HTTP/1.1\nHost: 127.0.0.1:8080"), 405);
        assert_eq!(refused("GET /secret/etc/passwd HTTP/1.1\nHost: 127.0.0.1:8080"), 404);
        assert_eq!(refused("GET /secret/../ HTTP/1.1\nHost: 127.0.0.1:8080"), 404);
        assert_eq!(refused("\u{1}"), 400);
    }

    #[test]
    fn a_socket_is_asked_for_by_its_headers() {
        let ask =
            |more: &str| judge(&format!("GET /secret/ws HTTP/1.1\nHost: 127.0.0.1:8080{more}"));
        let good = "\nConnection: keep-alive, Upgrade\nUpgrade: websocket\n\
                    Sec-WebSocket-Version: 13\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==";
        let wanted = Verdict::Socket("dGhlIHNhbXBsZSBub25jZQ==".to_owned());
        assert_eq!(ask(good), wanted);
        assert_eq!(ask(&format!("{good}\nOrigin: http://localhost:8080")), wanted);
        assert_eq!(ask(&format!("{good}\nOrigin: http://evil.example")), FORBIDDEN);
        assert_eq!(ask(""), Verdict::Refused(426, "Upgrade Required"));
        assert_eq!(ask(&good.replace("13", "8")), Verdict::Refused(426, "Upgrade Required"));
    }
}
