//! [`Assembly`]: the bodies that the chain's joints move. What hangs on by fixed joints counts with a joint's link;
//! what could move beside the chain is frozen, and counts too.

use ulna_table::diagnostics::Diagnostic;
use ulna_table::impossible_inertia;

use crate::body::Body;
use crate::chain::{Chain, link};
use crate::frame::Frame;
use crate::freeze::Freezer;
use crate::import::Import;
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

/// The links whose inertias are to be taken over, and whether that was needed.
struct Accepted(Vec<(usize, bool)>);

impl Accepted {
    fn of(tree: &Tree, import: &Import, report: &Report) -> Option<Self> {
        let names = import.accept_inertia.iter();
        let links: Vec<_> = names
            .map(|name| link(tree, "accept-inertia", name, report.sink()))
            .collect();
        let links: Option<Vec<_>> = links.into_iter().collect();
        Some(Self(links?.into_iter().map(|link| (link, false)).collect()))
    }

    /// Whether the link's inertia is to be taken over, as it must be.
    fn takes(&mut self, link: usize) -> bool {
        let mut taken = false;
        for (other, used) in &mut self.0 {
            if *other == link {
                *used = true;
                taken = true;
            }
        }
        taken
    }

    fn report_unused(&self, tree: &Tree, report: &mut Report) {
        for (link, _) in self.0.iter().filter(|(_, used)| !used) {
            let element = tree.link(*link);
            let message = format!(
                "`--accept-inertia {}` is not needed: a rigid body can have that inertia, or it does not count",
                element.name
            );
            report.note_at(&element.span, NoteKind::Accepted, message);
        }
    }
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

enum Judged {
    Sound,
    Accepted,
    Refused,
}

/// Whether a rigid body can be as the description says that the link is.
fn judge(tree: &Tree, link: usize, accepted: Option<&mut Accepted>, report: &mut Report) -> Judged {
    let element = tree.link(link);
    let Some(inertial) = &element.inertial else {
        return Judged::Sound;
    };
    let Some((rule, numbers)) = inertial.body.fault() else {
        return Judged::Sound;
    };
    let name = &element.name;
    let message = format!("the inertia of link `{name}` {rule}");
    let span = inertial.inertia_span.clone();
    if accepted.is_some_and(|accepted| accepted.takes(link)) {
        report.push(Diagnostic::warning(span, message).label(numbers).help(
            "it is taken over as `--accept-inertia` says: torques follow from it, but no rigid body moves so",
        ));
        return Judged::Accepted;
    }
    if inertial.body.mass == 0.0 {
        report.push(Diagnostic::error(span, message).label(numbers).help(format!(
            "a frame without mass has no inertia: write zeros, or leave its <inertial> out; `--accept-inertia {name}` counts what stands there"
        )));
        return Judged::Refused;
    }
    report.push(Diagnostic::error(span, message).label(numbers).help(format!(
        "correct it: the tensor about the centroid, in the axes of <inertial>'s <origin>, in kg m^2; \
         if it is known and meant as it is, `--accept-inertia {name}` takes it over"
    )));
    Judged::Refused
}

/// Whether all that moves has mass. Reports what has none.
fn weighs(tree: &Tree, segments: &[Segment], report: &Report) -> bool {
    let light = |segment: &&Segment| segment.body.mass == 0.0;
    let without: Vec<&Segment> = segments.iter().filter(light).collect();
    if let Some(first) = without.first()
        && without.len() == segments.len()
        && segments.len() > 1
    {
        let link = tree.link(tree.child_link(first.joint));
        report.push(
            Diagnostic::error(
                link.span.clone(),
                "no link of the chain has mass: the description says how the arm moves, and nothing of its dynamics",
            )
            .label("the first of them")
            .help("look for a description whose links have <inertial>; data sheets and papers on identification give the numbers"),
        );
        return false;
    }
    for segment in &without {
        let link = tree.link(tree.child_link(segment.joint));
        let joint = &tree.joint(segment.joint).name;
        let parent = &tree.link(tree.parent_link(segment.joint)).name;
        let (what, place) = match &link.inertial {
            Some(inertial) => ("has a mass of 0", &inertial.mass_span),
            None => ("has no <inertial>", &link.span),
        };
        let message = format!(
            "the link `{}` moves, and {what}; neither has anything that is fixed to it",
            link.name
        );
        report.push(Diagnostic::error(place.clone(), message).help(format!(
            "give it its mass and inertia, make joint `{joint}` fixed in the URDF, or end the chain before it with `--tip {parent}`"
        )));
    }
    without.is_empty()
}

/// Whether a rigid body can be like all of a joint's together. What is thin or a point by itself must not be in the end:
/// a moving link without inertia about some axis makes the mass matrix singular.
fn is_possible(
    tree: &Tree,
    segment: &mut Segment,
    accepted: Option<&mut Accepted>,
    report: &Report,
) -> bool {
    let own = tree.child_link(segment.joint);
    let possible = impossible_inertia(&segment.body.inertia_rows());
    let Some(found) = possible.filter(|_| segment.body.mass > 0.0) else {
        segment.accepted = false;
        return true;
    };
    let element = tree.link(own);
    let refused = element
        .inertial
        .as_ref()
        .is_some_and(|own| own.body.fault().is_some());
    if segment.accepted || accepted.is_some_and(|accepted| accepted.takes(own)) {
        segment.accepted = true;
        return true;
    }
    // Of a part that is wrong by itself it has been said.
    if refused {
        return false;
    }
    let span = match &element.inertial {
        Some(inertial) => inertial.inertia_span.clone(),
        None => element.span.clone(),
    };
    let with = match segment.merged.is_empty() {
        true => String::new(),
        false => ", with what is counted with it,".to_owned(),
    };
    let message = format!(
        "the inertia of link `{}`{with} {}",
        element.name,
        found.rule()
    );
    report.push(
        Diagnostic::error(span, message)
            .label(found.numbers())
            .help(format!(
                "a link that moves has inertia about every axis: give it; \
         if it is known and meant as it is, `--accept-inertia {}` takes it over",
                element.name
            )),
    );
    false
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
