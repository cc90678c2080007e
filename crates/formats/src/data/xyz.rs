//! Atoms as text: XYZ, and extended XYZ as far as it tells what the columns are.
//!
//! A line with the number of atoms, a line of remarks, and a line for each atom: its element, and where it is. From the
//! element come a radius and a color, unless the file has columns of its own for them.

use super::elements::{Looks, UNKNOWN};
use super::{Column, MOST_COLUMNS, Numbers, Table, Unusable, number, wrong_in_line};
use crate::models::ModelError;

/// What stands in a word of a line.
#[derive(Clone, Debug, PartialEq)]
enum Slot {
    Symbol,
    /// A number, of this column.
    Number(usize),
    Skipped,
}

/// What the words of a line are.
#[derive(Debug, PartialEq)]
struct Layout {
    slots: Vec<Slot>,
    names: Vec<String>,
}

/// Columns that grow atom by atom.
struct Atoms {
    columns: Vec<Vec<f64>>,
    unusable: Vec<Option<Unusable>>,
    radii: Vec<f64>,
    colors: [Vec<u8>; 3],
    /// The first atom whose element is not known.
    strange: Option<Unusable>,
}

/// Lines with their numbers, from 1.
type Lines<'a> = std::iter::Enumerate<std::slice::Split<'a, u8, fn(&u8) -> bool>>;

pub(super) fn read(bytes: &[u8]) -> Result<Table, ModelError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines: Lines<'_> = bytes.split((|byte| *byte == b'\n') as fn(&u8) -> bool).enumerate();
    let first = lines.next().map_or(&[][..], |(_, line)| line.trim_ascii());
    let count: usize = std::str::from_utf8(first).ok().and_then(|text| text.parse().ok()).ok_or_else(|| {
        wrong_in_line(1, "the number of atoms is missing").help("an .xyz file begins with it, in a line of its own")
    })?;
    let remark = lines.next().map_or(&[][..], |(_, line)| line);
    let layout = match properties(remark) {
        Some(properties) => layout_of(properties)?,
        None => Layout::plain(),
    };
    let mut atoms = Atoms::new(&layout);
    let looks = Looks::new();
    for found in 0..count {
        let Some((at, line)) = lines.next().filter(|(_, line)| !line.trim_ascii().is_empty()) else {
            return Err(ModelError::new(format!("the file ends after {found} of {count} atoms")));
        };
        atoms.add(line, at + 1, &layout, &looks)?;
    }
    let goes_on = lines.find(|(_, line)| !line.trim_ascii().is_empty());
    let mut table = atoms.done(layout);
    if let Some((at, _)) = goes_on {
        let message =
            format!("only its first {count} atoms are used: what follows from line {} on is left out", at + 1);
        table.warnings.push(message);
    }
    Ok(table)
}

/// The value of `Properties=` in the remark of an extended file.
fn properties(remark: &[u8]) -> Option<&str> {
    let text = std::str::from_utf8(remark).ok()?;
    let lower = text.to_ascii_lowercase();
    let at = lower.find("properties=")?;
    let value = &text[at + "properties=".len()..];
    match value.strip_prefix('"') {
        Some(quoted) => quoted.split('"').next(),
        None => value.split_ascii_whitespace().next(),
    }
}

/// `species:S:1:pos:R:3:…`: name, kind and number of columns, again and again.
fn layout_of(properties: &str) -> Result<Layout, ModelError> {
    let damaged =
        || wrong_in_line(2, "`Properties` cannot be understood").help("as in `Properties=species:S:1:pos:R:3`");
    let words: Vec<&str> = properties.split(':').collect();
    let mut layout = Layout { slots: Vec::new(), names: Vec::new() };
    for part in words.chunks(3) {
        let &[name, kind, count] = part else { return Err(damaged()) };
        let count: usize = count.parse().map_err(|_| damaged())?;
        if count == 0 || layout.slots.len() + count > MOST_COLUMNS {
            return Err(damaged());
        }
        let is_text = matches!(kind, "S" | "L");
        let is_symbol = name.eq_ignore_ascii_case("species") || name.eq_ignore_ascii_case("element");
        for at in 0..count {
            if is_text || is_symbol {
                layout.slots.push(if is_symbol && at == 0 { Slot::Symbol } else { Slot::Skipped });
            } else {
                layout.slots.push(Slot::Number(layout.names.len()));
                layout.names.push(name_of(name, at, count));
            }
        }
    }
    let has_places = ["x", "y", "z"].iter().all(|name| layout.names.iter().any(|known| known == name));
    if has_places { Ok(layout) } else { Err(wrong_in_line(2, "`Properties` lacks `pos:R:3`")) }
}

/// The name of one of the columns of a property.
fn name_of(property: &str, at: usize, count: usize) -> String {
    let axis = ["x", "y", "z"].get(at).copied().unwrap_or_default();
    match (property.to_ascii_lowercase().as_str(), count) {
        ("pos" | "position", 3) => axis.to_owned(),
        ("color", 3) => ["red", "green", "blue"][at].to_owned(),
        (_, 1) => property.to_owned(),
        (_, 3) => format!("{property}_{axis}"),
        _ => format!("{property}_{}", at + 1),
    }
}

impl Layout {
    /// Symbol, x, y, z.
    fn plain() -> Layout {
        let slots = vec![Slot::Symbol, Slot::Number(0), Slot::Number(1), Slot::Number(2)];
        Layout { slots, names: ["x", "y", "z"].map(str::to_owned).to_vec() }
    }

    fn has(&self, name: &str) -> bool {
        self.names.iter().any(|known| known.eq_ignore_ascii_case(name))
    }
}

impl Atoms {
    fn new(layout: &Layout) -> Atoms {
        let count = layout.names.len();
        Atoms {
            columns: vec![Vec::new(); count],
            unusable: vec![None; count],
            radii: Vec::new(),
            colors: Default::default(),
            strange: None,
        }
    }

    fn add(&mut self, line: &[u8], number: usize, layout: &Layout, looks: &Looks) -> Result<(), ModelError> {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        for (at, slot) in layout.slots.iter().enumerate() {
            let Some(word) = words.next() else {
                let message = format!("{at} words, where {} were expected", layout.slots.len());
                return Err(wrong_in_line(number, message).help("an atom is its element and three numbers"));
            };
            match *slot {
                Slot::Skipped => {}
                Slot::Symbol => self.add_look(word, number, looks),
                Slot::Number(column) => self.add_number(word, number, column),
            }
        }
        Ok(())
    }

    fn add_number(&mut self, word: &[u8], line: usize, column: usize) {
        let value = number::parse(word).unwrap_or(f64::NAN);
        if !value.is_finite() && self.unusable[column].is_none() {
            self.unusable[column] = Some(Unusable { line, text: shown(word) });
        }
        self.columns[column].push(value);
    }

    fn add_look(&mut self, symbol: &[u8], line: usize, looks: &Looks) {
        let look = looks.of(symbol).unwrap_or_else(|| {
            self.strange.get_or_insert_with(|| Unusable { line, text: shown(symbol) });
            UNKNOWN
        });
        self.radii.push(look.radius);
        for (channel, value) in self.colors.iter_mut().zip(look.color) {
            channel.push(value);
        }
    }

    fn done(self, layout: Layout) -> Table {
        let Atoms { columns, unusable, radii, colors, strange } = self;
        let (needs_radius, needs_color) =
            (!layout.has("radius"), !["red", "green", "blue"].iter().all(|name| layout.has(name)));
        let has_symbols = layout.slots.contains(&Slot::Symbol);
        let own = layout.names.into_iter().zip(columns).zip(unusable);
        let mut columns: Vec<Column> = own
            .map(|((name, numbers), unusable)| Column { unusable, ..Column::new(name, Numbers::F64(numbers)) })
            .collect();
        if has_symbols && needs_radius {
            columns.push(Column::new("radius", Numbers::F64(radii)));
        }
        if has_symbols && needs_color {
            let named = ["red", "green", "blue"].into_iter().zip(colors);
            columns.extend(named.map(|(name, channel)| Column::new(name, Numbers::U8(channel))));
        }
        let strange = strange.map(|Unusable { line, text }| {
            format!("`{text}` in line {line} is no element: such atoms are pink balls of radius {}", UNKNOWN.radius)
        });
        Table { columns, has_names: true, warnings: strange.into_iter().collect() }
    }
}

fn shown(word: &[u8]) -> String {
    String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: &str = "3\nwater, in angstrom\nO 0 0 0.1\nH 0.76 0 -0.5\r\nH\t-0.76 0 -0.5 extra words\n";

    fn names(table: &Table) -> Vec<&str> {
        table.columns.iter().map(|column| column.name.as_str()).collect()
    }

    #[test]
    fn atoms_have_places_radii_and_colors() {
        let table = read(WATER.as_bytes()).unwrap();
        assert_eq!(names(&table), ["x", "y", "z", "radius", "red", "green", "blue"]);
        let points = table.points([0, 1, 2]).unwrap();
        assert_eq!(points[1], durer_math::DVec3::new(0.76, 0.0, -0.5));
        assert_eq!(*table.sizes(3).unwrap(), [0.66, 0.31, 0.31]);
        let colors = table.colors([4, 5, 6]).unwrap();
        assert_eq!((colors[0].r, colors[1]), (1.0, durer_math::Rgb::WHITE));
        assert!(table.warnings.is_empty());
    }

    #[test]
    fn extended_files_say_what_their_columns_are() {
        let text = "2\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=id:I:1:species:S:1:pos:R:3:radius:R:1:Color:R:3:velo:R:2:tag:S:1 Time=0\n\
                    7 C 1 2 3 0.5 1 0 0 8 9 a\n8 H 4 5 6 0.25 0 1 0 8 9 b\n";
        let table = read(text.as_bytes()).unwrap();
        assert_eq!(names(&table), ["id", "x", "y", "z", "radius", "red", "green", "blue", "velo_1", "velo_2"]);
        assert_eq!(*table.sizes(4).unwrap(), [0.5, 0.25]);
        assert_eq!(table.points([1, 2, 3]).unwrap()[1], durer_math::DVec3::new(4.0, 5.0, 6.0));
        assert_eq!(table.colors([5, 6, 7]).unwrap()[0], durer_math::Rgb::new(1.0, 0.0, 0.0));
        let bare = read(b"1\nproperties=\"pos:R:3\"\n1 2 3\n").unwrap();
        assert_eq!(names(&bare), ["x", "y", "z"], "without elements, neither radius nor color");
    }

    #[test]
    fn what_is_left_out_is_said() {
        let table = read(b"1\n\nXx 0 0 0\n1\n\nO 0 0 0\n").unwrap();
        assert_eq!(table.rows(), 1);
        assert!(table.warnings[0].contains("`Xx` in line 3"), "{:?}", table.warnings);
        assert!(table.warnings[1].contains("from line 4 on"), "{:?}", table.warnings);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        let message = |text: &str| {
            let error = read(text.as_bytes()).unwrap_err();
            format!("{:?} {}", error.place, error.message)
        };
        assert_eq!(message(""), "Some(Line(1)) the number of atoms is missing");
        assert_eq!(message("O 0 0 0\n"), "Some(Line(1)) the number of atoms is missing");
        assert_eq!(message("99999999999\n\nO 0 0 0\n"), "None the file ends after 1 of 99999999999 atoms");
        assert_eq!(message("2\n\nO 0 0 0\nO 0 0\n"), "Some(Line(4)) 3 words, where 4 were expected");
        assert_eq!(message("1\nProperties=species:S:1\nO\n"), "Some(Line(2)) `Properties` lacks `pos:R:3`");
        assert_eq!(message("1\nProperties=a:R:999999999999\n"), "Some(Line(2)) `Properties` cannot be understood");
        let table = read(b"1\n\nO 0 nan 0\n").unwrap();
        assert_eq!(table.sizes(1).unwrap_err().message, "column 2 (`y`): `nan` is not finite");
    }

    /// A file cut everywhere, and every byte of it changed in several ways.
    #[test]
    fn no_bytes_break_it() {
        let extended = "2\nProperties=species:S:1:pos:R:3:radius:R:1\nC 1 2 3 0.5\nH 4 5 6 0.25\n";
        for good in [WATER, extended] {
            for at in 0..good.len() {
                let _ = read(&good.as_bytes()[..at]);
                for byte in [0, 0xff, b'9', b'-', b':', b'\n', b' '] {
                    let mut bad = good.as_bytes().to_vec();
                    bad[at] = byte;
                    if let Ok(table) = read(&bad) {
                        let rows = table.columns.iter().map(|column| column.numbers.len());
                        assert!(rows.clone().all(|rows| rows == table.rows()) && table.rows() < 10);
                    }
                }
            }
        }
    }
}
