//! Bodies that can be, that cannot, and that are taken over all the same.

use ulna_table::diagnostics::Diagnostic;
use ulna_table::impossible_inertia;

use crate::chain::link;
use crate::import::Import;
use crate::merge::Segment;
use crate::note::NoteKind;
use crate::report::Report;
use crate::tree::Tree;

/// The links whose inertias are to be taken over, and whether that was needed.
pub(crate) struct Accepted(Vec<(usize, bool)>);

impl Accepted {
    pub(crate) fn of(tree: &Tree, import: &Import, report: &Report) -> Option<Self> {
        let names = import.accept_inertia.iter();
        let links: Vec<_> = names
            .map(|name| link(tree, "accept-inertia", name, report.sink()))
            .collect();
        let links: Option<Vec<_>> = links.into_iter().collect();
        Some(Self(links?.into_iter().map(|link| (link, false)).collect()))
    }

    /// Whether the link's inertia is to be taken over, as it must be.
    pub(crate) fn takes(&mut self, link: usize) -> bool {
        let mut taken = false;
        for (other, used) in &mut self.0 {
            if *other == link {
                *used = true;
                taken = true;
            }
        }
        taken
    }

    pub(crate) fn report_unused(&self, tree: &Tree, report: &mut Report) {
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

/// What is to be done with a link's inertia.
pub(crate) enum Judged {
    Sound,
    Accepted,
    Refused,
}

/// Whether a rigid body can be as the description says that the link is.
pub(crate) fn judge(
    tree: &Tree,
    link: usize,
    accepted: Option<&mut Accepted>,
    report: &mut Report,
) -> Judged {
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
pub(crate) fn weighs(tree: &Tree, segments: &[Segment], report: &Report) -> bool {
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
        // Before the first joint there is no chain left.
        let without_it = if segment.joint == segments[0].joint {
            format!("begin the chain after it with `--base {}`", link.name)
        } else {
            format!("end the chain before it with `--tip {parent}`")
        };
        report.push(Diagnostic::error(place.clone(), message).help(format!(
            "give it its mass and inertia, make joint `{joint}` fixed in the URDF, or {without_it}"
        )));
    }
    without.is_empty()
}

/// Whether a rigid body can be like all of a joint's together. What is thin or a point by itself must not be in the end:
/// a moving link without inertia about some axis makes the mass matrix singular.
pub(crate) fn is_possible(
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
