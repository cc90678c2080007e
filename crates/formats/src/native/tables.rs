//! Files with tables: each is read once, through [`Assets`](crate::Assets); and which of their columns are meant.

use super::decode::Decoder;
use super::suggest;
use super::tree::{Span, shorten};
use crate::data::{self, Table};
use crate::diagnostics::Complaint;
use crate::models::ModelError;
use durer_math::{DVec3, Rgb};
use durer_scene::DataFile;
use std::any::{Any, TypeId};
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

/// What columns are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    Centers,
    Bases,
    Tops,
    Radius,
    TopRadius,
    Colors,
    Positions,
    Rotations,
    Scale,
}

/// Lists that have been taken from tables, by file, columns, and what they are of: however often a scene asks for them,
/// they take memory once.
pub(crate) type Taken = BTreeMap<(String, Vec<usize>, TypeId), Rc<dyn Any>>;

/// What can be taken from a table.
pub(crate) trait FromTable: Sized + 'static {
    /// How many columns it takes.
    const COLUMNS: usize;
    /// A value for each row; `columns` are as many as it takes, and there.
    fn take(table: &Table, columns: &[usize]) -> Result<Arc<[Self]>, ModelError>;
}

impl FromTable for DVec3 {
    const COLUMNS: usize = 3;
    fn take(table: &Table, columns: &[usize]) -> Result<Arc<[DVec3]>, ModelError> {
        table.points([columns[0], columns[1], columns[2]])
    }
}

impl FromTable for Rgb {
    const COLUMNS: usize = 3;
    fn take(table: &Table, columns: &[usize]) -> Result<Arc<[Rgb]>, ModelError> {
        table.colors([columns[0], columns[1], columns[2]])
    }
}

impl FromTable for f64 {
    const COLUMNS: usize = 1;
    fn take(table: &Table, columns: &[usize]) -> Result<Arc<[f64]>, ModelError> {
        table.sizes(columns[0])
    }
}

const PLACES: &[[&str; 3]] = &[
    ["x", "y", "z"],
    ["px", "py", "pz"],
    ["pos_x", "pos_y", "pos_z"],
    ["position_x", "position_y", "position_z"],
    // As ParaView writes them.
    ["points:0", "points:1", "points:2"],
];

/// Bases and tops.
const ENDS: &[[[&str; 3]; 2]] = &[
    [["x0", "y0", "z0"], ["x1", "y1", "z1"]],
    [["x1", "y1", "z1"], ["x2", "y2", "z2"]],
    [["base_x", "base_y", "base_z"], ["top_x", "top_y", "top_z"]],
    [["start_x", "start_y", "start_z"], ["end_x", "end_y", "end_z"]],
    [["ax", "ay", "az"], ["bx", "by", "bz"]],
];

const COLORS: &[[&str; 3]] = &[["red", "green", "blue"], ["r", "g", "b"], ["color_r", "color_g", "color_b"]];

const ROTATIONS: &[[&str; 3]] =
    &[["rx", "ry", "rz"], ["rot_x", "rot_y", "rot_z"], ["rotation_x", "rotation_y", "rotation_z"]];

impl Role {
    /// The field of scene files.
    pub(crate) fn field(self) -> &'static str {
        match self {
            Role::Centers => "centers",
            Role::Bases => "bases",
            Role::Tops => "tops",
            Role::Radius => "radius",
            Role::TopRadius => "top_radius",
            Role::Colors => "colors",
            Role::Positions => "positions",
            Role::Rotations => "rotations",
            Role::Scale => "scale",
        }
    }

    /// The columns with the usual names.
    pub(crate) fn by_name(self, table: &Table) -> Option<Vec<usize>> {
        let all = |names: &[&str]| names.iter().map(|name| table.named(name)).collect::<Option<Vec<usize>>>();
        let first = |names: &[[&str; 3]]| names.iter().find_map(|names| all(names));
        let one = |names: &[&str]| names.iter().find_map(|name| Some(vec![table.named(name)?]));
        match self {
            Role::Centers | Role::Positions => first(PLACES),
            Role::Bases | Role::Tops => {
                let which = usize::from(self == Role::Tops);
                let both = ENDS.iter().find(|ends| ends.iter().all(|names| all(names).is_some()));
                both.map_or_else(|| ENDS.iter().find_map(|ends| all(&ends[which])), |ends| all(&ends[which]))
            }
            // Beside a green, `r` is red.
            Role::Radius if table.named("g").is_some() => one(&["radius", "size"]),
            Role::Radius => one(&["radius", "r", "size"]),
            Role::TopRadius => one(&["top_radius"]),
            Role::Colors => first(COLORS),
            Role::Rotations => first(ROTATIONS),
            Role::Scale => one(&["scale", "size", "s"]),
        }
    }

    /// The columns of a table without names that has all of one set of particles: points, of which there are `points`,
    /// then a radius, then a color; the last two may be missing.
    pub(crate) fn by_position(self, table: &Table, points: usize) -> Option<Vec<usize>> {
        let (has_radius, has_color) = match table.columns.len().checked_sub(3 * points)? {
            0 => (false, false),
            1 => (true, false),
            3 => (false, true),
            4 => (true, true),
            _ => return None,
        };
        let three_from = |first: usize| Some((first..first + 3).collect());
        match self {
            Role::Centers | Role::Positions | Role::Bases => three_from(0),
            Role::Tops => three_from(3),
            Role::Radius if has_radius => Some(vec![3 * points]),
            Role::Colors if has_color => three_from(3 * points + usize::from(has_radius)),
            Role::Radius | Role::Colors | Role::TopRadius | Role::Rotations | Role::Scale => None,
        }
    }
}

/// The table in a file, or `None` after complaining (at its first use only).
pub(crate) fn load(file: &str, span: Span, cx: &mut Decoder<'_>) -> Option<Rc<Table>> {
    if let Some(known) = cx.tables.get(file) {
        return known.clone();
    }
    let table = read(file, span, cx).map(Rc::new);
    cx.tables.insert(file.to_owned(), table.clone());
    table
}

fn read(file: &str, span: Span, cx: &mut Decoder<'_>) -> Option<Table> {
    let bytes = match cx.assets.read(file, cx.limits.max_file_bytes) {
        Ok(bytes) => bytes,
        Err(error) => {
            let complaint = Complaint::error(span, format!("cannot read the data file `{}`", shorten(file)));
            return cx.complain(complaint.label(error.to_string()).maybe_help(error.help()));
        }
    };
    match data::read(file, &bytes, cx.limits) {
        Ok(table) => {
            for warning in &table.warnings {
                let _: Option<()> = cx.complain(Complaint::warning(span, format!("`{}`: {warning}", shorten(file))));
            }
            Some(table)
        }
        Err(error) => cx.complain(unusable(file, span, &error)),
    }
}

fn unusable(file: &str, span: Span, error: &ModelError) -> Complaint {
    let complaint = Complaint::error(span, format!("cannot use the data file `{}`", shorten(file)));
    complaint.label(error.to_string()).maybe_help(error.help.clone())
}

/// The values in a file.
pub(crate) fn values<T: FromTable>(
    source: &DataFile,
    role: Role,
    span: Span,
    cx: &mut Decoder<'_>,
) -> Option<Arc<[T]>> {
    let table = load(&source.file, span, cx)?;
    let columns = match source.columns.is_empty() {
        true => usual::<T>(&source.file, &table, role, span),
        false => named::<T>(source, &table, span),
    };
    match columns {
        Ok(columns) => take(&source.file, &table, &columns, span, cx),
        Err(complaint) => cx.complain(*complaint),
    }
}

/// The values in columns of a table.
pub(crate) fn take<T: FromTable>(
    file: &str,
    table: &Table,
    columns: &[usize],
    span: Span,
    cx: &mut Decoder<'_>,
) -> Option<Arc<[T]>> {
    let key = (file.to_owned(), columns.to_vec(), TypeId::of::<T>());
    if let Some(known) = cx.taken.get(&key).and_then(|known| known.downcast_ref::<Arc<[T]>>()) {
        return Some(Arc::clone(known));
    }
    match T::take(table, columns) {
        Ok(values) => {
            cx.taken.insert(key, Rc::new(Arc::clone(&values)));
            Some(values)
        }
        Err(error) => cx.complain(unusable(file, span, &error)),
    }
}

/// The columns that are named, or counted.
fn named<T: FromTable>(source: &DataFile, table: &Table, span: Span) -> Result<Vec<usize>, Box<Complaint>> {
    let DataFile { file, columns } = source;
    if columns.len() != T::COLUMNS {
        let message = format!("expected {} here, found {}", counted(T::COLUMNS), columns.len());
        return Err(Box::new(Complaint::error(span, message)));
    }
    let find = |word: &String| {
        table.column(word).ok_or_else(|| {
            let message = format!("`{}` has no column `{}`", shorten(file), shorten(word));
            let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
            let help = match table.has_names {
                true => suggest::did_you_mean(word, &names, "columns"),
                false => format!("its columns have no names: use numbers from 1 to {}", table.columns.len()),
            };
            Box::new(Complaint::error(span, message).help(help))
        })
    };
    columns.iter().map(find).collect()
}

/// The columns that are usual, or all if there are no others.
fn usual<T: FromTable>(file: &str, table: &Table, role: Role, span: Span) -> Result<Vec<usize>, Box<Complaint>> {
    let all = || (table.columns.len() == T::COLUMNS).then(|| (0..T::COLUMNS).collect());
    // A file of ends has no mere places; but one that is asked for one end may.
    let places = || matches!(role, Role::Bases | Role::Tops).then(|| Role::Centers.by_name(table)).flatten();
    let found = role.by_name(table).or_else(places).or_else(all);
    found.ok_or_else(|| Box::new(lacking(file, table, role, span)))
}

/// The complaint that a table lacks the columns for a field.
pub(crate) fn lacking(file: &str, table: &Table, role: Role, span: Span) -> Complaint {
    let message = format!("`{}` has no usual columns for `{}`", shorten(file), role.field());
    let names: Vec<String> = table.columns.iter().map(|column| shorten(&column.name)).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let label = match table.has_names {
        true => format!("its columns are {}", suggest::list(&names)),
        false => format!("it has {} without names", counted(names.len())),
    };
    let chosen = match (role, table.has_names) {
        (Role::Radius | Role::TopRadius | Role::Scale, true) => names.first().copied().unwrap_or("radius").to_owned(),
        (Role::Radius | Role::TopRadius | Role::Scale, false) => "4".to_owned(),
        (_, true) if names.len() >= 3 => names[..3].join(", "),
        _ => "1, 2, 3".to_owned(),
    };
    let help = format!("say which: `{}: {{file: {}, columns: [{chosen}]}}`", role.field(), shorten(file));
    Complaint::error(span, message).label(label).help(help)
}

fn counted(columns: usize) -> String {
    if columns == 1 { "1 column".to_owned() } else { format!("{columns} columns") }
}
