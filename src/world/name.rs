//! The text of a name: a short one lies where it is kept.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// The text of a name, cheap to clone. Up to 22 bytes need no room of their own.
#[derive(Clone)]
pub struct NameText(Kept);

/// The longest text that is kept in place: as much as fits beside a pointer and its length.
const SHORT: usize = 22;

#[derive(Clone)]
enum Kept {
    Short(u8, [u8; SHORT]),
    Long(Arc<str>),
}

impl NameText {
    /// Roughly how many bytes it takes.
    pub fn n_bytes(&self) -> usize {
        let apart = match &self.0 {
            Kept::Short(..) => 0,
            Kept::Long(text) => text.len(),
        };
        size_of::<Self>() + apart
    }

    /// The bytes of the text.
    pub fn as_bytes(&self) -> &[u8] {
        match &self.0 {
            Kept::Short(length, bytes) => &bytes[..usize::from(*length)],
            Kept::Long(text) => text.as_bytes(),
        }
    }
}

impl From<&str> for NameText {
    fn from(text: &str) -> Self {
        let mut bytes = [0; SHORT];
        match bytes.get_mut(..text.len()) {
            Some(start) => {
                start.copy_from_slice(text.as_bytes());
                Self(Kept::Short(text.len() as u8, bytes))
            }
            None => Self(Kept::Long(text.into())),
        }
    }
}

impl From<String> for NameText {
    fn from(text: String) -> Self {
        Self::from(text.as_str())
    }
}

impl Deref for NameText {
    type Target = str;

    fn deref(&self) -> &str {
        match &self.0 {
            Kept::Short(..) => std::str::from_utf8(self.as_bytes()).expect("it was a text before"),
            Kept::Long(text) => text,
        }
    }
}

impl PartialEq for NameText {
    fn eq(&self, other: &Self) -> bool {
        self.as_bytes() == other.as_bytes()
    }
}

impl Eq for NameText {}

impl fmt::Display for NameText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self)
    }
}

impl fmt::Debug for NameText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&**self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_of_any_length_come_back() {
        for text in
            ["", "p", "p[123456]", "ähnlich", "left.right[17].above.B", "a name that is longer"]
        {
            assert_eq!(&*NameText::from(text), text);
            let long = text.repeat(7);
            assert_eq!(&*NameText::from(long.as_str()), long);
        }
        assert_eq!(size_of::<Option<NameText>>(), 24);
    }
}
