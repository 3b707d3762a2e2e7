//! From the arm of a scenario to one that experiments can be made with.

use anyhow::bail;
use ulna_experiments::{ByTable, CompiledFor, Copies, MAX_JOINTS, Subject};
use ulna_study::scenario::{KnownArm, ScenarioArm};
use ulna_table::Model;

use crate::console;

macro_rules! generated_arms {
    ($(($Type:ident, $name:ident, $joints:literal))+) => {
        /// The arms that were generated when the program was compiled.
        pub(crate) const GENERATED: &[KnownArm] = &[$(KnownArm {
            name: stringify!($name),
            joints: &ulna_generated::$Type::CHAIN.joints,
            joint_names: &ulna_generated::$Type::JOINT_NAMES,
        }),+];

        fn generated(name: &str) -> anyhow::Result<Box<dyn Subject>> {
            match name {
                $(stringify!($name) => {
                    let arm = Box::new(ulna_generated::$Type::default());
                    Ok(<Copies as CompiledFor<$joints>>::subject(arm, ulna_generated::$Type::CHAIN))
                })+
                _ => bail!("no arm `{name}` was compiled into the program"),
            }
        }
    };
}
ulna_generated::for_each_arm!(generated_arms);

/// The arm of a scenario: generated code where there is some, and otherwise machine code made of its table now.
/// Where the machine has none, the textbook, which it says: a command calls it once.
///
/// # Errors
/// When the arm has more joints than the program was compiled for.
pub(crate) fn subject(arm: &ScenarioArm) -> anyhow::Result<Box<dyn Subject>> {
    let (path, model) = match arm {
        ScenarioArm::Known(known) => return generated(known.name),
        ScenarioArm::Table { path, model } => (path, model),
    };
    let ByTable { subject, no_code } = by_table(model)?;
    if let Some(error) = no_code {
        console::note(&format!(
            "arm `{}` of {} is not compiled into the program, and {error}: it runs by the textbook formulas, \
             slower, with the same numbers but for rounding",
            model.name(),
            path.display()
        ));
    }
    Ok(subject)
}

/// The arm of a table.
fn by_table(model: &Model) -> anyhow::Result<ByTable> {
    let joints = model.joints().len();
    if joints > MAX_JOINTS {
        bail!(
            "arm `{}` has {joints} joints; `ulna reproduce`, `ulna assess` and `ulna campaign` take up to {MAX_JOINTS}. \
             `ulna check`, `ulna generate`, `ulna cost` and `ulna verify` take every arm, up to {all} joints; \
             experiments with more than {MAX_JOINTS} are a program of your own, with `ulna_study` and `Jit::<{joints}>` of `ulna_jit`",
            model.name(),
            all = Model::MAX_JOINTS,
        );
    }
    Ok(ulna_experiments::by_table(model)?)
}
