//! Not there yet.
pub(crate) fn run(_: &super::Options<'_>) -> Result<(), String> { Err("not there yet".to_owned()) }
