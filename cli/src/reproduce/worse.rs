//! Which joints a compensation makes worse, and whether any other could spare them: a norm is not printed without it.

use std::io::{self, Write};

use ulna::Law;
use ulna_study::experiment::{Case, Lowerable, SearchMethod, Study};
use ulna_study::search::WorseJoint;

use super::words::{joints_named, significant};

/// On the console: [`lines`].
pub(super) fn write(
    study: &Study,
    methods: &[(SearchMethod, &str)],
    out: &mut dyn Write,
) -> io::Result<()> {
    lines(study, methods)
        .iter()
        .try_for_each(|line| writeln!(out, " {line}"))
}

/// A line for each of `methods`, with the certificate's margin beside those that keep the tool force; below them what it says,
/// and what any law could do that keeps the tool force.
pub(super) fn lines(study: &Study, methods: &[(SearchMethod, &str)]) -> Vec<String> {
    let proof = match &study.force_kept.all {
        Ok(Lowerable::None { joints, margin, .. }) => Some((joints, significant(*margin))),
        _ => None,
    };
    let mut lines = Vec::new();
    for (method, title) in methods {
        let case = study.case(*method);
        if case.search.is_err() {
            continue;
        }
        let beside = match &proof {
            Some((_, margin)) if keeps_force(*method) => {
                format!("; certificate {margin} N m per N")
            }
            _ => String::new(),
        };
        lines.push(format!("{title}: {}{beside}", line(case)));
    }
    if let Some((joints, margin)) = &proof {
        lines.push(format!(
            "certificate: no law that keeps the tool force lowers {} all at once; a wrench that loads each with {margin} N m per N proves it",
            joints_named(joints)
        ));
    }
    lines.extend(limit(study));
    lines
}

/// Whether a method's law keeps the static tool force.
pub(super) fn keeps_force(method: SearchMethod) -> bool {
    matches!(method.law(), Law::Projected | Law::Optimal)
}

/// The margin of the proof that no law which keeps the tool force lowers every joint, N·m per N, if there is one.
pub(super) fn margin(study: &Study) -> Option<f64> {
    match &study.force_kept.all {
        Ok(Lowerable::None { margin, .. }) => Some(*margin),
        _ => None,
    }
}

/// "worse off: joint 4 at 2.50 times its step", or that no joint is.
pub(super) fn line(case: &Case) -> String {
    let worse = case.worse_joints();
    let joint = |worse: &WorseJoint| {
        let name = worse.joint + 1;
        if worse.ratio.is_finite() {
            format!("joint {name} at {}", times(worse.ratio))
        } else {
            // It has no step of its own.
            format!(
                "joint {name} at {} N m instead of none",
                significant(worse.after)
            )
        }
    };
    let joints: Vec<_> = worse.iter().map(joint).collect();
    if joints.is_empty() {
        "no healthy joint is worse off".to_owned()
    } else {
        format!("worse off: {}", joints.join(", "))
    }
}

/// What the tool force, kept, leaves if nobody is to be worse off.
fn limit(study: &Study) -> Option<String> {
    let kept = &study.force_kept;
    let healthy = kept.no_healthy_joint_worse.as_ref().ok()?;
    let all = kept.no_joint_worse.as_ref().ok()?;
    let (before, _) = study.case(SearchMethod::Optimal).healthy_impact();
    let ratio = match &kept.healthy {
        Ok(Lowerable::All { worst_ratio }) => format!(
            ", or each of them at {:.1} % of its step at most",
            100.0 * worst_ratio
        ),
        _ => String::new(),
    };
    Some(format!(
        "tool force kept and no healthy joint worse off: {} of {} N m{ratio}; the locked joints no worse off either: {} N m",
        significant(*healthy),
        significant(before),
        significant(*all)
    ))
}

/// "2.50 times its step"; never 1.00.
fn times(ratio: f64) -> String {
    let decimals = match ratio {
        ..1.0001 => 6,
        ..1.01 => 4,
        ..10.0 => 2,
        _ => 1,
    };
    format!("{ratio:.decimals$} times its step")
}
