//! The sweep over gains and rotors: its table, its CSV files, its figure.

use comfy_table::Table;
use serde::Serialize;
use ulna_study::experiment::{LockVerdict, SearchMethod, SimulatedLock, Sweep, Verdict};

use ulna_study::Scenario;

use super::Findings;
use super::drawings::footer;
use super::words::significant;
use crate::columns::plain;
use crate::figures::{self, FeltSteps};
use crate::output::Files;
use crate::rows::file;
use crate::setting::{Setting, ascii, inertia, short};

/// The files of the figure.
pub(super) const FIGURE: &str = "felt-steps";

/// The columns of tables, besides none.
pub(super) const METHODS: [(SearchMethod, &str); 3] = [
    (SearchMethod::PerJoint, "Eq. 16"),
    (SearchMethod::Projected, "Eq. 20"),
    (SearchMethod::Optimal, "optimal"),
];

/// What tables call a method.
fn title(method: SearchMethod) -> &'static str {
    let mut titles = METHODS.into_iter();
    let found = titles.find(|(known, _)| *known == method);
    found.map_or_else(|| method.name(), |(_, title)| title)
}

/// A law as a sentence has it.
pub(super) fn law(method: SearchMethod) -> &'static str {
    match method {
        SearchMethod::Optimal => "the optimal law",
        method => title(method),
    }
}

/// The verdicts with the scenario's rotors or with its gain: what tables show. The others are in the CSV files.
pub(super) fn shown(sweeps: &[Sweep]) -> Vec<Verdict> {
    let mut verdicts = Verdict::of(sweeps);
    if let Some(sweep) = sweeps.first() {
        verdicts
            .retain(|verdict| verdict.rotors == sweep.own_rotors || verdict.gain == sweep.own_gain);
    }
    verdicts
}

/// What the lock's best compensation does, such as "Eq. 16, -12 %"; "none" where no compensation lowers the step.
pub(super) fn outcome(lock: &LockVerdict) -> String {
    match (lock.helps(), lock.best()) {
        (Some((method, ratio)), _) => {
            format!("{}, -{:.0} %", title(method), 100.0 * (1.0 - ratio))
        }
        (None, Some(_)) => "none".to_owned(),
        (None, None) => String::new(),
    }
}

/// A row for each gain, rotors and lock.
pub(super) fn table(sweeps: &[Sweep]) -> String {
    let mut table = Table::new();
    let mut header = ["at", "gain, rad/s", "rotors, kg m^2", "none"]
        .map(str::to_owned)
        .to_vec();
    header.extend(METHODS.map(|(_, title)| title.to_owned()));
    header.push("lowered by".to_owned());
    table.set_header(header);
    let step = |step: Option<f64>| step.map_or_else(|| "-".to_owned(), significant);
    let verdicts = shown(sweeps);
    for (i, sweep) in sweeps.iter().enumerate() {
        for verdict in &verdicts {
            let Some(lock) = verdict.locks.get(i) else {
                continue;
            };
            let with = METHODS.map(|(method, _)| {
                let with = lock.with.iter().find(|(known, _)| *known == method);
                step(with.and_then(|(_, with)| *with))
            });
            let mut row = vec![
                format!("{} s", sweep.failure_time),
                verdict.gain.to_string(),
                short(&verdict.rotors),
                step(lock.without),
            ];
            row.extend(with);
            row.push(outcome(lock));
            table.add_row(row);
        }
    }
    plain(table, &[4 + METHODS.len()])
}

/// What stands above the table.
pub(super) fn heading(sweeps: &[Sweep]) -> String {
    let setting = sweeps.first().map(Setting::own);
    let setting = setting.map_or_else(String::new, |setting| setting.with_brake());
    ascii(&format!(
        "what the structure feels of the lock: step that the healthy joints transmit, norm in N m (this scenario: {setting})"
    ))
}

/// What the simulated locks are driven by, in brackets; empty without any.
pub(super) fn drives(simulations: &[SimulatedLock]) -> String {
    let setting = simulations.first().map(Setting::of);
    setting.map_or_else(String::new, |setting| {
        ascii(&format!(" ({})", setting.drives()))
    })
}

/// A simulated lock.
#[derive(Default, Serialize)]
struct Point<'s> {
    section: &'s str,
    failure_time: f64,
    brake_time: f64,
    detection: f64,
    cycle: f64,
    lead: f64,
    gain: f64,
    /// Of every joint, or a list.
    reflected_inertia: String,
    method: &'static str,
    predicted_step: Option<f64>,
    step: Option<f64>,
    peak_torque: Option<f64>,
}

fn points(sweeps: &[Sweep]) -> anyhow::Result<String> {
    file(sweeps.iter().flat_map(|sweep| {
        sweep.points.iter().map(move |point| Point {
            section: &sweep.section,
            failure_time: sweep.failure_time,
            brake_time: sweep.brake_time,
            detection: sweep.detection,
            cycle: sweep.cycle,
            lead: sweep.lead,
            gain: point.gain,
            reflected_inertia: inertia(&point.rotors),
            method: point.method.map_or("none", SearchMethod::name),
            predicted_step: point.felt.map(|felt| felt.predicted_step),
            step: point.felt.map(|felt| felt.step),
            peak_torque: point.felt.map(|felt| felt.peak),
        })
    }))
}

/// A gain, rotors and a lock.
#[derive(Default, Serialize)]
struct Row {
    gain: f64,
    reflected_inertia: String,
    own: bool,
    failure_time: f64,
    step_without: Option<f64>,
    best: &'static str,
    best_relative: Option<f64>,
    lowered: bool,
}

fn verdicts(sweeps: &[Sweep]) -> anyhow::Result<String> {
    let verdicts = Verdict::of(sweeps);
    file(verdicts.iter().flat_map(|verdict| {
        verdict.locks.iter().map(move |lock| {
            let best = lock.best();
            Row {
                gain: verdict.gain,
                reflected_inertia: inertia(&verdict.rotors),
                own: verdict.own,
                failure_time: lock.failure_time,
                step_without: lock.without,
                best: best.map_or("", |(method, _)| method.name()),
                best_relative: best.map(|(_, ratio)| ratio),
                lowered: lock.helps().is_some(),
            }
        })
    }))
}

/// The CSV files and the figure.
pub(super) fn add(
    files: &mut Files,
    scenario: &Scenario,
    findings: &Findings,
) -> anyhow::Result<()> {
    let Ok(sweeps) = &findings.sweeps else {
        return Ok(());
    };
    files.add("sweep.csv", points(sweeps)?);
    files.add("verdict.csv", verdicts(sweeps)?);
    let figure = FeltSteps::new(sweeps);
    let footer = footer(scenario, sweeps.first().map(|sweep| sweep.section.as_str()));
    files.add(
        format!("figures/{FIGURE}.svg"),
        figures::svg(&figure, &footer)?,
    );
    files.add(
        format!("figures/{FIGURE}.png"),
        figures::png(&figure, &footer)?,
    );
    Ok(())
}
