//! [`ends`]: where a chain can end that nobody has given a tip.

use ulna_table::diagnostics::{Diagnostic, Sink};

use crate::note::{Note, NoteKind};
use crate::robot::Motion;
use crate::tree::{Tree, some_of};

/// Where the chain ends.
pub(crate) struct Ends {
    pub(crate) tip: usize,
    /// What to say of it.
    pub(crate) note: Option<Note>,
}

/// A link at which a chain can end.
struct Candidate {
    /// The last joint that moves.
    joint: usize,
    /// How many move from the base on.
    joints: usize,
    tip: usize,
}

/// The tip of the only chain of joints from `base`. `None` if there is none or are several, which has been reported then.
///
/// A chain can end where nothing moves any more, where branches part, and before a single joint that others mimic:
/// that is a gripper.
pub(crate) fn ends(tree: &Tree, base: usize, dropped: &[bool], sink: &Sink) -> Option<Ends> {
    let search = Search { tree, dropped };
    let mut candidates = Vec::new();
    // Each with the number of joints that lead to it.
    let mut open: Vec<(usize, usize)> = search
        .next_joints(base)
        .into_iter()
        .map(|j| (j, 1))
        .collect();
    open.reverse();
    while let Some((joint, joints)) = open.pop() {
        let next = search.next_joints(tree.child_link(joint));
        let goes_on = match next[..] {
            [only] => !search.is_gripper(only),
            _ => false,
        };
        if !goes_on {
            let (tip, _) = search.tool(joint);
            candidates.push(Candidate { joint, joints, tip });
        }
        open.extend(next.into_iter().rev().map(|joint| (joint, joints + 1)));
    }
    match &candidates[..] {
        [] => {
            sink.push(none(tree, base));
            None
        }
        [only] => {
            let (tip, leaves) = search.tool(only.joint);
            Some(Ends {
                tip,
                note: note(tree, tip, &leaves),
            })
        }
        several => {
            sink.push(choice(tree, base, several));
            None
        }
    }
}

struct Search<'t> {
    tree: &'t Tree,
    dropped: &'t [bool],
}

impl Search<'_> {
    /// The links that hang on `link` by one joint of a kind, and are not dropped.
    fn children(&self, link: usize) -> impl Iterator<Item = usize> {
        let joints = self.tree.child_joints(link).iter().copied();
        joints.filter(|joint| !self.dropped[self.tree.child_link(*joint)])
    }

    /// The joints that move next from `link` on, in the file's order, through fixed ones; those that mimic others are no joints of an arm.
    fn next_joints(&self, link: usize) -> Vec<usize> {
        let mut found = Vec::new();
        let mut open = vec![link];
        while let Some(link) = open.pop() {
            for joint in self.children(link) {
                let element = self.tree.joint(joint);
                if !element.motion.moves() {
                    open.push(self.tree.child_link(joint));
                } else if element.mimic.is_none() {
                    found.push(joint);
                }
            }
        }
        found.sort_unstable();
        found
    }

    /// Whether the joint is the last of its branch, and others mimic it.
    fn is_gripper(&self, joint: usize) -> bool {
        let mut mimics = self.tree.mimics(joint);
        let mimicked = mimics.any(|other| !self.dropped[self.tree.child_link(other)]);
        mimicked && self.next_joints(self.tree.child_link(joint)).is_empty()
    }

    /// The tool of a chain whose last joint is `joint`: the only frame that hangs behind it by fixed joints, or the one
    /// that is called `tool0` as ROS asks for (REP 199), or the last before they part. And the frames at the ends.
    fn tool(&self, joint: usize) -> (usize, Vec<usize>) {
        let moved = self.tree.child_link(joint);
        let mut leaves = Vec::new();
        let mut open = vec![moved];
        while let Some(link) = open.pop() {
            let before = open.len();
            open.extend(self.fixed_children(link));
            if open.len() == before {
                leaves.push(link);
            }
        }
        leaves.sort_unstable();
        let called_tool = |link: &&usize| self.tree.link(**link).name.ends_with("tool0");
        let tools: Vec<usize> = leaves.iter().filter(called_tool).copied().collect();
        if let ([only], _) | (_, [only]) = (&leaves[..], &tools[..]) {
            return (*only, leaves);
        }
        let mut last = moved;
        loop {
            let mut fixed = self.fixed_children(last);
            match (fixed.next(), fixed.next()) {
                (Some(only), None) => last = only,
                _ => break,
            }
        }
        (last, leaves)
    }

    fn fixed_children(&self, link: usize) -> impl Iterator<Item = usize> {
        let fixed = |joint: &usize| self.tree.joint(*joint).motion == Motion::Fixed;
        self.children(link)
            .filter(fixed)
            .map(|joint| self.tree.child_link(joint))
    }
}

/// What to say where other frames could be meant as the tool.
fn note(tree: &Tree, tip: usize, leaves: &[usize]) -> Option<Note> {
    let others = leaves.iter().filter(|leaf| **leaf != tip);
    let others: Vec<&str> = others.map(|leaf| tree.link(*leaf).name.as_str()).collect();
    if others.is_empty() {
        return None;
    }
    let message = format!(
        "the tool's frame is that of `{}`; `--tip` takes another: {}",
        tree.link(tip).name,
        some_of(&others)
    );
    Some(Note {
        kind: NoteKind::Chosen,
        message,
        line: None,
    })
}

fn none(tree: &Tree, base: usize) -> Diagnostic {
    let moving: Vec<_> = tree
        .robot
        .joints
        .iter()
        .filter(|joint| joint.motion.moves())
        .collect();
    let span = tree.link(base).span.clone();
    let name = &tree.link(base).name;
    let mimics = moving.iter().all(|joint| joint.mimic.is_some());
    let (message, help) = match moving.is_empty() {
        true => (
            "no joint of the robot moves".to_owned(),
            "an arm needs a joint that is revolute, continuous or prismatic",
        ),
        false if mimics => (
            "every joint that moves mimics another".to_owned(),
            "one of them must be a joint of its own: leave its <mimic> out",
        ),
        false => (
            format!("no joint moves from the base `{name}` on"),
            "name another base, or drop less",
        ),
    };
    Diagnostic::error(span, message).help(help)
}

fn choice(tree: &Tree, base: usize, several: &[Candidate]) -> Diagnostic {
    /// So many are listed; a humanoid has some dozens.
    const LISTED: usize = 60;
    let message = format!(
        "there are {} chains that begin at the base `{}`: which one is the arm?",
        several.len(),
        tree.link(base).name
    );
    let name = |candidate: &Candidate| tree.link(candidate.tip).name.as_str();
    let listed = || several.iter().take(LISTED);
    let width = listed().map(|c| name(c).chars().count()).max().unwrap_or(0);
    let mut lines: Vec<String> = listed()
        .map(|candidate| {
            let s = if candidate.joints == 1 { "" } else { "s" };
            format!(
                "--tip {:width$}   {} joint{s}, the last one `{}`",
                name(candidate),
                candidate.joints,
                tree.joint(candidate.joint).name
            )
        })
        .collect();
    if let Some(more @ 1..) = several.len().checked_sub(LISTED) {
        lines.push(format!("and {more} more"));
    }
    let mut error = Diagnostic::error(tree.link(base).span.clone(), message);
    // Not shortened, as other texts are: the one that is meant may be the last.
    error.help = Some(format!(
        "add one of these to the command, or `--drop LINK` for what is no part of it; what moves beside the chain is frozen at 0\n{}",
        lines.join("\n")
    ));
    error
}
