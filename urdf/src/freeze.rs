//! [`Freezer`]: where what could move beside the chain is held.

use ulna_table::diagnostics::Diagnostic;

use crate::chain::Chain;
use crate::frame::Frame;
use crate::note::NoteKind;
use crate::report::Report;
use crate::robot::{JointElement, Motion, Number, quoted};
use crate::tree::Tree;

/// Holds every joint that is not of the chain at q = 0, and one that mimics another where that puts it.
pub(crate) struct Freezer<'t> {
    tree: &'t Tree,
    chain: &'t Chain,
}

impl<'t> Freezer<'t> {
    pub(crate) fn new(tree: &'t Tree, chain: &'t Chain) -> Self {
        Self { tree, chain }
    }

    /// The coordinate at which the joint is held, rad (m), if all others are at 0 or mimic.
    fn coordinate(&self, joint: usize) -> f64 {
        // q = m₁ (m₂ (… + o₂)) + o₁, from the joint on to the one that mimics none.
        let (mut factor, mut value) = (1.0, 0.0);
        let mut at = Some(joint);
        while let Some(mimic) = at.and_then(|joint| self.tree.joint(joint).mimic.as_ref()) {
            value += factor * mimic.offset;
            factor *= mimic.multiplier;
            at = at.and_then(|joint| self.tree.master(joint));
        }
        value
    }

    /// Where the joint's child link stands in the joint's frame.
    pub(crate) fn displacement(&self, joint: usize) -> Frame {
        let q = self.coordinate(joint);
        let element = self.tree.joint(joint);
        if q == 0.0 {
            return Frame::identity();
        }
        match element.motion {
            Motion::Revolute | Motion::Continuous => Frame::turned(&element.axis.unit, q),
            Motion::Prismatic => Frame::moved(element.axis.unit * q),
            Motion::Fixed | Motion::Planar | Motion::Floating => Frame::identity(),
        }
    }

    /// The joint of the chain that the joint follows, if there is one.
    fn master(&self, joint: usize) -> Option<&'t JointElement> {
        let masters = std::iter::successors(Some(joint), |joint| self.tree.master(*joint));
        let mut moving = masters
            .skip(1)
            .filter(|joint| self.chain.place(*joint).is_some());
        moving.next().map(|joint| self.tree.joint(joint))
    }

    /// Says which joints are held, and where: those whose links count with the link `with`.
    pub(crate) fn report(&self, frozen: &[usize], with: &str, report: &mut Report) {
        let mut plain: Vec<String> = Vec::new();
        for joint in frozen {
            let element = self.tree.joint(*joint);
            let name = &element.name;
            let q = self.coordinate(*joint);
            match (&element.mimic, self.master(*joint)) {
                (Some(_), Some(master)) => report.push(
                    Diagnostic::warning(
                        element.span.clone(),
                        format!(
                            "joint `{name}` is frozen at {q}, and counts with `{with}`; in the robot it moves with joint `{}`",
                            master.name
                        ),
                    )
                    .help("the arm's dynamics are those with it held still: a loop or a linkage is no serial chain"),
                ),
                (Some(mimic), None) => {
                    let message = format!(
                        "joint `{name}` mimics `{}`, which does not move here: it is frozen at {q}, and counts with `{with}`",
                        mimic.joint.name
                    );
                    report.note_at(&element.span, NoteKind::Frozen, message);
                }
                (None, _) => match element.motion {
                    Motion::Planar | Motion::Floating => {
                        plain.push(format!("`{name}` ({})", element.motion.word()));
                    }
                    _ => plain.push(quoted(name)),
                },
            }
            self.report_limits(element, q, report);
        }
        if !plain.is_empty() {
            let message = format!(
                "beside the chain, frozen at 0 and counted with `{with}`: {}",
                plain.join(", ")
            );
            report.note(NoteKind::Frozen, message);
        }
    }

    /// Says that a joint is held where it cannot be.
    fn report_limits(&self, element: &JointElement, q: f64, report: &mut Report) {
        let (Some(limit), Motion::Revolute | Motion::Prismatic) = (&element.limit, element.motion)
        else {
            return;
        };
        let value = |number: &Option<Number>| number.as_ref().map_or(0.0, |n| n.value);
        let (lower, upper) = (value(&limit.lower), value(&limit.upper));
        if lower < upper && !(lower..=upper).contains(&q) {
            let message = format!(
                "joint `{}` is frozen at {q}, outside its limits {lower} to {upper}",
                element.name
            );
            report.note_at(&limit.span, NoteKind::Frozen, message);
        }
    }
}
