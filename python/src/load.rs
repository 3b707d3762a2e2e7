//! From a file or a text to an [`Arm`].

use std::path::PathBuf;

use pyo3::prelude::*;
use ulna_table::diagnostics::Diagnostics;
use ulna_table::{Model, TableErrors};
use ulna_urdf::{Import, Imported};

use crate::arm::Arm;
use crate::errors::{DescriptionError, TableError, refused, warn, warn_of};

/// The arm of the table at `path`, or of the table `text`, which messages call `path`.
#[pyfunction]
pub(crate) fn read_table(py: Python<'_>, path: PathBuf, text: Option<&str>) -> PyResult<Arm> {
    let source = path.display().to_string();
    let called = source.clone();
    let read = move || -> Result<(String, Model, Diagnostics), TableErrors> {
        let text = match text {
            Some(text) => text.to_owned(),
            None => Model::read_in("", &path)?,
        };
        let (model, found) = Model::lint_text(&text, &called)?;
        Ok((text, model, found))
    };
    let (text, model, found) = py
        .detach(read)
        .map_err(|errors| refused::<TableError>(py, &[errors]))?;
    warn_of(py, &found)?;
    warned(py, Arm::new(model, text, source, Vec::new()))
}

/// The options of `ulna import`.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    base: Option<String>,
    tip: Option<String>,
    drop: Vec<String>,
    accept_inertia: Vec<String>,
    parallel: Vec<String>,
    name: Option<String>,
}

impl Options {
    fn import(self) -> Import {
        let import = Import::new();
        let import = self.base.into_iter().fold(import, Import::base);
        let import = self.tip.into_iter().fold(import, Import::tip);
        let import = self.name.into_iter().fold(import, Import::name);
        let import = self.drop.into_iter().fold(import, Import::drop);
        let inertias = self.accept_inertia.into_iter();
        let import = inertias.fold(import, Import::accept_inertia);
        self.parallel.into_iter().fold(import, Import::parallel)
    }
}

/// The arm of the robot description at `path`, or of the description `text`, which messages call `path`.
#[pyfunction]
pub(crate) fn import_description(
    py: Python<'_>,
    path: PathBuf,
    text: Option<&str>,
    options: Options,
) -> PyResult<Arm> {
    let import = options.import();
    let source = path.display().to_string();
    let called = source.clone();
    let read = move || -> Result<Imported, Diagnostics> {
        match text {
            Some(text) => import.parse(text, &called),
            None => import.load(&path),
        }
    };
    let imported = py
        .detach(read)
        .map_err(|errors| refused::<DescriptionError>(py, &[errors]))?;
    warn_of(py, imported.warnings())?;
    let notes = imported.notes().iter().map(ToString::to_string).collect();
    let arm = Arm::new(imported.model().clone(), imported.table(), source, notes);
    warned(py, arm)
}

/// The arm of a table that has been read before, in another process perhaps: what it is warned of has been said.
#[pyfunction]
pub(crate) fn restore(
    py: Python<'_>,
    table: String,
    source: String,
    notes: Vec<String>,
) -> PyResult<Arm> {
    let model =
        Model::parse(&table, &source).map_err(|errors| refused::<TableError>(py, &[errors]))?;
    Ok(Arm::new(model, table, source, notes))
}

/// The arm, after what the generator says of it.
fn warned(py: Python<'_>, arm: Arm) -> PyResult<Arm> {
    for sentence in py.detach(|| ulna_codegen::warnings(arm.model())) {
        warn(py, &format!("{}: {sentence}", arm.source()))?;
    }
    Ok(arm)
}
