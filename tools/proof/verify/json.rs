// SPDX-License-Identifier: MIT
//! As much of JSON as instances and roadmaps need.
pub enum Json {
    Other,
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
}

const DEPTH: usize = 64;

impl Json {
    pub fn parse(bytes: &[u8]) -> Result<Json, String> {
        let mut parser = Parser { bytes, at: 0 };
        let value = parser.value(0).filter(|_| { parser.blanks(); parser.at == bytes.len() });
        let line = 1 + bytes.iter().take(parser.at).filter(|&&byte| byte == b'\n').count();
        value.ok_or_else(|| format!("line {}: this is not JSON, or a key is there twice", line))
    }

    pub fn get(&self, key: &str) -> Option<&Json> {
        match self { Json::Object(members) => members.iter().find(|(name, _)| name == key).map(|member| &member.1), _ => None }
    }

    pub fn list(&self) -> Option<&[Json]> { match self { Json::List(values) => Some(values), _ => None } }

    pub fn text(&self) -> Option<&str> { match self { Json::Text(text) => Some(text), _ => None } }

    /// A whole number from 0 to 2^31 - 1.
    pub fn number(&self) -> Option<u32> {
        match self { Json::Number(n) if (0.0..2147483648.0).contains(n) && n.fract() == 0.0 => Some(*n as u32), _ => None }
    }
}

struct Parser<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Parser<'_> {
    fn peek(&self) -> u8 { self.bytes.get(self.at).copied().unwrap_or(0) }

    fn blanks(&mut self) { while matches!(self.peek(), b' ' | b'\t' | b'\n' | b'\r') { self.at += 1; } }

    /// After blanks.
    fn take(&mut self, word: &str) -> bool {
        self.blanks();
        let found = self.bytes.get(self.at..).map_or(false, |rest| rest.starts_with(word.as_bytes()));
        self.at += if found { word.len() } else { 0 };
        found
    }

    fn value(&mut self, depth: usize) -> Option<Json> {
        self.blanks();
        match self.peek() {
            _ if depth > DEPTH => None,
            b'{' => {
                let mut members: Vec<(String, Json)> = Vec::new();
                self.items("}", |parser| {
                    parser.blanks();
                    let name = parser.string()?;
                    let good = parser.take(":") && members.iter().all(|(other, _)| *other != name);
                    members.push((name, parser.value(depth + 1).filter(|_| good)?));
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
            b'-' | b'0'..=b'9' => {
                let from = self.at;
                while matches!(self.peek(), b'-' | b'+' | b'.' | b'e' | b'E' | b'0'..=b'9') { self.at += 1; }
                std::str::from_utf8(&self.bytes[from..self.at]).ok()?.parse().ok().map(Json::Number)
            }
            _ => [("true", Json::Bool(true)), ("false", Json::Bool(false)), ("null", Json::Other)].into_iter()
                .find(|(word, _)| self.take(word)).map(|(_, value)| value),
        }
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

    /// The digits behind `u`; ends on the last of them.
    fn unit(&mut self) -> Option<u16> {
        let digits = std::str::from_utf8(self.bytes.get(self.at + 1..self.at + 5)?).ok()?;
        self.at += 4;
        u16::from_str_radix(digits, 16).ok()
    }
}
