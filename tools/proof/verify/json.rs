// SPDX-License-Identifier: MIT
//! Parser for the part of JSON that instances and roadmaps need.
pub enum Json {
    Other,
    Bool(bool),
    /// A number without decimal point and exponent that fits into an i64.
    Whole(i64),
    Real(f64),
    Text(String),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
}

/// Maximum nesting depth of objects and lists.
const MAX_DEPTH: usize = 32;

impl Json {
    pub fn parse(bytes: &[u8]) -> Result<Json, String> {
        let mut parser = Parser { bytes, at: 0, twice: None };
        let value = parser.value(0).filter(|_| { parser.blanks(); parser.at == bytes.len() });
        let line = 1 + bytes.iter().take(parser.at).filter(|&&byte| byte == b'\n').count();
        value.ok_or_else(|| match parser.twice {
            Some(key) => format!("line {}: key '{}' is there twice", line, key),
            None => format!("line {}: this is not JSON", line),
        })
    }

    pub fn get(&self, key: &str) -> Option<&Json> {
        match self { Json::Object(members) => members.iter().find(|(name, _)| name == key).map(|member| &member.1), _ => None }
    }

    pub fn list(&self) -> Option<&[Json]> { match self { Json::List(values) => Some(values), _ => None } }

    /// Returns the value of a text without NUL characters; otherwise None.
    pub fn text(&self) -> Option<&str> { match self { Json::Text(text) if !text.contains('\0') => Some(text), _ => None } }

    /// Returns the value of a whole number from 0 to 2^31 - 1; otherwise None.
    pub fn number(&self) -> Option<u32> {
        match self { Json::Whole(n) if (0..1 << 31).contains(n) => Some(*n as u32), _ => None }
    }

    pub fn is_number(&self) -> bool { matches!(self, Json::Whole(_) | Json::Real(_)) }
}

struct Parser<'a> {
    bytes: &'a [u8],
    at: usize,
    /// A key that occurs twice in an object, if any does.
    twice: Option<String>,
}

impl Parser<'_> {
    fn peek(&self) -> u8 { self.bytes.get(self.at).copied().unwrap_or(0) }

    fn blanks(&mut self) { while matches!(self.peek(), b' ' | b'\t' | b'\n' | b'\r') { self.at += 1; } }

    /// Skips blanks and, if it follows, `word`. Returns whether `word` followed.
    fn take(&mut self, word: &str) -> bool {
        self.blanks();
        let found = self.bytes.get(self.at..).map_or(false, |rest| rest.starts_with(word.as_bytes()));
        self.at += if found { word.len() } else { 0 };
        found
    }

    fn value(&mut self, depth: usize) -> Option<Json> {
        self.blanks();
        match self.peek() {
            b'{' | b'[' if depth >= MAX_DEPTH => None,
            b'{' => {
                let mut members: Vec<(String, Json)> = Vec::new();
                self.items("}", |parser| {
                    parser.blanks();
                    let name = parser.string()?;
                    if members.iter().any(|(other, _)| *other == name) {
                        parser.twice = Some(name);
                        return None;
                    }
                    let value = Some(()).filter(|_| parser.take(":")).and_then(|_| parser.value(depth + 1))?;
                    members.push((name, value));
                    Some(())
                })?;
                Some(Json::Object(members))
            }
            b'[' => {
                let mut values = Vec::new();
                self.items("]", |parser| parser.value(depth + 1).map(|value| values.push(value)))?;
                Some(Json::List(values))
            }
            b'"' => self.string().map(Json::Text),
            b'-' | b'0'..=b'9' => self.number(),
            _ => [("true", Json::Bool(true)), ("false", Json::Bool(false)), ("null", Json::Other)].into_iter()
                .find(|(word, _)| self.take(word)).map(|(_, value)| value),
        }
    }

    fn digits(&mut self) -> Option<()> {
        let from = self.at;
        while self.peek().is_ascii_digit() { self.at += 1; }
        Some(()).filter(|_| self.at > from)
    }

    /// Parses [-] digits [. digits] [e [+-] digits], without leading zeros.
    fn number(&mut self) -> Option<Json> {
        let from = self.at;
        self.at += usize::from(self.peek() == b'-');
        let is_zero = self.peek() == b'0';
        let first = self.at;
        self.digits().filter(|_| !is_zero || self.at == first + 1)?;
        let whole = self.at;
        if self.peek() == b'.' {
            self.at += 1;
            self.digits()?;
        }
        if matches!(self.peek(), b'e' | b'E') {
            self.at += 1;
            self.at += usize::from(matches!(self.peek(), b'+' | b'-'));
            self.digits()?;
        }
        let text = std::str::from_utf8(&self.bytes[from..self.at]).ok()?;
        let value: f64 = text.parse().ok().filter(|value: &f64| value.is_finite())?;
        Some(text.parse().ok().filter(|_| whole == self.at).map_or(Json::Real(value), Json::Whole))
    }

    fn items(&mut self, close: &str, mut each: impl FnMut(&mut Self) -> Option<()>) -> Option<()> {
        self.at += 1;
        let mut first = true;
        while !self.take(close) {
            if !first && !self.take(",") { return None; }
            first = false;
            each(self)?;
        }
        Some(())
    }

    fn string(&mut self) -> Option<String> {
        if self.peek() != b'"' { return None; }
        let mut text = Vec::new();
        loop {
            self.at += 1;
            match self.peek() {
                b'"' => break,
                b'\\' => self.escape(&mut text)?,
                0..=31 => return None,
                byte => text.push(byte),
            }
        }
        self.at += 1;
        String::from_utf8(text).ok()
    }

    fn escape(&mut self, text: &mut Vec<u8>) -> Option<()> {
        self.at += 1;
        if self.peek() != b'u' {
            let found = b"\"\\/bfnrt".iter().position(|&known| known == self.peek())?;
            text.push(b"\"\\/\x08\x0c\n\r\t"[found]);
            return Some(());
        }
        let mut units = vec![self.unit()?];
        if (0xd800..0xdc00).contains(&units[0]) && self.bytes.get(self.at + 1..)?.starts_with(b"\\u") {
            self.at += 2;
            units.push(self.unit()?);
        }
        text.extend(String::from_utf16(&units).ok()?.bytes());
        Some(())
    }

    /// Parses the four hexadecimal digits after `u`. Afterwards the current byte is the last of them.
    fn unit(&mut self) -> Option<u16> {
        let digits = std::str::from_utf8(self.bytes.get(self.at + 1..self.at + 5)?).ok()?;
        self.at += 4;
        u16::from_str_radix(digits, 16).ok()
    }
}
