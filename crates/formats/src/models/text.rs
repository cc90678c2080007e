//! Text, byte by byte: what the readers of OBJ, MTL, PLY and STL share.
//!
//! Bytes, not `str`: names in such files are in whatever encoding their author had, numbers are ASCII in any case, and
//! looking at lines of a hundred megabytes twice is time lost.

use std::borrow::Cow;

/// A place in a text, and what can be read from there on.
#[derive(Clone, Debug)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    /// True where a backslash before the end of a line means that the statement goes on.
    continues: bool,
}

/// Powers of ten that double precision holds exactly.
const EXACT_TENS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

impl<'a> Cursor<'a> {
    /// From byte `at` on; the end of a line is nothing but blank.
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Cursor<'a> {
        Cursor { bytes, at, continues: false }
    }

    /// From the beginning, behind a byte order mark; a backslash joins a line to the next.
    pub(super) fn of_lines(bytes: &'a [u8]) -> Cursor<'a> {
        let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Cursor { bytes, at, continues: true }
    }

    /// The byte that comes next.
    #[inline]
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// Goes to a byte.
    pub(super) fn go_to(&mut self, at: usize) {
        self.at = at;
    }

    /// Bytes that are left.
    pub(super) fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    /// The line of the next byte, from 1.
    pub(super) fn line(&self) -> usize {
        line_of(self.bytes, self.at)
    }

    /// What the next byte is.
    #[inline]
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Length of a backslash and the end of line behind it, if they come next.
    #[inline]
    fn continuation(&self) -> Option<usize> {
        match self.bytes.get(self.at..)? {
            [b'\\', b'\n', ..] if self.continues => Some(2),
            [b'\\', b'\r', b'\n', ..] if self.continues => Some(3),
            _ => None,
        }
    }

    /// Skips blanks on this line.
    #[inline]
    pub(super) fn skip_blanks(&mut self) {
        while let Some(byte) = self.peek() {
            match byte {
                b' ' | b'\t' | b'\r' | 0x0b | 0x0c => self.at += 1,
                b'\\' => match self.continuation() {
                    Some(length) => self.at += length,
                    None => return,
                },
                _ => return,
            }
        }
    }

    /// Skips blanks and ends of lines.
    #[inline]
    pub(super) fn skip_space(&mut self) {
        while let Some(b' ' | b'\t' | b'\r' | b'\n' | 0x0b | 0x0c) = self.peek() {
            self.at += 1;
        }
    }

    /// The word that comes next on this line; empty at its end, and where a comment begins.
    #[inline]
    pub(super) fn word(&mut self) -> &'a [u8] {
        self.skip_blanks();
        if self.peek() == Some(b'#') {
            return &[];
        }
        self.glyphs()
    }

    /// The word that comes next on this or a later line; empty at the end of the text.
    #[inline]
    pub(super) fn word_of_text(&mut self) -> &'a [u8] {
        self.skip_space();
        self.glyphs()
    }

    /// What is not blank from here on.
    #[inline]
    fn glyphs(&mut self) -> &'a [u8] {
        let start = self.at;
        while let Some(byte) = self.peek() {
            match byte {
                b' ' | b'\t' | b'\r' | b'\n' | 0x0b | 0x0c => break,
                b'\\' if self.continuation().is_some() => break,
                _ => self.at += 1,
            }
        }
        &self.bytes[start..self.at]
    }

    /// The number that comes next on this line; `None`, and nothing is skipped but blanks, if something else does.
    #[inline]
    pub(super) fn number(&mut self) -> Option<f64> {
        self.skip_blanks();
        if self.is_between_words() { None } else { self.number_here() }
    }

    /// The number that comes next on this or a later line.
    #[inline]
    pub(super) fn number_of_text(&mut self) -> Option<f64> {
        self.skip_space();
        self.number_here()
    }

    #[inline]
    fn number_here(&mut self) -> Option<f64> {
        let rest = &self.bytes[self.at.min(self.bytes.len())..];
        if let Some((number, length)) = plain_number(rest) {
            let end = rest.get(length).copied();
            if matches!(end, None | Some(b' ' | b'\t' | b'\r' | b'\n' | b'#')) {
                self.at += length;
                return Some(number);
            }
        }
        self.unusual_number()
    }

    /// A number of many digits, with a great exponent, or that is none at all.
    #[cold]
    fn unusual_number(&mut self) -> Option<f64> {
        let start = self.at;
        let number = std::str::from_utf8(self.glyphs()).ok().and_then(|word| word.parse().ok());
        if number.is_none() {
            self.at = start;
        }
        number
    }

    /// The whole number that stands right here.
    #[inline]
    pub(super) fn integer_here(&mut self) -> Option<i64> {
        let negative = self.peek() == Some(b'-');
        let mut at = self.at + usize::from(negative || self.peek() == Some(b'+'));
        let start = at;
        let mut value: i64 = 0;
        while let Some(digit @ b'0'..=b'9') = self.bytes.get(at).copied() {
            // No index has so many digits; that it is too great shows later.
            value = value.saturating_mul(10).saturating_add(i64::from(digit - b'0'));
            at += 1;
        }
        if at == start {
            return None;
        }
        self.at = at;
        Some(if negative { -value } else { value })
    }

    /// Skips this byte if it comes next.
    #[inline]
    pub(super) fn skip(&mut self, byte: u8) -> bool {
        let here = self.peek() == Some(byte);
        self.at += usize::from(here);
        here
    }

    /// True at the end of a word.
    #[inline]
    pub(super) fn is_between_words(&self) -> bool {
        match self.peek() {
            None | Some(b' ' | b'\t' | b'\r' | b'\n' | 0x0b | 0x0c | b'#') => true,
            Some(_) => self.continuation().is_some(),
        }
    }

    /// The rest of the line without the blanks around it: a name, which may have blanks in it.
    pub(super) fn rest_of_line(&mut self) -> Cow<'a, str> {
        self.skip_blanks();
        let start = self.at;
        while self.peek().is_some_and(|byte| byte != b'\n') {
            self.at += 1;
        }
        String::from_utf8_lossy(self.bytes[start..self.at].trim_ascii())
    }

    /// What is left of the line up to this word, in any case.
    pub(super) fn rest_of_line_before(&mut self, word: &[u8]) -> Cow<'a, str> {
        self.skip_blanks();
        let start = self.at;
        let mut end = start;
        loop {
            let next = self.glyphs();
            if next.is_empty() || next.eq_ignore_ascii_case(word) {
                self.at = end;
                return String::from_utf8_lossy(&self.bytes[start..end]);
            }
            end = self.at;
            self.skip_blanks();
        }
    }

    /// Goes to the beginning of the next line, behind lines that a backslash joins to this one; false at the end of
    /// the text. A comment joins nothing: paths in it may well end with a backslash.
    #[inline]
    pub(super) fn next_line(&mut self) -> bool {
        let mut in_comment = false;
        while let Some(byte) = self.peek() {
            match byte {
                b'\n' => {
                    self.at += 1;
                    return true;
                }
                b'\\' if !in_comment => self.at += self.continuation().unwrap_or(1),
                byte => {
                    in_comment |= byte == b'#';
                    self.at += 1;
                }
            }
        }
        false
    }

    /// True if nothing but space is left.
    pub(super) fn is_at_end(&mut self) -> bool {
        self.skip_space();
        self.peek().is_none()
    }
}

/// The line of a byte, from 1.
pub(super) fn line_of(bytes: &[u8], at: usize) -> usize {
    1 + bytes[..at.min(bytes.len())].iter().filter(|byte| **byte == b'\n').count()
}

/// A number of at most 19 digits with a small exponent, and its length. It is correctly rounded: its digits are a whole
/// number below 2⁵³ and its power of ten is exact, so one division or product rounds once (W. D. Clinger, "How to Read
/// Floating Point Numbers Accurately", 1990). The standard library does the same, but wants the end of the number and
/// its encoding looked for first, which takes longer than this.
#[inline]
fn plain_number(bytes: &[u8]) -> Option<(f64, usize)> {
    let negative = bytes.first() == Some(&b'-');
    let mut at = usize::from(negative || bytes.first() == Some(&b'+'));
    let mut digits: u64 = 0;
    let start = at;
    while let Some(digit @ b'0'..=b'9') = bytes.get(at).copied() {
        digits = digits.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
        at += 1;
    }
    let mut count = at - start;
    let mut exponent = 0;
    if bytes.get(at) == Some(&b'.') {
        at += 1;
        let point = at;
        while let Some(digit @ b'0'..=b'9') = bytes.get(at).copied() {
            digits = digits.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
            at += 1;
        }
        count += at - point;
        exponent = -((at - point) as i64);
    }
    // Up to 19 digits nothing wraps.
    if count == 0 || count > 19 || digits > 1 << 53 {
        return None;
    }
    if let Some(b'e' | b'E') = bytes.get(at) {
        let (power, length) = small_exponent(&bytes[at + 1..])?;
        exponent += power;
        at += 1 + length;
    }
    let size = match exponent {
        0..=22 => digits as f64 * EXACT_TENS[exponent as usize],
        -22..=-1 => digits as f64 / EXACT_TENS[-exponent as usize],
        _ => return None,
    };
    Some((if negative { -size } else { size }, at))
}

/// A whole number of at most three digits, and its length.
#[inline]
fn small_exponent(bytes: &[u8]) -> Option<(i64, usize)> {
    let sign = usize::from(matches!(bytes.first(), Some(b'-' | b'+')));
    let digits = bytes[sign..].iter().take(4).take_while(|byte| byte.is_ascii_digit());
    let (value, count) = digits.fold((0, 0), |(value, count), digit| (value * 10 + i64::from(digit - b'0'), count + 1));
    if !(1..=3).contains(&count) {
        return None;
    }
    Some((if bytes[0] == b'-' { -value } else { value }, sign + count))
}

/// A word of a file as messages show it: short, and in one line.
pub(super) fn shown(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(&word[..word.len().min(120)]);
    let mut short: String = text.chars().take(30).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    if short.len() < text.len() || word.len() > 120 {
        short.push('…');
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_standard_library() {
        let words = [
            "0",
            "-0",
            "1",
            "+1",
            "-1.5",
            ".5",
            "5.",
            "0.1",
            "1e3",
            "1E-3",
            "123456789.123456789",
            "9007199254740993",
            "1e22",
            "1e23",
            "1e-22",
            "1e-23",
            "3.141592653589793238462643383279502884",
            "1e400",
            "-1e-400",
            "inf",
            "nan",
            "-infinity",
            "0000000000000000000000000.25",
            "4.9e-324",
            "179769313486231570000000000000000000000e270",
            "1e+05",
            "-2.5E+005",
        ];
        for word in words {
            let expected: f64 = word.parse().unwrap();
            let found = Cursor::new(word.as_bytes(), 0).number().unwrap();
            assert!(found.to_bits() == expected.to_bits(), "{word}: {found}, not {expected}");
        }
    }

    #[test]
    fn random_numbers_survive_being_written() {
        let mut bits = 1_u64;
        for _ in 0..20_000 {
            bits ^= bits << 13;
            bits ^= bits >> 7;
            bits ^= bits << 17;
            let any = f64::from_bits(bits);
            let usual = (bits >> 20) as i32 as f64 / 1e6;
            for number in [any, usual] {
                for word in [format!("{number:e}"), format!("{number}"), format!("{number:.6}")] {
                    let expected: f64 = word.parse().unwrap();
                    let found = Cursor::new(word.as_bytes(), 0).number().unwrap();
                    assert!(found.to_bits() == expected.to_bits() || found.is_nan(), "{word}");
                }
            }
        }
    }

    #[test]
    fn what_is_no_number_is_left_where_it_is() {
        for word in ["", "-", ".", "e5", "1e", "1x", "--1", "1.2.3", "0x10", "1,5", "1e+", "-.e1"] {
            let mut cursor = Cursor::new(word.as_bytes(), 0);
            assert_eq!((cursor.number(), cursor.at()), (None, 0), "{word}");
        }
    }

    #[test]
    fn a_backslash_joins_lines() {
        let mut cursor = Cursor::of_lines(b"\xef\xbb\xbfv 1\\\n2 \\\r\n 3 \\x\nnext");
        let words: Vec<&[u8]> = std::iter::repeat_with(|| cursor.word()).take_while(|word| !word.is_empty()).collect();
        assert_eq!(words, [&b"v"[..], b"1", b"2", b"3", b"\\x"]);
        assert!(cursor.next_line() && cursor.word() == b"next" && !cursor.next_line());
        assert_eq!(cursor.line(), 4);
    }

    #[test]
    fn comments_join_nothing() {
        let mut cursor = Cursor::of_lines(b"# C:\\folder\\\na \\\n b\nc");
        assert!(cursor.next_line() && cursor.word() == b"a" && cursor.next_line());
        assert_eq!((cursor.word(), cursor.line()), (&b"c"[..], 4));
    }

    #[test]
    fn words_are_shown_short() {
        assert_eq!(shown(b"a\nb"), "a\u{fffd}b");
        assert!(shown(&[b'x'; 1000]).chars().count() == 31);
    }
}
