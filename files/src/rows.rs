//! Rows of a CSV file: structs whose fields are the columns.

use serde::Serialize;

/// The whole file: the columns' names, and a line for each row.
pub fn file<T: Default + Serialize>(rows: impl IntoIterator<Item = T>) -> anyhow::Result<String> {
    Ok(header::<T>()? + &lines(rows)?)
}

/// The columns' names.
pub fn header<T: Default + Serialize>() -> anyhow::Result<String> {
    // The names are known while a row is written, and to a file without rows they matter too.
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.serialize(T::default())?;
    let text = String::from_utf8(csv.into_inner()?)?;
    let (names, _) = text.split_at(text.find('\n').map_or(text.len(), |end| end + 1));
    Ok(names.to_owned())
}

/// A line for each row.
pub fn lines<T: Serialize>(rows: impl IntoIterator<Item = T>) -> anyhow::Result<String> {
    let mut csv = csv::WriterBuilder::new()
        .has_headers(false)
        .from_writer(Vec::new());
    for row in rows {
        csv.serialize(row)?;
    }
    Ok(String::from_utf8(csv.into_inner()?)?)
}
