// SPDX-License-Identifier: MIT
//! Reads the lines of a certificate as a stream, which it decompresses if necessary.
use std::ffi::c_void;
use std::fs::File;
use std::io::{BufRead, BufReader, Error, ErrorKind, Read};
use std::path::Path;

#[repr(C)]
struct Buffer {
    bytes: *mut u8,
    size: usize,
    at: usize,
}

#[link(name = "zstd")]
extern "C" {
    fn ZSTD_createDStream() -> *mut c_void;
    fn ZSTD_decompressStream(stream: *mut c_void, out: *mut Buffer, input: *mut Buffer) -> usize;
    fn ZSTD_isError(code: usize) -> u32;
}

struct Zstd<R> {
    source: R,
    stream: *mut c_void,
    /// True within a zstd frame, when more bytes must follow.
    within: bool,
}

impl<R: BufRead> Read for Zstd<R> {
    fn read(&mut self, target: &mut [u8]) -> std::io::Result<usize> {
        loop {
            let bytes = self.source.fill_buf()?;
            let ended = bytes.is_empty();
            let mut input = Buffer { bytes: bytes.as_ptr() as *mut u8, size: bytes.len(), at: 0 };
            let mut out = Buffer { bytes: target.as_mut_ptr(), size: target.len(), at: 0 };
            if ended && !self.within { return Ok(0); }
            // Safety: both buffers have the sizes given, zstd does not write to the input, and no other code uses the stream.
            let left = unsafe { ZSTD_decompressStream(self.stream, &mut out, &mut input) };
            let failed = unsafe { ZSTD_isError(left) } != 0;
            if failed || (ended && out.at == 0) {
                return Err(Error::new(ErrorKind::InvalidData, "zstd: the data are corrupt or truncated"));
            }
            self.within = left != 0;
            self.source.consume(input.at);
            if out.at > 0 { return Ok(out.at); }
        }
    }
}

const MAX_LINE: u64 = 1 << 22;

pub struct Lines {
    source: Box<dyn BufRead>,
    line: Vec<u8>,
    pub number: u64,
}

impl Lines {
    pub fn open(path: &Path) -> std::io::Result<Lines> {
        let mut file = BufReader::with_capacity(1 << 16, File::open(path)?);
        let source: Box<dyn BufRead> = if file.fill_buf()?.starts_with(&[0x28, 0xb5, 0x2f, 0xfd]) {
            let stream = unsafe { ZSTD_createDStream() };
            assert!(!stream.is_null(), "memory for zstd");
            Box::new(BufReader::with_capacity(1 << 16, Zstd { source: file, stream, within: false }))
        } else {
            Box::new(file)
        };
        Ok(Lines { source, line: Vec::new(), number: 0 })
    }

    /// Returns the next line without its line feed. Returns None at the end of the file.
    pub fn next(&mut self) -> Result<Option<&str>, String> {
        self.number += 1;
        self.line.clear();
        let read = self.source.by_ref().take(MAX_LINE).read_until(b'\n', &mut self.line);
        match read.map_err(|error| error.to_string())? {
            0 => Ok(None),
            _ if self.line.pop() != Some(b'\n') => Err("expected the end of a line".to_string()),
            _ => std::str::from_utf8(&self.line).map(Some).map_err(|_| "expected text".to_string()),
        }
    }
}
