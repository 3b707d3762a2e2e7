//! What the arm has to spare for its task, in sentences: without a null space no law can do anything.

use std::fmt::{self, Write};

use ulna::control::null_space::NEAR_SINGULAR;
use ulna_study::Scenario;
use ulna_study::experiment::{LockMechanics, Redundancy};

use crate::reproduce::words::{joints_named, significant};

/// The components of a wrench.
const COMPONENTS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// What is left at one lock.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Room {
    /// Torques before the lock and after it leave the tool force alone.
    Both,
    /// Only before it.
    BeforeOnly,
    /// None does.
    None,
}

impl Room {
    pub(super) fn of(lock: &LockMechanics) -> Self {
        match (lock.before.free(), lock.after.free()) {
            (0, _) => Self::None,
            (_, 0) => Self::BeforeOnly,
            _ => Self::Both,
        }
    }
}

/// A sentence for all locks, or one for each kind of them; the gravest first.
pub(super) fn write(
    page: &mut String,
    scenario: &Scenario,
    locks: &[LockMechanics],
) -> fmt::Result {
    let Some(first) = locks.first() else {
        return Ok(());
    };
    let task: Vec<_> = first.task.iter().map(|row| COMPONENTS[*row]).collect();
    let which = joints_named(scenario.failed_joints());
    for room in [Room::None, Room::BeforeOnly, Room::Both] {
        let of_kind: Vec<_> = locks.iter().filter(|lock| Room::of(lock) == room).collect();
        let Some(lock) = of_kind.first() else {
            continue;
        };
        let at = if of_kind.len() == locks.len() {
            String::new()
        } else {
            format!(
                " (lock at {} s)",
                listed(&of_kind, |lock| lock.failure_time.to_string())
            )
        };
        let before = counts(&of_kind, |lock| &lock.before);
        let after = counts(&of_kind, |lock| &lock.after);
        let joints = lock.before.joints;
        let rows = task.len();
        let task = task.join(", ");
        match room {
            Room::None => writeln!(
                page,
                "**This arm has no joint to spare{at}.** Its task ({task}) takes {} of its {joints} directions of joint torque, so that no torque \
                 leaves the tool force alone, neither before the lock of {which} nor after it. The projectors of Eq. 16 and 20 are 0, \
                 and so is every compensation that keeps the force: the laws below change nothing, and only torques that bend the tool force could.\n",
                ranks(&of_kind, |lock| &lock.before),
            )?,
            Room::BeforeOnly => writeln!(
                page,
                "**With {which} locked this arm has no joint to spare{at}.** Before the lock {before} of {joints} directions of joint torque leave the tool force \
                 ({task}) alone, after it none of {}: the laws below can act before the lock only.\n",
                lock.after.joints,
            )?,
            Room::Both => writeln!(
                page,
                "The task has {rows} components ({task}). Of {joints} directions of joint torque {before} leave the tool force alone before the lock{at}; \
                 of the {} that are left after it, {after}.\n",
                lock.after.joints,
            )?,
        }
    }
    let short: Vec<_> = locks
        .iter()
        .filter(|lock| lock.after.rank < lock.before.rank)
        .collect();
    if !short.is_empty() {
        writeln!(
            page,
            "With {which} locked the task has {} of {} independent rows left (lock at {} s): the arm cannot follow its path any more, \
             and along the lost direction a force error counts as 0 although no torque decides the force there.\n",
            ranks(&short, |lock| &lock.after),
            ranks(&short, |lock| &lock.before),
            listed(&short, |lock| lock.failure_time.to_string()),
        )?;
    }
    // Where a row is lost it is said above.
    let lost = |lock: &LockMechanics| lock.after.rank < lock.before.rank;
    let near = |redundancy: &Redundancy| redundancy.conditioning < NEAR_SINGULAR;
    let near: Vec<_> = locks
        .iter()
        .filter(|lock| near(&lock.before) || (near(&lock.after) && !lost(lock)))
        .collect();
    if !near.is_empty() {
        writeln!(
            page,
            "The pose at the lock is near-singular at {} s (conditioning {} before, {} after the lock; below {NEAR_SINGULAR} every compensation is faded out).\n",
            listed(&near, |lock| lock.failure_time.to_string()),
            listed(&near, |lock| significant(lock.before.conditioning)),
            listed(&near, |lock| significant(lock.after.conditioning)),
        )?;
    }
    Ok(())
}

fn listed(locks: &[&LockMechanics], text: impl Fn(&LockMechanics) -> String) -> String {
    let texts: Vec<_> = locks.iter().map(|lock| text(lock)).collect();
    texts.join(", ")
}

/// One text where all are alike.
fn alike(locks: &[&LockMechanics], number: impl Fn(&LockMechanics) -> usize) -> String {
    let mut numbers: Vec<_> = locks.iter().map(|lock| number(lock)).collect();
    let all: Vec<_> = numbers.iter().map(ToString::to_string).collect();
    numbers.dedup();
    match numbers[..] {
        [only] => only.to_string(),
        _ => all.join(", "),
    }
}

fn counts(locks: &[&LockMechanics], side: impl Fn(&LockMechanics) -> &Redundancy) -> String {
    alike(locks, |lock| side(lock).free())
}

fn ranks(locks: &[&LockMechanics], side: impl Fn(&LockMechanics) -> &Redundancy) -> String {
    alike(locks, |lock| side(lock).rank)
}
