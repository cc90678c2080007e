//! Particles: simple shapes by the million, from lists and files.

use super::decode::Fields;
use super::lists::{ColorList, List, SizeList};
use super::record::{Choice, FieldAbout, KindAbout, Record, choice, fields, record};
use super::tables::{self, FromTable, Role};
use super::tree::Span;
use super::write::FieldsOut;
use crate::data::Table;
use durer_math::{DVec3, Rgb};
use durer_scene::{Data, DataFile, ParticleKind, Particles, Sizes};
use std::rc::Rc;
use std::sync::Arc;

choice! { Written, "object";
    Spheres "spheres": "Balls by the million. Their colors take the place of the color of the material.",
    example "spheres: {centers: [[0, 0, 0], [1, 0, 0]], radius: 0.3, colors: [red, \"#0080ff\"]}",
    (Spheres)
    Cylinders "cylinders": "Cylinders by the million, as bonds between atoms.",
    example "cylinders: {bases: [[0, 0, 0], [1, 0, 0]], tops: [[1, 0, 0], [1, 1, 0]], radius: 0.1, open: true}",
    (Cylinders)
    Cones "cones": "Cones or frusta by the million, as heads of arrows.",
    example "cones: {bases: [[0, 0, 0]], tops: [[0, 1, 0]], radius: 0.2, top_radius: 0.1}",
    (Cones)
    Capsules "capsules": "Cylinders with a half ball at each end, by the million.",
    example "capsules: {bases: [[0, 0, 0]], tops: [[0, 1, 0]], radius: [0.2]}",
    (Capsules)
}

/// Particles as a scene file says them.
pub(crate) enum Written {
    Spheres(Spheres),
    Cylinders(Cylinders),
    Cones(Cones),
    Capsules(Capsules),
}

pub(crate) struct Spheres {
    file: Option<String>,
    centers: Option<List<DVec3>>,
    radius: Option<SizeList>,
    colors: Option<ColorList>,
}

record!(Spheres {
    file: Option<String> = None => "A data file that has what the other fields do not say, in columns of the usual names.";
    centers: Option<List<DVec3>> = None => "Their middles; required without `file`.";
    radius: Option<SizeList> = None => "Their radii, above 0: one for all, or one for each. Without it, those of `file`, or 1.";
    colors: Option<ColorList> = None => "A color for each. Without it, those of `file`, or none.";
});

pub(crate) struct Cylinders {
    file: Option<String>,
    bases: Option<List<DVec3>>,
    tops: Option<List<DVec3>>,
    radius: Option<SizeList>,
    open: bool,
    colors: Option<ColorList>,
}

record!(Cylinders {
    file: Option<String> = None => "A data file that has what the other fields do not say, in columns of the usual names.";
    bases: Option<List<DVec3>> = None => "Middles of one end; required without `file`.";
    tops: Option<List<DVec3>> = None => "Middles of the other end; required without `file`.";
    radius: Option<SizeList> = None => "Their radii, above 0: one for all, or one for each. Without it, those of `file`, or 1.";
    open: bool = false => "True takes the caps away.";
    colors: Option<ColorList> = None => "A color for each. Without it, those of `file`, or none.";
});

pub(crate) struct Cones {
    file: Option<String>,
    bases: Option<List<DVec3>>,
    tops: Option<List<DVec3>>,
    radius: Option<SizeList>,
    top_radius: Option<SizeList>,
    open: bool,
    colors: Option<ColorList>,
}

record!(Cones {
    file: Option<String> = None => "A data file that has what the other fields do not say, in columns of the usual names.";
    bases: Option<List<DVec3>> = None => "Middles of the bases; required without `file`.";
    tops: Option<List<DVec3>> = None => "The apices, or the middles of the tops; required without `file`.";
    radius: Option<SizeList> = None => "Radii of the bases, above 0: one for all, or one for each. Without it, those of `file`, or 1.";
    top_radius: Option<SizeList> = None => "Radii of the tops. Without it, those of `file`, or 0.";
    open: bool = false => "True takes the caps away.";
    colors: Option<ColorList> = None => "A color for each. Without it, those of `file`, or none.";
});

pub(crate) struct Capsules {
    file: Option<String>,
    bases: Option<List<DVec3>>,
    tops: Option<List<DVec3>>,
    radius: Option<SizeList>,
    colors: Option<ColorList>,
}

record!(Capsules {
    file: Option<String> = None => "A data file that has what the other fields do not say, in columns of the usual names.";
    bases: Option<List<DVec3>> = None => "Middles of one half ball; required without `file`.";
    tops: Option<List<DVec3>> = None => "Middles of the other half ball; required without `file`.";
    radius: Option<SizeList> = None => "Their radii, above 0: one for all, or one for each. Without it, those of `file`, or 1.";
    colors: Option<ColorList> = None => "A color for each. Without it, those of `file`, or none.";
});

/// The field `file`: what it has stands in for fields that are not given.
struct Own {
    file: Option<String>,
    span: Span,
    /// `None` if there is no such field, or the file cannot be read.
    table: Option<Rc<Table>>,
    /// How many points a particle has.
    points: usize,
}

impl Own {
    fn new(file: Option<String>, points: usize, from: &mut Fields<'_, '_, '_>) -> Own {
        let span = from.span_of("file");
        let table = file.as_ref().and_then(|file| tables::load(file, span, from.cx));
        if file.is_some() && table.is_none() {
            from.doubt();
        }
        Own { file, span, table, points }
    }

    /// True for the file itself: to name it again at a field changes nothing.
    fn is(&self, source: &DataFile) -> bool {
        source.columns.is_empty() && self.file.as_ref() == Some(&source.file)
    }

    /// What a field says, or else the file.
    fn list<T: FromTable>(&self, given: Option<List<T>>, role: Role, from: &mut Fields<'_, '_, '_>) -> Option<Data<T>> {
        match given {
            Some(List::InFile(source, _)) if self.is(&source) => self.columns(role, from),
            Some(list) => Some(list.resolve(role, from)),
            None => self.columns(role, from),
        }
    }

    /// What the file has.
    fn columns<T: FromTable>(&self, role: Role, from: &mut Fields<'_, '_, '_>) -> Option<Data<T>> {
        let (file, table) = (self.file.as_ref()?, self.table.as_ref()?);
        let columns = match table.has_names {
            true => role.by_name(table),
            false => role.by_position(table, self.points),
        };
        let values = tables::take(file, table, &columns?, self.span, from.cx).unwrap_or_else(|| {
            from.doubt();
            Arc::from([])
        });
        Some(Data { file: Some(DataFile { file: file.clone(), columns: Vec::new() }), values })
    }

    /// Points, which there must be.
    fn points(&self, given: Option<List<DVec3>>, role: Role, from: &mut Fields<'_, '_, '_>) -> Data<DVec3> {
        self.list(given, role, from).unwrap_or_else(|| {
            match (&self.file, &self.table) {
                (Some(file), Some(table)) => from.break_with(tables::lacking(file, table, role, self.span)),
                // They have been complained about.
                (Some(_), None) => {}
                (None, _) if from.has(role.field()) => {}
                (None, _) => from.lack(&format!("`{}`, or `file`", role.field())),
            }
            Data::inline([])
        })
    }

    fn sizes(&self, given: Option<SizeList>, role: Role, from: &mut Fields<'_, '_, '_>) -> Option<Sizes> {
        match given {
            Some(SizeList::Same(size)) => Some(Sizes::Same(size)),
            Some(SizeList::Each(list)) => self.list(Some(list), role, from).map(Sizes::Each),
            None => self.list(None, role, from).map(Sizes::Each),
        }
    }

    fn radii(&self, given: Option<SizeList>, from: &mut Fields<'_, '_, '_>) -> Sizes {
        self.sizes(given, Role::Radius, from).unwrap_or(Sizes::Same(1.0))
    }

    fn colors(&self, given: Option<ColorList>, from: &mut Fields<'_, '_, '_>) -> Option<Data<Rgb>> {
        match given {
            Some(ColorList::None) => None,
            Some(ColorList::Each(list)) => self.list(Some(list), Role::Colors, from),
            None => self.list(None, Role::Colors, from),
        }
    }
}

impl Written {
    /// The particles, with what files have.
    pub(crate) fn resolve(self, from: &mut Fields<'_, '_, '_>) -> Particles {
        let (own, kind, colors) = match self {
            Written::Spheres(Spheres { file, centers, radius, colors }) => {
                let own = Own::new(file, 1, from);
                let centers = own.points(centers, Role::Centers, from);
                let radii = own.radii(radius, from);
                (own, ParticleKind::Spheres { centers, radii }, colors)
            }
            Written::Cylinders(Cylinders { file, bases, tops, radius, open, colors }) => {
                let own = Own::new(file, 2, from);
                let (bases, tops) = (own.points(bases, Role::Bases, from), own.points(tops, Role::Tops, from));
                let radii = own.radii(radius, from);
                (own, ParticleKind::Cylinders { bases, tops, radii, open }, colors)
            }
            Written::Cones(Cones { file, bases, tops, radius, top_radius, open, colors }) => {
                let own = Own::new(file, 2, from);
                let (bases, tops) = (own.points(bases, Role::Bases, from), own.points(tops, Role::Tops, from));
                let radii = own.radii(radius, from);
                let top_radii = own.sizes(top_radius, Role::TopRadius, from).unwrap_or(Sizes::Same(0.0));
                (own, ParticleKind::Cones { bases, tops, radii, top_radii, open }, colors)
            }
            Written::Capsules(Capsules { file, bases, tops, radius, colors }) => {
                let own = Own::new(file, 2, from);
                let (bases, tops) = (own.points(bases, Role::Bases, from), own.points(tops, Role::Tops, from));
                let radii = own.radii(radius, from);
                (own, ParticleKind::Capsules { bases, tops, radii }, colors)
            }
        };
        let colors = own.colors(colors, from);
        Particles { file: own.file, kind, colors }
    }
}

/// What fields must say beside `file`, so that reading them gives the same again.
struct Beside<'p>(&'p Option<String>);

impl Beside<'_> {
    fn list<T>(&self, data: &Data<T>) -> Option<List<T>> {
        let is_own =
            data.file.as_ref().is_some_and(|source| source.columns.is_empty() && Some(&source.file) == self.0.as_ref());
        (!is_own).then(|| data.into())
    }

    /// A size for all may stand against the file's, so it is left out only where there is no file.
    fn sizes(&self, sizes: &Sizes, default: f64) -> Option<SizeList> {
        match sizes {
            Sizes::Same(size) => (self.0.is_some() || *size != default).then_some(SizeList::Same(*size)),
            Sizes::Each(data) => self.list(data).map(SizeList::Each),
        }
    }

    fn colors(&self, colors: &Option<Data<Rgb>>) -> Option<ColorList> {
        match colors {
            None => self.0.is_some().then_some(ColorList::None),
            Some(data) => self.list(data).map(ColorList::Each),
        }
    }
}

impl From<&Particles> for Written {
    fn from(particles: &Particles) -> Written {
        let file = particles.file.clone();
        let beside = Beside(&particles.file);
        let colors = beside.colors(&particles.colors);
        match &particles.kind {
            ParticleKind::Spheres { centers, radii } => Written::Spheres(Spheres {
                centers: beside.list(centers),
                radius: beside.sizes(radii, 1.0),
                file,
                colors,
            }),
            ParticleKind::Cylinders { bases, tops, radii, open } => {
                let (bases, tops) = (beside.list(bases), beside.list(tops));
                Written::Cylinders(Cylinders {
                    bases,
                    tops,
                    radius: beside.sizes(radii, 1.0),
                    open: *open,
                    file,
                    colors,
                })
            }
            ParticleKind::Cones { bases, tops, radii, top_radii, open } => {
                let (bases, tops) = (beside.list(bases), beside.list(tops));
                let (radius, top_radius) = (beside.sizes(radii, 1.0), beside.sizes(top_radii, 0.0));
                Written::Cones(Cones { bases, tops, radius, top_radius, open: *open, file, colors })
            }
            ParticleKind::Capsules { bases, tops, radii } => {
                let (bases, tops) = (beside.list(bases), beside.list(tops));
                Written::Capsules(Capsules { bases, tops, radius: beside.sizes(radii, 1.0), file, colors })
            }
        }
    }
}
