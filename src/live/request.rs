//! What a page asks for: its messages, taken apart.

use serde_json::Value;

use crate::constraint::Point;
use crate::world::PointId;

/// A message of a page.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The number that its answer is to have, if it wants one.
    pub id: Option<Value>,
    /// What it asks for.
    pub wish: Wish,
}

/// What a page asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Wish {
    /// To be told all there is.
    Hello,
    /// Statements to be carried out; more of the text may follow.
    Execute { text: String, is_more_to_come: bool },
    /// A statement to be tried.
    Try(String),
    /// The last one tried to stay.
    Keep,
    /// The last one tried to be taken back.
    Drop,
    /// A point to be held.
    Grab(PointId),
    /// What is held to be led to a place.
    Move(Point),
    /// What is held to be let go.
    Release,
    /// What is held to be let go, and what was done with it taken back.
    Cancel,
    /// Time to pass, so many seconds of the mechanism a second.
    Play(f64),
    /// Time to stand still.
    Pause,
    /// What may stand at a place of a text, in UTF-16 units.
    Complete { text: String, at: usize },
    /// A file.
    File(FileWish),
    /// Drawings at so many px a world unit.
    View(Option<f64>),
    /// The page has shown a frame.
    Seen(u64),
    /// The statement that is running to be stopped: a carrier does that before it gets here.
    Stop,
    /// The mechanisms that come with the program.
    Examples,
}

/// A file that is asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FileWish {
    /// A picture of now.
    Still,
    /// A moving picture of so many frames to come.
    Moving(u64),
    /// A table of paths over so many frames to come.
    Table(u64),
    /// The script that makes it all.
    Script,
    /// A file that a statement wrote, by the name that was told then.
    Written(String),
}

/// Frames of a file where the page does not say how many.
const FRAMES: u64 = 240;
/// And at most.
const MOST_FRAMES: u64 = 100_000;

impl Request {
    /// Takes a message apart.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(message: &str) -> Result<Self, String> {
        let value: Value =
            serde_json::from_str(message).map_err(|problem| format!("no JSON: {problem}"))?;
        let word = value["do"].as_str().ok_or("`do` is missing")?;
        let text = |name: &str| {
            let text = value[name].as_str().map(str::to_owned);
            text.ok_or_else(|| format!("`{name}` is to be a text"))
        };
        let number = |name: &str| value[name].as_f64().filter(|n| n.is_finite());
        let wish = match word {
            "hello" => Wish::Hello,
            "exec" => Wish::Execute {
                text: text("text")?,
                is_more_to_come: value["more"].as_bool().unwrap_or(false),
            },
            "help" => {
                let topic = value["topic"].as_str().unwrap_or_default();
                Wish::Execute { text: format!("help {topic}"), is_more_to_come: false }
            }
            "try" => Wish::Try(text("text")?),
            "keep" => Wish::Keep,
            "drop" => Wish::Drop,
            "grab" => {
                let point = value["point"].as_u64().and_then(|n| u32::try_from(n).ok());
                Wish::Grab(PointId(point.ok_or("`point` is to be a handle")?))
            }
            "move" => {
                let place = |k: usize| value["to"][k].as_f64().filter(|n| n.is_finite());
                match (place(0), place(1)) {
                    (Some(x), Some(y)) => Wish::Move(Point::new(x, y)),
                    _ => return Err("`to` is to be two numbers".to_owned()),
                }
            }
            "release" => Wish::Release,
            "cancel" => Wish::Cancel,
            "play" => Wish::Play(number("speed").unwrap_or(1.0).clamp(1e-6, 1e6)),
            "pause" => Wish::Pause,
            "complete" => {
                let text = text("text")?;
                let at = value["at"].as_u64().map_or(usize::MAX, |at| at as usize);
                Wish::Complete { text, at }
            }
            "file" => Wish::File(file_wish(&value)?),
            "view" => Wish::View(number("scale")),
            "seen" => Wish::Seen(value["seq"].as_u64().ok_or("`seq` is missing")?),
            "stop" => Wish::Stop,
            "examples" => Wish::Examples,
            other => return Err(format!("nothing is called `{other}`")),
        };
        Ok(Self { id: value.get("id").cloned(), wish })
    }
}

fn file_wish(value: &Value) -> Result<FileWish, String> {
    let frames = value["frames"].as_u64().unwrap_or(FRAMES).min(MOST_FRAMES);
    Ok(match value["kind"].as_str() {
        Some("svg") => FileWish::Still,
        Some("animation") => FileWish::Moving(frames),
        Some("csv") => FileWish::Table(frames),
        Some("script") => FileWish::Script,
        Some("written") => {
            FileWish::Written(value["name"].as_str().ok_or("`name` is missing")?.to_owned())
        }
        _ => return Err("`kind` is svg, animation, csv, script or written".to_owned()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_message_is_told() {
        for (message, wanted) in [
            ("", "no JSON"),
            ("[]", "`do` is missing"),
            ("{\"do\":\"fly\"}", "nothing is called `fly`"),
            ("{\"do\":\"exec\"}", "`text` is to be a text"),
            ("{\"do\":\"move\",\"to\":[1]}", "`to` is to be two numbers"),
            ("{\"do\":\"move\",\"to\":[1,1e999]}", "no JSON"),
            ("{\"do\":\"grab\",\"point\":-1}", "`point` is to be a handle"),
            ("{\"do\":\"grab\",\"point\":4294967296}", "`point` is to be a handle"),
            ("{\"do\":\"file\",\"kind\":\"exe\"}", "`kind` is"),
        ] {
            let problem = Request::parse(message).expect_err(message);
            assert!(problem.starts_with(wanted), "{message}: {problem}");
        }
    }

    #[test]
    fn a_message_may_want_an_answer() {
        let request = Request::parse("{\"do\":\"exec\",\"id\":7,\"text\":\"step\"}").expect("good");
        assert_eq!(request.id, Some(Value::from(7)));
        let wanted = Wish::Execute { text: "step".to_owned(), is_more_to_come: false };
        assert_eq!(request.wish, wanted);
    }
}
