//! Tables as text: CSV and its relatives, separated by commas, semicolons, tabs or spaces.
//!
//! The first line tells the separator; if no cell of it is a number, it holds the names. Lines that are empty or begin
//! with `#` are skipped; a `#` line right before the first row may hold the names as well. Bytes are read straight into
//! columns of numbers, without a string for each cell.

use super::number::{self, Short};
use super::{Column, MOST_COLUMNS, Numbers, Table, Unusable, wrong_in_line};
use crate::models::ModelError;
use std::borrow::Cow;

/// What stands between cells.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Separator {
    /// This byte.
    Byte(u8),
    /// Spaces or tabs, one or more.
    Spaces,
}

/// A way through the bytes.
#[derive(Clone)]
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    /// From 1.
    line: usize,
    separator: Separator,
    /// The last line that began with `#`.
    remark: &'a [u8],
}

pub(super) fn read(bytes: &[u8]) -> Result<Table, ModelError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut reader = Reader { bytes, at: 0, line: 1, separator: Separator::Spaces, remark: b"" };
    if !reader.seek_row() {
        return Err(ModelError::new("there are no rows in it"));
    }
    reader.separator = separator_of(reader.rest_of_line());
    let mut after_first = reader.clone();
    let first = after_first.cells()?;
    if first.len() > MOST_COLUMNS {
        return Err(wrong_in_line(reader.line, format!("more than {MOST_COLUMNS} columns")));
    }
    let mut names = names_in(&first);
    if names.is_some() {
        reader = after_first;
    } else {
        names = reader.names_in_remark(first.len());
    }
    reader.rows(first.len(), names)
}

/// The first of `;`, tab and `,` that stands outside of quotes, or else spaces.
fn separator_of(line: &[u8]) -> Separator {
    let mut quoted = false;
    let mut found = Separator::Spaces;
    for byte in line {
        match byte {
            b'"' => quoted = !quoted,
            _ if quoted => {}
            b';' => return Separator::Byte(b';'),
            b'\t' => found = Separator::Byte(b'\t'),
            b',' if found == Separator::Spaces => found = Separator::Byte(b','),
            _ => {}
        }
    }
    found
}

/// The cells as names, if none of them is a number.
fn names_in(cells: &[Cow<'_, [u8]>]) -> Option<Vec<String>> {
    let is_header = cells.iter().all(|cell| number::parse(cell).is_none()) && cells.iter().any(|cell| !cell.is_empty());
    is_header.then(|| cells.iter().map(|cell| String::from_utf8_lossy(cell).into_owned()).collect())
}

impl<'a> Reader<'a> {
    #[inline]
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Skips blanks within a line: what is neither separator nor cell.
    #[inline]
    fn skip_blanks(&mut self) {
        while let Some(b' ' | b'\t' | b'\r') = self.peek() {
            if self.separator == Separator::Byte(b'\t') && self.peek() == Some(b'\t') {
                return;
            }
            self.at += 1;
        }
    }

    /// To the first cell of the next row; false at the end.
    fn seek_row(&mut self) -> bool {
        loop {
            let start = self.at;
            while let Some(b' ' | b'\t' | b'\r') = self.peek() {
                self.at += 1;
            }
            match self.peek() {
                None => return false,
                Some(b'\n') => {
                    self.line += 1;
                    self.at += 1;
                }
                Some(b'#') => {
                    self.remark = self.rest_of_line();
                    self.at += self.remark.len();
                }
                Some(_) => {
                    // A tab may stand for an empty first cell.
                    self.at = start;
                    self.skip_blanks();
                    return true;
                }
            }
        }
    }

    fn rest_of_line(&self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        &rest[..rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len())]
    }

    /// After a cell: goes to the next one of the row, or else past the end of the line and says false.
    #[inline]
    fn next_cell(&mut self) -> Result<bool, ModelError> {
        let before = self.at;
        self.skip_blanks();
        match (self.peek(), self.separator) {
            (None, _) => Ok(false),
            (Some(b'\n'), _) => {
                self.line += 1;
                self.at += 1;
                Ok(false)
            }
            (Some(byte), Separator::Byte(separator)) if byte == separator => {
                self.at += 1;
                self.skip_blanks();
                Ok(true)
            }
            (Some(_), Separator::Spaces) if self.at > before => Ok(true),
            (Some(_), _) => Err(wrong_in_line(self.line, "a quotation is followed by more than a separator")),
        }
    }

    /// True if no more of the cell stands here.
    #[inline]
    fn is_at_end_of_cell(&self) -> bool {
        match (self.peek(), self.separator) {
            (None | Some(b'\n' | b'\r' | b' '), _) => true,
            (Some(byte), Separator::Byte(separator)) => byte == separator,
            (Some(byte), Separator::Spaces) => byte == b'\t',
        }
    }

    /// The text of the cell that begins here.
    fn cell(&mut self) -> Result<Cow<'a, [u8]>, ModelError> {
        if self.peek() == Some(b'"') {
            return self.quotation();
        }
        let rest = &self.bytes[self.at..];
        let ends = |byte: &u8| match self.separator {
            Separator::Byte(separator) => *byte == separator || *byte == b'\n',
            Separator::Spaces => byte.is_ascii_whitespace(),
        };
        let cell = &rest[..rest.iter().position(ends).unwrap_or(rest.len())];
        self.at += cell.len();
        Ok(Cow::Borrowed(cell.trim_ascii_end()))
    }

    /// The text in double quotes, where two of them stand for one; it may go over several lines.
    fn quotation(&mut self) -> Result<Cow<'a, [u8]>, ModelError> {
        let first_line = self.line;
        let mut text = Vec::new();
        self.at += 1;
        loop {
            match (self.peek(), self.bytes.get(self.at + 1)) {
                (None, _) => return Err(wrong_in_line(first_line, "this quotation is never closed")),
                (Some(b'"'), Some(b'"')) => {
                    text.push(b'"');
                    self.at += 2;
                }
                (Some(b'"'), _) => {
                    self.at += 1;
                    return Ok(Cow::Owned(text.trim_ascii().to_vec()));
                }
                (Some(byte), _) => {
                    self.line += usize::from(byte == b'\n');
                    text.push(byte);
                    self.at += 1;
                }
            }
        }
    }

    /// All cells of a row, as text.
    fn cells(&mut self) -> Result<Vec<Cow<'a, [u8]>>, ModelError> {
        let mut cells = vec![self.cell()?];
        while self.next_cell()? {
            cells.push(self.cell()?);
            if cells.len() > MOST_COLUMNS {
                break;
            }
        }
        Ok(cells)
    }

    /// Names in the remark above, if there are as many as columns.
    fn names_in_remark(&self, width: usize) -> Option<Vec<String>> {
        let words = self.remark.trim_ascii_start().strip_prefix(b"#")?.trim_ascii();
        let mut reader = Reader { bytes: words, at: 0, separator: separator_of(words), ..*self };
        let cells = reader.cells().ok()?;
        names_in(&cells).filter(|names| names.len() == width)
    }

    /// All rows from here on.
    fn rows(mut self, width: usize, names: Option<Vec<String>>) -> Result<Table, ModelError> {
        let has_names = names.is_some();
        let names = names.unwrap_or_else(|| vec![String::new(); width]);
        let mut columns: Vec<Growing> = names.into_iter().map(Growing::new).collect();
        while self.seek_row() {
            self.row(&mut columns)?;
        }
        let columns = columns.into_iter().map(Growing::done).collect();
        Ok(Table { columns, has_names, warnings: Vec::new() })
    }

    fn row(&mut self, columns: &mut [Growing]) -> Result<(), ModelError> {
        let line = self.line;
        let width = columns.len();
        for (at, column) in columns.iter_mut().enumerate() {
            self.number(column)?;
            let goes_on = self.next_cell()?;
            if goes_on != (at + 1 < width) {
                let found = if goes_on { "more".to_owned() } else { (at + 1).to_string() };
                let error = wrong_in_line(line, format!("{found} cells, where there are {width} in the first line"));
                return Err(error.help("all rows have the same number of cells"));
            }
        }
        Ok(())
    }

    /// The number in the cell that begins here.
    #[inline]
    fn number(&mut self, column: &mut Growing) -> Result<(), ModelError> {
        if let Some(Short { value, length }) = number::short(&self.bytes[self.at..]) {
            self.at += length;
            if self.is_at_end_of_cell() {
                column.numbers.push(value);
                return Ok(());
            }
            self.at -= length;
        }
        let line = self.line;
        let text = self.cell()?;
        column.push_text(&text, line);
        Ok(())
    }
}

/// A column that grows.
struct Growing {
    name: String,
    numbers: Vec<f64>,
    unusable: Option<Unusable>,
}

impl Growing {
    fn new(name: String) -> Growing {
        Growing { name, numbers: Vec::new(), unusable: None }
    }

    fn push_text(&mut self, text: &[u8], line: usize) {
        let number = number::parse(text).unwrap_or(f64::NAN);
        self.numbers.push(number);
        if !number.is_finite() && self.unusable.is_none() {
            let text = String::from_utf8_lossy(&text[..text.len().min(40)]).into_owned();
            self.unusable = Some(Unusable { line, text });
        }
    }

    fn done(self) -> Column {
        let Growing { name, numbers, unusable } = self;
        Column { name, numbers: Numbers::F64(numbers), unusable }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The names, and the rows.
    fn told(text: &str) -> (Vec<String>, Vec<Vec<f64>>) {
        let table = read(text.as_bytes()).unwrap();
        let columns: Vec<&Vec<f64>> = table
            .columns
            .iter()
            .map(|column| match &column.numbers {
                Numbers::F64(numbers) => numbers,
                Numbers::F32(_) | Numbers::U8(_) => panic!("text is read in double precision"),
            })
            .collect();
        let rows = (0..table.rows()).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
        (table.columns.iter().map(|column| column.name.clone()).collect(), rows)
    }

    #[test]
    fn all_separators_mean_the_same() {
        let expected = (vec!["x".to_owned(), "y".to_owned()], vec![vec![1.0, -2.5], vec![300.0, 0.5]]);
        for text in [
            "x,y\n1,-2.5\n3e2,.5\n",
            "x;y\n1;-2.5\n3e2;.5",
            "x\ty\n1\t-2.5\n3e2\t.5\n",
            "x y\n1 -2.5\n3e2 .5\n",
            "  x   y  \n 1\t -2.5 \n\n300 0.5\n\n",
            "\u{feff}x, y\r\n 1 , -2.5 \r\n\r\n3e2,\t.5\r\n",
            "# made today\n\"x\",\"y\"\n# first\n1,\"-2.5\"\n   # second, with a comma\n\"3e2\",.5",
            "# x y\n1 -2.5\n300 .5\n",
            "# x, y\n1 -2.5\n300 .5\n",
        ] {
            assert_eq!(told(text), expected, "{text:?}");
        }
    }

    #[test]
    fn a_first_row_with_a_number_in_it_is_data() {
        assert_eq!(told("1,2\n3,4\n").1, [[1.0, 2.0], [3.0, 4.0]]);
        let table = read(b"C 0 1 2\nH 3 4 5\n").unwrap();
        assert_eq!((table.has_names, table.rows(), table.columns.len()), (false, 2, 4));
        assert_eq!(table.columns[0].unusable.as_ref().map(|one| one.text.as_str()), Some("C"));
        assert_eq!(told("# by me\n1 2 3\n").0, ["", "", ""], "a remark of another length has no names");
    }

    #[test]
    fn quotations_may_hold_separators_quotes_and_lines() {
        let (names, rows) = told("\"a,b\",\"say \"\"c\"\"\",\"d\ne\"\n1,2,3\n");
        assert_eq!((names, rows), (vec!["a,b".into(), "say \"c\"".into(), "d\ne".into()], vec![vec![1.0, 2.0, 3.0]]));
    }

    #[test]
    fn an_empty_cell_takes_its_place() {
        for text in ["a,b,c\n1,,3\n,2,\n", "a\tb\tc\n1\t\t3\n\t2\t\n"] {
            let table = read(text.as_bytes()).unwrap();
            let lines: Vec<_> =
                table.columns.iter().map(|column| column.unusable.as_ref().map(|one| one.line)).collect();
            assert_eq!((table.rows(), lines), (2, vec![Some(3), Some(2), Some(3)]), "{text:?}");
        }
    }

    #[test]
    fn names_alone_are_a_table_of_no_rows() {
        assert_eq!(told("x,y,z"), (vec!["x".into(), "y".into(), "z".into()], vec![]));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        let message = |text: &str| {
            let error = read(text.as_bytes()).unwrap_err();
            format!("{:?} {}", error.place, error.message)
        };
        assert_eq!(message(""), "None there are no rows in it");
        assert_eq!(message("# nothing\n\n"), "None there are no rows in it");
        assert_eq!(message("a,b\n1,2\n\n3\n"), "Some(Line(4)) 1 cells, where there are 2 in the first line");
        assert_eq!(message("a,b\n1,2,3\n"), "Some(Line(2)) more cells, where there are 2 in the first line");
        assert_eq!(message("a,b\n1,\"2\n"), "Some(Line(2)) this quotation is never closed");
        assert_eq!(message("a,b\n1,\"2\"x\n"), "Some(Line(2)) a quotation is followed by more than a separator");
        assert_eq!(message(&"a,".repeat(2000)), "Some(Line(1)) more than 1000 columns");
    }

    proptest! {
        #[test]
        fn no_bytes_break_it(bytes in prop::collection::vec(prop::sample::select(b"1.e-,;\t \n\r\"#aN\xff".to_vec()), 0..60)) {
            if let Ok(table) = read(&bytes) {
                let lengths = table.columns.iter().map(|column| column.numbers.len());
                prop_assert!(lengths.clone().all(|length| length == table.rows() && length <= bytes.len()));
            }
        }
    }
}
