//! `laws` of [campaign] and of [assess].

use crate::laws::LawName;
use ulna_table::toml_reader::{Located, Value};

/// Names of laws as they are written, each read by itself.
pub(in crate::scenario) type LawList = Option<Located<Vec<Option<Located<LawName>>>>>;

pub(super) fn read_laws(value: Value<'_>) -> LawList {
    let place = value.location();
    let items = value.items("an array of strings")?;
    Some(place.map(|()| items.into_iter().map(Value::choice).collect()))
}
