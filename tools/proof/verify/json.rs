// SPDX-License-Identifier: MIT
//! As much of JSON as instances and roadmaps need.

#[derive(Debug)]
pub enum Json {
    Null,
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
        let value = parser.value(0)?;
        parser.blanks();
        if parser.at < bytes.len() {
            return parser.fail("expected the end of the file");
        }
        Ok(value)
    }

    pub fn get(&self, key: &str) -> Option<&Json> {
        match self {
            Json::Object(members) => members.iter().find(|(name, _)| name == key).map(|(_, value)| value),
            _ => None,
        }
    }

    pub fn list(&self) -> Option<&[Json]> {
        match self {
            Json::List(values) => Some(values),
            _ => None,
        }
    }

    pub fn text(&self) -> Option<&str> {
        match self {
            Json::Text(text) => Some(text),
            _ => None,
        }
    }

    /// A whole number from 0 to 2^31 - 1.
    pub fn number(&self) -> Option<u32> {
        match self {
            Json::Number(n) if *n >= 0.0 && *n < 2147483648.0 && n.fract() == 0.0 => Some(*n as u32),
            _ => None,
        }
    }
}

struct Parser<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Parser<'_> {
    fn fail<T>(&self, what: &str) -> Result<T, String> {
        let line = 1 + self.bytes[..self.at.min(self.bytes.len())].iter().filter(|&&b| b == b'\n').count();
        Err(format!("line {}: {}", line, what))
    }

    fn peek(&self) -> u8 {
        self.bytes.get(self.at).copied().unwrap_or(0)
    }

    fn blanks(&mut self) {
        while matches!(self.peek(), b' ' | b'\t' | b'\n' | b'\r') {
            self.at += 1;
        }
    }

    fn take(&mut self, word: &str) -> bool {
        let found = self.bytes.get(self.at..).map_or(false, |rest| rest.starts_with(word.as_bytes()));
        self.at += if found { word.len() } else { 0 };
        found
    }

    fn value(&mut self, depth: usize) -> Result<Json, String> {
        self.blanks();
        match self.peek() {
            _ if depth > DEPTH => self.fail("nested too deeply"),
            b'{' => self.object(depth),
            b'[' => self.array(depth),
            b'"' => Ok(Json::Text(self.string()?)),
            b'-' | b'0'..=b'9' => self.number(),
            _ if self.take("true") => Ok(Json::Bool(true)),
            _ if self.take("false") => Ok(Json::Bool(false)),
            _ if self.take("null") => Ok(Json::Null),
            _ => self.fail("expected a value"),
        }
    }

    fn number(&mut self) -> Result<Json, String> {
        let from = self.at;
        while matches!(self.peek(), b'-' | b'+' | b'.' | b'e' | b'E' | b'0'..=b'9') {
            self.at += 1;
        }
        let text = std::str::from_utf8(&self.bytes[from..self.at]).unwrap_or("");
        text.parse().map(Json::Number).or_else(|_| self.fail("expected a number"))
    }

    fn array(&mut self, depth: usize) -> Result<Json, String> {
        self.at += 1;
        let mut values = Vec::new();
        self.blanks();
        while !self.take("]") {
            if !values.is_empty() && !self.take(",") {
                return self.fail("expected , or ]");
            }
            values.push(self.value(depth + 1)?);
            self.blanks();
        }
        Ok(Json::List(values))
    }

    fn object(&mut self, depth: usize) -> Result<Json, String> {
        self.at += 1;
        let mut members: Vec<(String, Json)> = Vec::new();
        self.blanks();
        while !self.take("}") {
            if !members.is_empty() && !self.take(",") {
                return self.fail("expected , or }");
            }
            self.blanks();
            let name = self.string()?;
            self.blanks();
            if !self.take(":") || members.iter().any(|(other, _)| *other == name) {
                return self.fail("expected : and no key twice");
            }
            members.push((name, self.value(depth + 1)?));
            self.blanks();
        }
        Ok(Json::Object(members))
    }

    fn string(&mut self) -> Result<String, String> {
        if !self.take("\"") {
            return self.fail("expected \"");
        }
        let mut text = Vec::new();
        while !self.take("\"") {
            match self.peek() {
                b'\\' => self.escape(&mut text)?,
                0..=31 => return self.fail("expected the end of a string"),
                byte => {
                    text.push(byte);
                    self.at += 1;
                }
            }
        }
        String::from_utf8(text).or_else(|_| self.fail("expected UTF-8"))
    }

    fn escape(&mut self, text: &mut Vec<u8>) -> Result<(), String> {
        self.at += 2;
        let letter = self.bytes.get(self.at - 1).copied().unwrap_or(0);
        if letter == b'u' {
            let first = self.unit()?;
            let pair = (0xd800..0xdc00).contains(&first) && self.take("\\u");
            let units = if pair { vec![first, self.unit()?] } else { vec![first] };
            let decoded = String::from_utf16(&units).or_else(|_| self.fail("expected a character"))?;
            text.extend(decoded.as_bytes());
            return Ok(());
        }
        match b"\"\\/bfnrt".iter().position(|&known| known == letter) {
            Some(found) => text.push(b"\"\\/\x08\x0c\n\r\t"[found]),
            None => return self.fail("expected an escape"),
        }
        Ok(())
    }

    fn unit(&mut self) -> Result<u16, String> {
        let digits = self.bytes.get(self.at..self.at + 4).and_then(|four| std::str::from_utf8(four).ok());
        let unit = digits.and_then(|four| u16::from_str_radix(four, 16).ok());
        self.at += 4;
        unit.map_or_else(|| self.fail("expected 4 hexadecimal digits"), Ok)
    }
}
