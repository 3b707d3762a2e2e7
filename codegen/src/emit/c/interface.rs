//! What is written beside the functions of the methods, for an [interface](Abi) that is asked for.

use super::options::Abi;
use super::target::Target;
use crate::Compiled;

/// Functions beside those of the methods.
#[derive(Default)]
pub(super) struct Further {
    /// For the header: docs and declarations.
    pub(super) prototypes: Vec<String>,
    /// For the source file.
    pub(super) definitions: Vec<String>,
}

/// The functions of the interface that the options ask for.
pub(super) fn further(target: &Target<'_>, _compiled: &Compiled) -> Further {
    match target.options.abi {
        None | Some(Abi::Casadi) => Further::default(),
    }
}
