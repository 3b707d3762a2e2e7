//! The native half of the Python package `ulna`.
//!
//! What Python sees is in `ulna/`: classes with types and docs, which call what is here. Here arrays are read and made
//! (`arguments`, `results`), methods run without Python's lock and on many threads (`run`, `threads`), errors become
//! exceptions with the program's words (`errors`), experiments dictionaries of arrays (`experiments`), and campaigns
//! files (`campaign`).

mod arguments;
mod arm;
mod campaign;
mod errors;
mod experiments;
mod load;
mod parts;
mod reports;
mod results;
mod run;
mod threads;

use pyo3::pymodule;

/// The native half of the package `ulna`; use that.
#[pymodule]
mod _ulna {
    #[pymodule_export]
    use crate::arm::Arm;
    #[pymodule_export]
    use crate::campaign::{Campaign, FolderLock};
    #[pymodule_export]
    use crate::errors::{
        CampaignError, DescriptionError, Error, ExperimentError, Finding, ScenarioError,
        TableError, TableWarning,
    };
    #[pymodule_export]
    use crate::experiments::{
        Law, Operation, Plan, Scenario, control_cycle, lock_impact, plan_motion, read_scenario,
        restore_scenario, tables, tables_text,
    };
    #[pymodule_export]
    use crate::load::{import_description, read_table, restore};
    #[pymodule_export]
    use crate::parts::methods;
    #[pymodule_export]
    use crate::threads::{set_threads, threads};
}
