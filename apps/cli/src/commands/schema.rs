//! `durer schema`: the JSON Schema of scene files.

use crate::exit::{Exit, Failure};
use crate::output;

/// Prints the schema.
pub(crate) fn run() -> Result<Exit, Failure> {
    output::print_json(&durer::json_schema())?;
    Ok(Exit::Fine)
}
