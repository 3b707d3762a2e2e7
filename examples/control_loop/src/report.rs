//! What a run comes to: the table, the CSV file, the plots.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::svg::{Line, Plot};
use crate::{BRAKE, DETECTION, LOCK, Run, Sample};

/// The healthy joints' torque step, N m, in the cycle in which the lock is told: the norm, and the largest entry.
fn step(samples: &[Sample]) -> (f64, f64) {
    let told = samples
        .windows(2)
        .find(|pair| !pair[1].cycle.newly_locked.is_empty());
    told.map_or((0.0, 0.0), |pair| {
        let step = pair[1].torque - pair[0].torque;
        (step.norm(), step.amax())
    })
}

/// The largest of what `of` says of the samples.
fn largest(samples: &[Sample], of: impl Fn(&Sample) -> f64) -> f64 {
    samples.iter().map(of).fold(0.0, f64::max)
}

/// A row for each run.
pub fn table(runs: &[Run]) -> String {
    let mut text = format!(
        "{:22} {:>9} {:>9} {:>12} {:>8} {:>9}\n",
        "suppression", "step, N m", "peak, N m", "force err, N", "U, N m", "off, mrad"
    );
    for run in runs {
        let samples = &run.samples;
        let (norm, peak) = step(samples);
        let _ = writeln!(
            text,
            "{:22} {norm:9.3} {peak:9.3} {:12.3} {:8.3} {:9.2}",
            run.name,
            largest(samples, |sample| sample.cycle.control.force_error.norm()),
            largest(samples, |sample| sample.cycle.control.compensation.amax()),
            1e3 * largest(samples, |sample| sample.off_plan),
        );
    }
    text
}

/// `control_loop.csv`, and a plot for each question.
pub fn write(runs: &[Run], folder: &Path) -> std::io::Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("control_loop.csv"), csv(runs))?;
    let colors = ["#888888", "#1f77b4", "#2ca02c", "#ff7f0e", "#d62728"];
    let lines = |from: f64, to: f64, of: &dyn Fn(&Sample) -> f64| -> Vec<Line> {
        runs.iter()
            .zip(colors)
            .map(|(run, color)| Line {
                name: run.name.to_owned(),
                color,
                points: run
                    .samples
                    .iter()
                    .filter(|sample| (from..to).contains(&sample.time))
                    .map(|sample| (sample.time, of(sample)))
                    .collect(),
            })
            .collect()
    };
    let told = LOCK + BRAKE + DETECTION;
    let plot = |file: &str, title: &str, unit: &str, lines: Vec<Line>| {
        let plot = Plot {
            title: title.to_owned(),
            across: "time, s".to_owned(),
            up: unit.to_owned(),
            marks: vec![LOCK, told],
            lines,
        };
        fs::write(folder.join(file), plot.svg())
    };
    for joint in [1, 3] {
        plot(
            &format!("torque_joint_{}.svg", joint + 1),
            &format!(
                "Torque of joint {}; joint 3 is braked, and the lock is told",
                joint + 1
            ),
            "torque, N m",
            lines(LOCK - 0.03, told + 0.05, &|sample| sample.torque[joint]),
        )?;
    }
    plot(
        "compensation.svg",
        "Compensation U, over all joints",
        "|U|, N m",
        lines(0.0, f64::INFINITY, &|sample| {
            sample.cycle.control.compensation.norm()
        }),
    )?;
    plot(
        "off_plan.svg",
        "Healthy joints off their plan, at most",
        "mrad",
        lines(0.0, f64::INFINITY, &|sample| 1e3 * sample.off_plan),
    )
}

fn csv(runs: &[Run]) -> String {
    let mut text = "suppression,time".to_owned();
    for name in ["torque", "compensation"] {
        for joint in 1..=7 {
            let _ = write!(text, ",{name}_{joint}");
        }
    }
    text.push_str(",force_error,ramp,off_plan,status\n");
    for run in runs {
        for sample in &run.samples {
            let control = &sample.cycle.control;
            let _ = write!(text, "\"{}\",{:.3}", run.name, sample.time);
            for value in sample.torque.iter().chain(&control.compensation) {
                let _ = write!(text, ",{value:.6}");
            }
            let _ = writeln!(
                text,
                ",{:.6},{:.6},{:.9},{:?}",
                control.force_error.norm(),
                sample.cycle.ramp,
                sample.off_plan,
                control.status
            );
        }
    }
    text
}
