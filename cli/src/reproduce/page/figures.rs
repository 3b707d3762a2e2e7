//! The figures on the page, and what they show.

use std::fmt::{self, Write};

use ulna_study::Scenario;
use ulna_study::scenario::{Experiment, FigureKind};

use crate::reproduce::Findings;
use crate::reproduce::drawings::{HEALTHY_ARM, LOCKED_ARM, SEARCH, drawn_lock, frontier_name};
use crate::reproduce::words::joints_named;

/// A figure with its caption below it.
fn figure(page: &mut String, name: &str, caption: &str) -> fmt::Result {
    writeln!(page, "![{caption}](figures/{name}.svg)\n\n*{caption}.*\n")
}

/// The arm and the search: the paper's Figures 1 to 3.
pub(super) fn arm(page: &mut String, scenario: &Scenario, findings: &Findings) -> fmt::Result {
    // Of the paper nothing is said where nothing stands beside it.
    let beside = scenario
        .experiments()
        .iter()
        .any(|experiment| !experiment.references().is_empty());
    let number = |number: u32| {
        if beside {
            format!(" (as the paper's Figure {number})")
        } else {
            String::new()
        }
    };
    if let Some(lock) = drawn_lock(findings) {
        let time = lock.failure_time;
        let healthy = format!(
            "The arm in its planned motion: start, pose at {time} s, goal{}",
            number(1)
        );
        figure(page, HEALTHY_ARM, &healthy)?;
        let locked = format!(
            "The same with {} locked at {time} s and the other joints on their plan{}",
            joints_named(scenario.failed_joints()),
            number(3)
        );
        figure(page, LOCKED_ARM, &locked)?;
    }
    let search = format!("The search for coefficients in steps{}", number(2));
    figure(page, SEARCH, &search)
}

/// Those that an experiment asks for, and its frontier.
pub(super) fn of_experiment(page: &mut String, experiment: &Experiment) -> fmt::Result {
    for drawn in experiment.figures() {
        let caption = match drawn.kind() {
            FigureKind::Torque { joints, time } => {
                format!(
                    "Torques of {} with the lock at {time} s, without and with suppression; on the right the half second before and after it",
                    joints_named(joints)
                )
            }
            FigureKind::Impact => {
                "Impact joint by joint; a 0 stands for less than 1e-9 of the largest".to_owned()
            }
        };
        figure(page, drawn.name(), &caption)?;
    }
    let caption = "What force error at the lock buys: the least impact that any compensation leaves, and the three laws";
    figure(page, &frontier_name(experiment), caption)
}
