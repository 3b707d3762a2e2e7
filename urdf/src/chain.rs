//! [`Chain`]: which joints of the tree are the arm.

use ulna_table::diagnostics::{Diagnostic, Sink};
use ulna_table::toml_reader::closest;

use crate::ends::{Ends, ends};
use crate::import::Import;
use crate::note::NoteKind;
use crate::report::Report;
use crate::robot::Motion;
use crate::tree::{Tree, some_of};

/// The most joints that a table can have.
const MOST_JOINTS: usize = 32;

/// A serial chain in the tree, from its base to its tip.
pub(crate) struct Chain {
    pub(crate) base: usize,
    pub(crate) tip: usize,
    /// All joints from base to tip, fixed ones too.
    pub(crate) path: Vec<usize>,
    /// Those of them that move, 1 to 32.
    pub(crate) joints: Vec<usize>,
    /// Which links are left out.
    pub(crate) dropped: Vec<bool>,
}

impl Chain {
    /// The chain that `import` asks for, or the only one. `None` if something has been reported.
    pub(crate) fn find(tree: &Tree, import: &Import, report: &mut Report) -> Option<Self> {
        let sink = report.sink();
        let dropped = dropped(tree, import, report);
        let base = match &import.base {
            Some(name) => link(tree, "base", name, sink),
            None => Some(tree.root),
        };
        let named_tip = match &import.tip {
            Some(name) => link(tree, "tip", name, sink).map(Some),
            None => Some(None),
        };
        let (dropped, base, named_tip) = (dropped?, base?, named_tip?);
        let gone = |what: &str, link: usize| {
            let name = &tree.link(link).name;
            let message = format!("the {what} `{name}` is among what `--drop` leaves out");
            sink.push(
                Diagnostic::error(tree.link(link).span.clone(), message)
                    .help("drop what hangs beside the chain, or name another base and tip"),
            );
        };
        if dropped[base] {
            gone("base", base);
            return None;
        }
        if let Some(tip) = named_tip.filter(|tip| dropped[*tip]) {
            gone("tip", tip);
            return None;
        }
        let tip = match named_tip {
            Some(tip) => tip,
            None => {
                let Ends { tip, note } = ends(tree, base, &dropped, sink)?;
                report.notes.extend(note);
                tip
            }
        };
        let sink = report.sink();
        let Some(path) = tree.path(base, tip) else {
            let names = (&tree.link(base).name, &tree.link(tip).name);
            let message = format!(
                "the tip `{}` does not hang on the base `{}`",
                names.1, names.0
            );
            let help = match tree.path(tip, base) {
                Some(_) => format!(
                    "it is the other way round: `--base {} --tip {}`",
                    names.1, names.0
                ),
                None => format!(
                    "name a base from which joints lead to `{}`; all hang on `{}`",
                    names.1,
                    tree.link(tree.root).name
                ),
            };
            sink.push(Diagnostic::error(tree.link(tip).span.clone(), message).help(help));
            return None;
        };
        let moves = |joint: &usize| tree.joint(*joint).motion.moves();
        let joints: Vec<usize> = path.iter().copied().filter(moves).collect();
        let chain = Self {
            base,
            tip,
            path,
            joints,
            dropped,
        };
        let sound = chain.examine(tree, sink);
        sound.then_some(chain)
    }

    /// Whether all its joints are such as a table can have. Reports those that are not.
    fn examine(&self, tree: &Tree, sink: &Sink) -> bool {
        let mut sound = true;
        let mut refuse = |error: Diagnostic| {
            sink.push(error);
            sound = false;
        };
        for joint in &self.joints {
            let element = tree.joint(*joint);
            let (parent, child) = (
                &tree.link(tree.parent_link(*joint)).name,
                &tree.link(tree.child_link(*joint)).name,
            );
            let span = element.span.clone();
            if let Some(mimic) = &element.mimic {
                let message = format!(
                    "joint `{}` of the chain mimics `{}`: it has no coordinate of its own, and a table's joints all have one",
                    element.name, mimic.joint.name
                );
                refuse(Diagnostic::error(span.clone(), message).help(format!(
                    "end the chain before it with `--tip {parent}`, or make it fixed in the URDF"
                )));
            }
            let (freedoms, what) = match element.motion {
                Motion::Planar => ("three", "planar"),
                Motion::Floating => ("six", "floating"),
                _ => continue,
            };
            let message = format!(
                "joint `{}` of the chain is {what}: it has {freedoms} degrees of freedom, and a table's joints have one",
                element.name
            );
            refuse(Diagnostic::error(span, message).help(format!(
                "begin the chain after it with `--base {child}`, or make it fixed in the URDF"
            )));
        }
        let names = (&tree.link(self.base).name, &tree.link(self.tip).name);
        if self.joints.is_empty() {
            refuse(
                Diagnostic::error(
                    tree.link(self.tip).span.clone(),
                    format!("no joint moves between the base `{}` and the tip `{}`", names.0, names.1),
                )
                .help("name a base and a tip with revolute, continuous or prismatic joints between them"),
            );
        }
        if let Some(joint) = self.joints.get(MOST_JOINTS) {
            let message = format!(
                "the chain has {} joints, and an arm may have {MOST_JOINTS}",
                self.joints.len()
            );
            let parent = &tree.link(tree.parent_link(*joint)).name;
            refuse(
                Diagnostic::error(tree.joint(*joint).span.clone(), message)
                    .label("the first that is too many")
                    .help(format!("take a part of it: `--tip {parent}` ends it here")),
            );
        }
        sound
    }

    /// Whether the joint is one of those that move the arm; its place among them.
    pub(crate) fn place(&self, joint: usize) -> Option<usize> {
        self.joints.iter().position(|other| *other == joint)
    }
}

/// The link that an option names. Reports it if there is none.
pub(crate) fn link(tree: &Tree, option: &str, name: &str, sink: &Sink) -> Option<usize> {
    let found = tree.find_link(name);
    if found.is_none() {
        let message = format!("there is no link `{name}` for `--{option}`");
        let names = tree.robot.links.iter().map(|link| &link.name);
        let help = match closest(name, names.clone()) {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!("the links are {}", some_of(&names.collect::<Vec<_>>())),
        };
        sink.push(Diagnostic::file_error(message).help(help));
    }
    found
}

/// Which links are left out: those named, and what hangs on them.
fn dropped(tree: &Tree, import: &Import, report: &mut Report) -> Option<Vec<bool>> {
    let mut dropped = vec![false; tree.robot.links.len()];
    let mut sound = true;
    for name in &import.drop {
        let Some(link) = link(tree, "drop", name, report.sink()) else {
            sound = false;
            continue;
        };
        let gone = tree.subtree(link);
        let message = match gone.len() {
            1 => format!("`{name}` is left out"),
            count => format!("`{name}` is left out, and what hangs on it: {count} links together"),
        };
        report.note_at(&tree.link(link).span, NoteKind::Dropped, message);
        gone.into_iter().for_each(|link| dropped[link] = true);
    }
    sound.then_some(dropped)
}
