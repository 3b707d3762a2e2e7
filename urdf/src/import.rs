//! [`Import`]: from a robot description to an arm.

use std::path::Path;

use ulna_table::diagnostics::{Diagnostics, Sink};
use ulna_table::toml_reader::read_file;

use crate::chain::Chain;
use crate::describe::describe;
use crate::imported::Imported;
use crate::merge::assemble;
use crate::read::read;
use crate::report::Report;
use crate::tree::Tree;

/// The most bytes that a robot description may have; a humanoid's has a few hundred thousand.
const MAX_BYTES: u64 = 16 * 1024 * 1024;

/// Which part of a robot becomes the arm, and how: the options of `ulna import`.
///
/// Links are called by their names in the description.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[must_use]
pub struct Import {
    pub(crate) base: Option<String>,
    pub(crate) tip: Option<String>,
    pub(crate) drop: Vec<String>,
    pub(crate) accept_inertia: Vec<String>,
    pub(crate) parallel: Vec<String>,
    pub(crate) name: Option<String>,
}

impl Import {
    /// The only chain of the robot, from its root to its end.
    pub fn new() -> Self {
        Self::default()
    }

    /// The chain begins at this link, whose frame becomes the world's.
    pub fn base(mut self, link: impl Into<String>) -> Self {
        self.base = Some(link.into());
        self
    }

    /// The chain ends at this link, whose frame becomes the tool's.
    pub fn tip(mut self, link: impl Into<String>) -> Self {
        self.tip = Some(link.into());
        self
    }

    /// This link is left out, and all that hangs on it: its mass does not count.
    pub fn drop(mut self, link: impl Into<String>) -> Self {
        self.drop.push(link.into());
        self
    }

    /// The inertia of this link is taken over although no rigid body can have it.
    pub fn accept_inertia(mut self, link: impl Into<String>) -> Self {
        self.accept_inertia.push(link.into());
        self
    }

    /// The axis of this joint is taken as parallel to that of the joint before, if the two are almost parallel with their
    /// common normal too far away for rows to keep their digits: an arm that was calibrated is then its nominal one there.
    pub fn parallel(mut self, joint: impl Into<String>) -> Self {
        self.parallel.push(joint.into());
        self
    }

    /// The arm is called so, and not after the robot.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// Imports the description at `path`. Nothing else is opened: no mesh, no entity.
    ///
    /// # Errors
    /// Everything that is wrong with the file, or keeps the chain from being an arm, at once.
    pub fn load(&self, path: impl AsRef<Path>) -> Result<Imported, Diagnostics> {
        let path = path.as_ref();
        let text = read_file(Path::new(""), path, MAX_BYTES)?;
        self.parse(&text, &path.display().to_string())
    }

    /// Imports the description `text`, which errors call `source_name`.
    ///
    /// # Errors
    /// Everything that is wrong with the text, or keeps the chain from being an arm, at once.
    pub fn parse(&self, text: &str, source_name: &str) -> Result<Imported, Diagnostics> {
        let sink = Sink::new(source_name, text);
        let imported = self.examine(text, source_name, &sink);
        let found = sink.finish();
        match imported {
            Some(imported) if !found.has_errors() => Ok(Imported {
                warnings: found,
                ..imported
            }),
            _ => Err(found),
        }
    }

    fn examine(&self, text: &str, source_name: &str, sink: &Sink) -> Option<Imported> {
        let mut report = Report::new(text, sink);
        let robot = read(text, sink)?;
        let tree = Tree::grow(robot, sink)?;
        let chain = Chain::find(&tree, self, &mut report)?;
        let assembly = assemble(&tree, &chain, self, &mut report);
        describe(self, source_name, &tree, &chain, assembly, report)
    }
}
