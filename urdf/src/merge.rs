//! [`Assembly`]: the bodies that the chain's joints move. What hangs on by fixed joints counts with a joint's link;
//! what could move beside the chain is frozen, and counts too.

use crate::body::Body;
use crate::chain::Chain;
use crate::frame::Frame;
use crate::freeze::Freezer;
use crate::import::Import;
use crate::judge::{Accepted, Judged, is_possible, judge, weighs};
use crate::note::NoteKind;
use crate::report::Report;
use crate::robot::quoted;
use crate::suspicious;
use crate::tree::Tree;

/// The arm as bodies on joints, in the description's own frames.
pub(crate) struct Assembly {
    /// Base first.
    pub(crate) segments: Vec<Segment>,
    /// The tip's frame in that of the last joint.
    pub(crate) tool: Frame,
}

/// A joint and the body that it moves.
pub(crate) struct Segment {
    pub(crate) joint: usize,
    /// The joint's frame at q = 0 in that of the joint before; the first one's in the base link's.
    pub(crate) placement: Frame,
    /// The body, in the joint's frame.
    pub(crate) body: Body,
    /// The links that were counted with the joint's own, in the file's order.
    pub(crate) merged: Vec<String>,
    /// Whether the body is taken over although no rigid body can be like that.
    pub(crate) accepted: bool,
}

/// Puts the chain's bodies together. `None` if something has been reported.
pub(crate) fn assemble(
    tree: &Tree,
    chain: &Chain,
    import: &Import,
    report: &mut Report,
) -> Option<Assembly> {
    let mut accepted = Accepted::of(tree, import, report);
    for joint in &chain.path {
        suspicious::joint(tree, *joint, report);
    }
    let mut placements = Vec::new();
    let mut tool = Frame::identity();
    for joint in &chain.path {
        let element = tree.joint(*joint);
        tool = tool.times(&element.origin.frame);
        if element.motion.moves() {
            placements.push(std::mem::replace(&mut tool, Frame::identity()));
        }
    }
    let freezer = Freezer::new(tree, chain);
    let mut sound = accepted.is_some();
    let mut segments = Vec::new();
    for (joint, placement) in chain.joints.iter().zip(placements) {
        let gathered = gather(tree, chain, *joint, &freezer, &mut accepted, report);
        sound &= gathered.sound;
        segments.push(Segment {
            joint: *joint,
            placement,
            body: gathered.body,
            merged: gathered.merged,
            accepted: gathered.accepted,
        });
    }
    beside_the_base(tree, chain, report);
    sound &= weighs(tree, &segments, report);
    for segment in &mut segments {
        sound &= is_possible(tree, segment, accepted.as_mut(), report);
    }
    if let Some(accepted) = accepted {
        accepted.report_unused(tree, report);
    }
    sound.then_some(Assembly { segments, tool })
}

struct Gathered {
    body: Body,
    merged: Vec<String>,
    accepted: bool,
    sound: bool,
}

/// The body that a joint of the chain moves, without those that the next one moves.
fn gather(
    tree: &Tree,
    chain: &Chain,
    joint: usize,
    freezer: &Freezer,
    accepted: &mut Option<Accepted>,
    report: &mut Report,
) -> Gathered {
    let own = tree.child_link(joint);
    let mut gathered = Gathered {
        body: Body::none(),
        merged: Vec::new(),
        accepted: false,
        sound: true,
    };
    let mut heavy = Vec::new();
    let mut frozen = Vec::new();
    let mut open = vec![(own, Frame::identity())];
    while let Some((link, frame)) = open.pop() {
        let element = tree.link(link);
        if link != own {
            gathered.merged.push(element.name.clone());
        }
        if let Some(inertial) = &element.inertial
            && !inertial.body.is_nothing()
        {
            if link != own {
                heavy.push(element.name.as_str());
            }
            suspicious::body(element, inertial, report);
            gathered.body = gathered.body.joined(&inertial.body.seen_from(&frame));
            match judge(tree, link, accepted.as_mut(), report) {
                Judged::Sound => {}
                Judged::Accepted => gathered.accepted = true,
                Judged::Refused => gathered.sound = false,
            }
        }
        // Last in, first out: the file's order.
        for joint in tree.child_joints(link).iter().rev() {
            let child = tree.child_link(*joint);
            if !chain.dropped[child] && chain.place(*joint).is_none() {
                let element = tree.joint(*joint);
                let mut frame = frame.times(&element.origin.frame);
                if element.motion.moves() {
                    frozen.push(*joint);
                    frame = frame.times(&freezer.displacement(*joint));
                }
                if !chain.path.contains(joint) {
                    suspicious::joint(tree, *joint, report);
                }
                open.push((child, frame));
            }
        }
    }
    let name = &tree.link(own).name;
    if !heavy.is_empty() {
        let message = format!("counted with `{name}`: {}", listed(&heavy));
        report.note_at(&tree.link(own).span, NoteKind::Merged, message);
    }
    frozen.sort_unstable();
    freezer.report(&frozen, name, report);
    gathered
}

/// Notes the joints that could move on the base beside the arm: what they move does not concern it.
fn beside_the_base(tree: &Tree, chain: &Chain, report: &mut Report) {
    let mut beside = Vec::new();
    let mut open = vec![chain.base];
    while let Some(link) = open.pop() {
        for joint in tree.child_joints(link) {
            let child = tree.child_link(*joint);
            if tree.joint(*joint).motion.moves() {
                if chain.place(*joint).is_none() && !chain.dropped[child] {
                    beside.push(*joint);
                }
            } else {
                open.push(child);
            }
        }
    }
    beside.sort_unstable();
    if beside.is_empty() {
        return;
    }
    let names: Vec<_> = beside
        .iter()
        .map(|joint| &tree.joint(*joint).name)
        .collect();
    let message = format!(
        "what moves on the base beside the arm does not count: {}",
        listed(&names)
    );
    report.note(NoteKind::Dropped, message);
}

/// All of the names.
pub(crate) fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let names: Vec<_> = names.iter().map(|name| quoted(name.as_ref())).collect();
    names.join(", ")
}
