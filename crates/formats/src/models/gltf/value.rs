//! Values of a glTF file that know their place in it, and say so if they are wrong.

use super::super::ModelError;
use super::json::Json;
use std::fmt;

/// A way from the top of the file down to a value: `meshes[2].primitives[0].indices`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Place {
    steps: [Option<Step>; 8],
}

#[derive(Clone, Copy, Debug)]
enum Step {
    Field(&'static str),
    Index(u32),
}

impl Place {
    /// The field of the file itself.
    pub(super) fn field(self, name: &'static str) -> Place {
        self.then(Step::Field(name))
    }

    /// The element of this list.
    pub(super) fn index(self, index: usize) -> Place {
        self.then(Step::Index(index as u32))
    }

    /// glTF is not as deep as this is long; what is beyond would be left out.
    fn then(mut self, step: Step) -> Place {
        if let Some(free) = self.steps.iter_mut().find(|step| step.is_none()) {
            *free = Some(step);
        }
        self
    }

    /// The error that something is wrong here.
    pub(super) fn fault(&self, message: impl fmt::Display) -> ModelError {
        ModelError::new(match self.steps[0] {
            Some(_) => format!("{self}: {message}"),
            None => message.to_string(),
        })
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, step) in self.steps.iter().flatten().enumerate() {
            match step {
                Step::Field(name) if at == 0 => write!(f, "{name}")?,
                Step::Field(name) => write!(f, ".{name}")?,
                Step::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}

/// A value, and where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value<'a> {
    json: &'a Json<'a>,
    pub(super) place: Place,
}

/// Characters of a name. Many objects may get one name, and no one reads on.
const LONGEST_NAME: usize = 200;
/// The largest whole number that a JSON number can be trusted with.
const LARGEST_WHOLE: f64 = (1_u64 << 53) as f64;

impl<'a> Value<'a> {
    /// The whole file, which must have fields.
    pub(super) fn root(json: &'a Json<'a>) -> Result<Value<'a>, ModelError> {
        Value { json, place: Place::default() }.with_fields()
    }

    /// The error that something is wrong with this value.
    pub(super) fn fault(&self, message: impl fmt::Display) -> ModelError {
        self.place.fault(message)
    }

    fn with_fields(self) -> Result<Value<'a>, ModelError> {
        match self.json {
            Json::Fields(_) => Ok(self),
            _ => Err(self.fault("this must be a JSON object")),
        }
    }

    /// A field; `None` if it is missing or null.
    fn field(&self, name: &'static str) -> Option<Value<'a>> {
        let Json::Fields(fields) = self.json else { return None };
        let at = fields.binary_search_by(|(other, _)| other.as_ref().cmp(name)).ok()?;
        let json = &fields[at].1;
        (!matches!(json, Json::Null)).then(|| Value { json, place: self.place.field(name) })
    }

    /// True if there is such a field.
    pub(super) fn has(&self, name: &'static str) -> bool {
        self.field(name).is_some()
    }

    /// A field that has fields.
    pub(super) fn object(&self, name: &'static str) -> Result<Option<Value<'a>>, ModelError> {
        self.field(name).map(Value::with_fields).transpose()
    }

    /// What the extension with this name says here.
    pub(super) fn extension(&self, name: &'static str) -> Result<Option<Value<'a>>, ModelError> {
        match self.object("extensions")? {
            Some(extensions) => extensions.object(name),
            None => Ok(None),
        }
    }

    pub(super) fn number(&self, name: &'static str) -> Result<Option<f64>, ModelError> {
        self.field(name).map(|value| value.as_number()).transpose()
    }

    /// A count, an index or an offset.
    pub(super) fn whole(&self, name: &'static str) -> Result<Option<usize>, ModelError> {
        self.field(name).map(|value| value.as_whole()).transpose()
    }

    /// A count, an index or an offset that must be there.
    pub(super) fn required_whole(&self, name: &'static str) -> Result<usize, ModelError> {
        self.whole(name)?.ok_or_else(|| self.fault(format!("`{name}` is missing")))
    }

    pub(super) fn flag(&self, name: &'static str) -> Result<bool, ModelError> {
        match self.field(name) {
            None => Ok(false),
            Some(Value { json: Json::Flag(flag), .. }) => Ok(*flag),
            Some(other) => Err(other.fault("this must be true or false")),
        }
    }

    pub(super) fn text(&self, name: &'static str) -> Result<Option<&'a str>, ModelError> {
        self.field(name).map(|value| value.as_text()).transpose()
    }

    /// The name that authors gave this value, or its beginning; empty names and what is not text are none.
    pub(super) fn name(&self) -> Option<String> {
        let name = self.text("name").ok().flatten().filter(|name| !name.is_empty())?;
        Some(name.chars().take(LONGEST_NAME).collect())
    }

    /// The elements of a list; none if there is no list.
    pub(super) fn list(&self, name: &'static str) -> Result<List<'a>, ModelError> {
        match self.field(name) {
            None => Ok(List { json: &[], place: self.place.field(name) }),
            Some(Value { json: Json::List(json), place }) => Ok(List { json, place }),
            Some(other) => Err(other.fault("this must be a list")),
        }
    }

    /// A list of so many numbers.
    pub(super) fn numbers<const N: usize>(&self, name: &'static str) -> Result<Option<[f64; N]>, ModelError> {
        let Some(field) = self.field(name) else { return Ok(None) };
        let list = self.list(name)?;
        if list.len() != N {
            return Err(field.fault(format!("there must be {N} numbers, not {}", list.len())));
        }
        let mut numbers = [0.0; N];
        for (number, value) in numbers.iter_mut().zip(list.iter()) {
            *number = value.as_number()?;
        }
        Ok(Some(numbers))
    }

    pub(super) fn as_number(&self) -> Result<f64, ModelError> {
        match self.json {
            Json::Number(number) if number.is_finite() => Ok(*number),
            _ => Err(self.fault("this must be a number")),
        }
    }

    pub(super) fn as_whole(&self) -> Result<usize, ModelError> {
        match self.json {
            Json::Number(number) if number.fract() == 0.0 && (0.0..=LARGEST_WHOLE).contains(number) => {
                Ok(*number as usize)
            }
            _ => Err(self.fault("this must be a whole number, 0 or more")),
        }
    }

    pub(super) fn as_text(&self) -> Result<&'a str, ModelError> {
        match self.json {
            Json::Text(text) => Ok(text),
            _ => Err(self.fault("this must be text")),
        }
    }
}

/// A list, and where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct List<'a> {
    json: &'a [Json<'a>],
    pub(super) place: Place,
}

impl<'a> List<'a> {
    pub(super) fn is_empty(&self) -> bool {
        self.json.is_empty()
    }

    pub(super) fn len(&self) -> usize {
        self.json.len()
    }

    pub(super) fn iter(self) -> impl Iterator<Item = Value<'a>> {
        self.json.iter().enumerate().map(move |(at, json)| Value { json, place: self.place.index(at) })
    }

    /// An element that has fields; `None` if the list is not so long.
    pub(super) fn object(&self, index: usize) -> Result<Option<Value<'a>>, ModelError> {
        let value = self.json.get(index).map(|json| Value { json, place: self.place.index(index) });
        value.map(Value::with_fields).transpose()
    }
}

#[cfg(test)]
mod tests {
    use super::super::json::parse;
    use super::*;

    #[test]
    fn faults_know_their_place() {
        let json = parse(br#"{"nodes": [{}, {"scale": [1, 2]}, 7]}"#, None, 100).unwrap();
        let nodes = Value::root(&json).unwrap().list("nodes").unwrap();
        let fault = nodes.object(1).unwrap().unwrap().numbers::<3>("scale").unwrap_err();
        assert_eq!(fault.message, "nodes[1].scale: there must be 3 numbers, not 2");
        assert_eq!(nodes.object(2).unwrap_err().message, "nodes[2]: this must be a JSON object");
        assert!(nodes.object(3).unwrap().is_none());
    }

    #[test]
    fn fields_that_are_null_are_missing() {
        let json = parse(br#"{"a": null, "b": 1.5, "c": 3, "d": -1, "e": 1e300}"#, None, 100).unwrap();
        let root = Value::root(&json).unwrap();
        assert_eq!((root.has("a"), root.has("b"), root.has("f")), (false, true, false));
        assert_eq!(root.number("b").unwrap(), Some(1.5));
        assert_eq!(root.whole("c").unwrap(), Some(3));
        for name in ["b", "d", "e"] {
            assert!(root.whole(name).unwrap_err().message.ends_with("a whole number, 0 or more"));
        }
        assert_eq!(root.required_whole("a").unwrap_err().message, "`a` is missing");
    }
}
