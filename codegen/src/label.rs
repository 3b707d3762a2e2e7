//! What values are called: names that the formulas give to expressions, for whoever reads the generated code.
//!
//! A name changes nothing but the text. It belongs to a family (`m`, the entries of the mass matrix), whose meaning stands once,
//! in [the legend](crate::formulate::legend), and is printed in the docs of each kernel that has values of it.

use std::fmt::Write as _;

/// The name of a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// What it has in common with others, by which its meaning is looked up.
    pub family: &'static str,
    /// The name itself: an identifier in ASCII.
    pub text: String,
}

impl Label {
    /// The name of what is derived by the value of this name.
    pub(crate) fn of_adjoint(&self) -> Self {
        Self {
            family: "bar",
            text: format!("{}_bar", self.text),
        }
    }
}

/// Indices as a name has them: `_2_3` for 1 and 2, since joints are counted from 1 in the generated code.
pub(crate) fn subscripts(indices: &[usize]) -> String {
    let mut text = String::new();
    for index in indices {
        // Writing to a String does not fail.
        let _ = write!(text, "_{}", index + 1);
    }
    text
}
