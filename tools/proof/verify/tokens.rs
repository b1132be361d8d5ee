// SPDX-License-Identifier: MIT
//! Splits lines into tokens, and reports faults in certificates.
use crate::agent::NEVER;
use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasherDefault, Hasher};

/// A fault in a certificate: the exit code (1: refused, 2: unreadable) and the reason.
pub type Fault = (i32, String);

pub fn unreadable(reason: impl Into<String>) -> Fault { (2, reason.into()) }

/// Refuses the certificate unless `good`.
pub fn ensure(good: bool, reason: impl Into<String>) -> Result<(), Fault> { if good { Ok(()) } else { Err((1, reason.into())) } }

/// A fast hash for keys that searches create. Do not use it for keys from files, because it does not resist crafted collisions.
#[derive(Default)]
pub struct Quick(u64);

impl Hasher for Quick {
    fn write(&mut self, bytes: &[u8]) { bytes.iter().for_each(|&byte| self.write_u64(u64::from(byte))); }
    fn write_u32(&mut self, value: u32) { self.write_u64(u64::from(value)); }
    fn write_u64(&mut self, value: u64) { self.0 = (self.0.rotate_left(5) ^ value).wrapping_mul(0x9e3779b97f4a7c15); }
    fn finish(&self) -> u64 { self.0 ^ self.0 >> 32 }
}

pub type Map<K, V> = HashMap<K, V, BuildHasherDefault<Quick>>;
pub type Set<K> = HashSet<K, BuildHasherDefault<Quick>>;

/// The words of a line, separated by single blanks.
pub struct Tokens<'a>(std::str::Split<'a, char>);

fn parse(token: &str) -> Result<u64, Fault> {
    let digits = Some(token).filter(|token| !token.is_empty() && token.bytes().all(|byte| byte.is_ascii_digit()));
    let digits = digits.ok_or_else(|| unreadable(format!("found '{:.20}'; expected a number", token)))?;
    digits.parse().map_err(|_| (1, "the number is too large".to_string()))
}

impl<'a> Tokens<'a> {
    pub fn of(line: &'a str) -> Tokens<'a> { Tokens(line.split(' ')) }

    /// The words of a line without a word that begins it, perhaps none.
    pub fn rest(text: &'a str) -> Tokens<'a> {
        let mut words = Tokens::of(text);
        if text.is_empty() { words.0.next(); }
        words
    }

    pub fn more(&self) -> bool { self.0.clone().next().is_some() }

    pub fn token(&mut self) -> Result<&'a str, Fault> {
        self.0.next().filter(|token| !token.is_empty()).ok_or_else(|| unreadable("expected another word"))
    }

    pub fn whole(&mut self) -> Result<u64, Fault> { parse(self.token()?) }

    pub fn number(&mut self) -> Result<u32, Fault> {
        let value = self.whole()?;
        ensure(value < u64::from(NEVER), "the number is too large").map(|_| value as u32)
    }

    pub fn index(&mut self, count: usize, what: &str) -> Result<u32, Fault> {
        let value = self.number()?;
        ensure((value as usize) < count, format!("there is no {} {}", what, value)).map(|_| value)
    }

    /// Parses a number or `inf`. Returns None for `inf`.
    pub fn or_inf(&mut self) -> Result<Option<u32>, Fault> {
        if self.0.clone().next() != Some("inf") { return self.number().map(Some); }
        self.0.next();
        Ok(None)
    }

    /// Takes the next word if it is `word`.
    pub fn take(&mut self, word: &str) -> bool {
        let found = self.0.clone().next() == Some(word);
        if found { self.0.next(); }
        found
    }

    /// Parses a number that may have a minus sign. Returns the number without the sign, and whether it has one.
    pub fn signed(&mut self) -> Result<(u32, bool), Fault> {
        let token = self.token()?;
        let digits = token.strip_prefix('-');
        let value = parse(digits.unwrap_or(token))?;
        ensure(value < u64::from(NEVER), "the number is too large").map(|_| (value as u32, digits.is_some()))
    }

    pub fn end(&mut self) -> Result<(), Fault> {
        if self.more() { Err(unreadable("expected the end of the line")) } else { Ok(()) }
    }
}
