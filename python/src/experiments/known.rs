//! The arms that come with the package, by name: the tables of `arms/`.

use std::sync::LazyLock;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use ulna_study::scenario::KnownArm;
use ulna_table::Model;
use ulna_table::toml_reader::closest;

macro_rules! tables {
    ($($name:ident)+) => {
        /// Each with its text.
        const TABLES: &[(&str, &str)] = &[$((
            stringify!($name),
            include_str!(concat!("../../arms/", stringify!($name), ".toml")),
        )),+];
    };
}

tables! {
    franka_panda geared_6 gen3 iiwa_14 oblique_6 planar_2r planar_3r puma_560 ssrms stanford_arm table1_literal ur5e
}

/// The names of the arms that come with the package.
#[pyfunction]
pub(crate) fn tables() -> Vec<&'static str> {
    TABLES.iter().map(|(name, _)| *name).collect()
}

/// The table of the arm called `name`.
#[pyfunction]
pub(crate) fn tables_text(name: &str) -> PyResult<&'static str> {
    text(name).ok_or_else(|| {
        let help = match closest(name, tables()) {
            Some(meant) => format!("did you mean {meant:?}?"),
            None => format!("there are {}", tables().join(", ")),
        };
        PyValueError::new_err(format!("no arm is called {name:?}: {help}"))
    })
}

pub(super) fn text(name: &str) -> Option<&'static str> {
    let mut tables = TABLES.iter();
    tables
        .find(|(known, _)| *known == name)
        .map(|(_, text)| *text)
}

/// What scenarios may call by name. Their joints stay in memory from the first scenario on, as those do that are compiled in.
pub(super) fn known() -> &'static [KnownArm] {
    static KNOWN: LazyLock<Vec<KnownArm>> = LazyLock::new(|| {
        let models = TABLES
            .iter()
            .filter_map(|(name, text)| Model::parse(text, name).ok().map(|model| (*name, model)));
        let arms = models.map(|(name, model)| {
            let names = model
                .joint_names()
                .iter()
                .map(|name| &*String::leak(name.clone()));
            KnownArm {
                name,
                joints: Vec::leak(model.joints().to_vec()),
                joint_names: Vec::leak(names.collect()),
            }
        });
        arms.collect()
    });
    &KNOWN
}
