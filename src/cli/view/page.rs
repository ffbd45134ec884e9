//! The page that the program carries, and what a browser is told of it.

/// All of it: it loads nothing else.
const PAGE: &str = include_str!("../../../web/built/index.html");

/// What a page may do that says nothing of it.
const STRICT: &str = "default-src 'none'";

/// The answer to who asks for the page.
pub fn answer() -> Vec<u8> {
    let policy = policy(PAGE).unwrap_or(STRICT);
    let head = format!(
        "HTTP/1.1 200 OK\r\n\
         Content-Type: text/html; charset=utf-8\r\n\
         Content-Length: {}\r\n\
         Content-Security-Policy: {policy}; frame-ancestors 'none'\r\n\
         X-Content-Type-Options: nosniff\r\n\
         Referrer-Policy: no-referrer\r\n\
         Cross-Origin-Opener-Policy: same-origin\r\n\
         Cross-Origin-Resource-Policy: same-origin\r\n\
         Cache-Control: no-store\r\n\
         Connection: close\r\n\r\n",
        PAGE.len()
    );
    [head.as_bytes(), PAGE.as_bytes()].concat()
}

/// An answer of a status alone.
pub fn refusal(status: u16, reason: &str) -> Vec<u8> {
    let text = format!("{status} {reason}\n");
    let head = format!(
        "HTTP/1.1 {status} {reason}\r\n\
         Content-Type: text/plain\r\n\
         Content-Length: {}\r\n\
         X-Content-Type-Options: nosniff\r\n\
         Connection: close\r\n\r\n",
        text.len()
    );
    (head + &text).into_bytes()
}

/// The policy that a page states of itself; a header says more than it can.
fn policy(page: &str) -> Option<&str> {
    let (_, rest) = page.split_once("http-equiv=\"Content-Security-Policy\" content=\"")?;
    let (policy, _) = rest.split_once('"')?;
    (!policy.contains(['\r', '\n'])).then_some(policy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_may_do_nothing_that_it_does_not_state() {
        let policy = policy(PAGE).expect("the page states a policy");
        assert!(policy.starts_with("default-src 'none'"), "{policy}");
        assert!(!policy.contains("unsafe") && !policy.contains('*'), "{policy}");
    }
}
