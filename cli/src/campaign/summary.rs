//! [`Summary`]: a campaign joint by joint, for the console, for `campaign.md` and for `campaign-summary.json`.

use serde::Serialize;
use ulna_study::Scenario;

use super::row::{CampaignLaw, LAWS, Quantity, Row};
use crate::numbers::significant;

/// By so much, relative, an impact must grow before it counts as made worse: less is rounding.
const WORSE: f64 = 1e-9;
/// An impact below this, N m (N), is none: no ratio is taken to it.
const NONE: f64 = 1e-9;

/// A campaign: all joints, and each.
#[derive(Serialize)]
pub(super) struct Summary<'s> {
    scenario: &'s str,
    arm: &'s str,
    seed: u64,
    cases: usize,
    /// Of the cases that have an outcome; the others' `status` in `campaign.csv` says why not.
    outcomes: usize,
    /// The components of the task; an arm with as many joints has no null space.
    task: usize,
    all: JointSummary,
    joints: Vec<JointSummary>,
}

/// The cases in which one joint locks, or all.
#[derive(Serialize)]
struct JointSummary {
    /// Counted from 1; `null` for all joints together.
    failed_joint: Option<usize>,
    outcomes: usize,
    /// The impact without compensation, N m (N).
    before: Spread,
    /// The norm of the tool force that is asked for, N.
    asked_force: Spread,
    laws: Vec<LawSummary>,
}

/// What a law does to these cases.
#[derive(Serialize)]
struct LawSummary {
    law: &'static str,
    /// What it leaves, N m (N).
    impact: Spread,
    /// What it leaves over what there was; of the cases that have an impact.
    ratio: Spread,
    /// The share of the cases with an outcome in which it leaves more than there was, as a norm.
    made_worse: Option<f64>,
    /// The share of them in which at least one healthy joint bears more than without it.
    a_joint_made_worse: Option<f64>,
    /// N.
    force_error_at_lock: Spread,
    /// At worst over the motion, N.
    max_force_error: Spread,
}

/// `null` where there is no case.
#[derive(Clone, Copy, Serialize)]
struct Spread {
    median: Option<f64>,
    worst: Option<f64>,
}

impl Spread {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<_> = values.collect();
        Self {
            worst: values.iter().copied().reduce(f64::max),
            median: median(values),
        }
    }

    /// "median (worst)".
    fn text(&self) -> String {
        let [median, worst] = [self.median, self.worst].map(|x| x.map(significant));
        match (median, worst) {
            (Some(median), Some(worst)) => format!("{median} ({worst})"),
            _ => "none".to_owned(),
        }
    }
}

/// The middle of the values, or of the two middle ones.
pub(crate) fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = values.get(values.len() / 2)?;
    let lower = values.get(values.len().saturating_sub(1) / 2)?;
    Some(0.5 * (upper + lower))
}

impl<'s> Summary<'s> {
    /// Of the `rows` of the campaign of `scenario`.
    pub(super) fn new(scenario: &'s Scenario, rows: &[Row], task: usize) -> Self {
        let joints = 1..=scenario.arm().joints().len();
        let of_joint = |joint: usize| {
            let rows = rows.iter().filter(move |row| row.failed_joint == joint);
            JointSummary::of(Some(joint), &rows.collect::<Vec<_>>())
        };
        Self {
            scenario: scenario.name(),
            arm: scenario.arm().name(),
            seed: scenario.campaign().seed(),
            cases: rows.len(),
            outcomes: rows.iter().filter(|row| row.before.is_some()).count(),
            task,
            all: JointSummary::of(None, &rows.iter().collect::<Vec<_>>()),
            joints: joints.map(of_joint).collect(),
        }
    }

    fn heading(&self) -> String {
        let without = match self.cases - self.outcomes {
            0 => String::new(),
            count => format!(", {count} without (the column `status` says why)"),
        };
        format!(
            "{}: arm {}, {} cases, {} with an outcome{without}; seed {}",
            self.scenario, self.arm, self.cases, self.outcomes, self.seed
        )
    }

    /// Medians, a line for each joint.
    pub(super) fn console(&self) -> String {
        let columns = |head: &str, cells: &[String]| {
            let cells: Vec<_> = cells.iter().map(|cell| format!("{cell:>12}")).collect();
            format!("{head:>6} {}", cells.join(" "))
        };
        let mut lines = vec![
            self.heading(),
            "medians: impact, norm over the healthy joints, N m; force error of Eq. 16 at the lock and at worst, of what is asked, N"
                .to_owned(),
        ];
        let titles = LAWS.iter().map(|law| law.title);
        let titles = ["before"]
            .into_iter()
            .chain(titles)
            .chain(["at lock", "at worst", "asked"]);
        let titles: Vec<_> = titles.map(str::to_owned).collect();
        lines.push(columns("joint", &titles));
        let text = |value: Option<f64>| value.map_or_else(String::new, significant);
        for joint in self.joints.iter().chain([&self.all]) {
            let head = joint.head();
            let impacts = joint.laws.iter().map(|law| law.impact.median);
            // Of Eq. 16, the first.
            let eq16 = joint.laws.first();
            let cells = [joint.before.median].into_iter().chain(impacts).chain([
                eq16.and_then(|law| law.force_error_at_lock.median),
                eq16.and_then(|law| law.max_force_error.median),
                joint.asked_force.median,
            ]);
            lines.push(columns(&head, &cells.map(text).collect::<Vec<_>>()));
        }
        lines.join("\n")
    }

    /// `campaign.md`.
    pub(super) fn page(&self) -> String {
        let mut page = format!(
            "# {} as a campaign\n\n{}.\n\n\
             Every joint locks in turn, at evenly spread times, in motions from random starts to random goals under random forces. \
             The impact is the norm of the torque step over the healthy joints, N·m (N); a force error is the norm of h of Eq. 13, N. \
             Coefficients and torques are made for the lock that they are judged on: that joint, at that time, in that motion.\n\n",
            self.scenario,
            self.heading()
        );
        page += &self.room();
        for law in LAWS.iter().enumerate() {
            page += &self.sentence(law);
        }
        page += "\nMedian (worst) of the cases in which the joint locks:\n\n";
        page += "| joint | law | before | after | after / before | norm made worse, % | a joint made worse, % | force error at the lock, N | at worst over the motion, N | force asked, N |\n\
                 |---|---|---|---|---|---|---|---|---|---|\n";
        for joint in self.joints.iter().chain([&self.all]) {
            for law in &joint.laws {
                page += &format!(
                    "| {} | `{}` | {} | {} | {} | {} | {} | {} | {} | {} |\n",
                    joint.head(),
                    law.law,
                    joint.before.text(),
                    law.impact.text(),
                    law.ratio.text(),
                    law.made_worse.map_or_else(String::new, percent),
                    law.a_joint_made_worse.map_or_else(String::new, percent),
                    law.force_error_at_lock.text(),
                    law.max_force_error.text(),
                    joint.asked_force.text(),
                );
            }
        }
        page += "\n`optimal` is the least that keeps the tool force before and after the lock. \
                 `after_only` does nothing before the lock and takes away after it what it can without a force at the tool.\n\n\
                 ![Medians over joint and failure time](figures/campaign.svg)\n\n\
                 *Medians over joint and failure time: impacts, and the force error of Eq. 16.*\n\n\
                 The cases are in `campaign.csv`, the numbers of this page in `campaign-summary.json`; \
                 `campaign.json` is the record by which an interrupted campaign goes on.\n";
        page
    }

    /// That nothing can be done, or only before the lock, where the task takes all joints.
    fn room(&self) -> String {
        let (joints, task) = (self.joints.len(), self.task);
        if joints <= task {
            format!(
                "**This arm has no joint to spare:** {joints} joints, and a task of {task} components. No torque leaves the tool force alone \
                 but in poses that are singular for the task, and the laws below change nothing elsewhere.\n\n"
            )
        } else if joints == task + 1 {
            format!(
                "**With a joint locked this arm has none to spare:** {joints} joints, and a task of {task} components. \
                 The laws below can act before the lock only.\n\n"
            )
        } else {
            String::new()
        }
    }

    /// What a law does over all cases.
    fn sentence(&self, (index, law): (usize, &CampaignLaw)) -> String {
        let all = &self.all.laws[index];
        let (Some(median), Some(worst)) = (all.ratio.median, all.ratio.worst) else {
            return String::new();
        };
        let [worse, a_joint] = [all.made_worse, all.a_joint_made_worse];
        let [worse, a_joint] =
            [worse, a_joint].map(|share| share.map_or_else(String::new, percent));
        let force = format!(
            " Its force error is {} N at the lock and {} N at worst over the motion (median and, in brackets, worst), of {} N asked.",
            all.force_error_at_lock.text(),
            all.max_force_error.text(),
            self.all.asked_force.text()
        );
        format!(
            "- {} leaves {} % of the impact in the median and {} % at worst; it makes {worse} % of the cases worse, and a healthy joint in {a_joint} % of them.{force}\n",
            law.title,
            significant(100.0 * median),
            significant(100.0 * worst),
        )
    }
}

fn percent(share: f64) -> String {
    format!("{:.1}", 100.0 * share)
}

impl JointSummary {
    fn of(failed_joint: Option<usize>, rows: &[&Row]) -> Self {
        let spread = |quantity: Quantity| Spread::of(rows.iter().filter_map(|row| quantity(row)));
        let law = |law: &CampaignLaw| {
            let pairs = || {
                let rows = rows.iter();
                rows.filter_map(|row| Some((row.before?, (law.impact)(row)?)))
            };
            let ratios = pairs().filter(|(before, _)| *before > NONE);
            let worse = pairs().filter(|(before, after)| *after > before * (1.0 + WORSE) + NONE);
            let count = pairs().count();
            let share = |cases: usize| (count > 0).then(|| cases as f64 / count as f64);
            let joints = rows.iter().filter_map(|row| (law.worse)(row));
            LawSummary {
                law: law.key,
                impact: spread(law.impact),
                ratio: Spread::of(ratios.map(|(before, after)| after / before)),
                made_worse: share(worse.count()),
                a_joint_made_worse: share(joints.filter(|joints| *joints > 0).count()),
                force_error_at_lock: spread(law.force.0),
                max_force_error: spread(law.force.1),
            }
        };
        Self {
            failed_joint,
            outcomes: rows.iter().filter(|row| row.before.is_some()).count(),
            before: spread(|row| row.before),
            asked_force: spread(|row| row.asked_force),
            laws: LAWS.iter().map(law).collect(),
        }
    }

    fn head(&self) -> String {
        self.failed_joint
            .map_or_else(|| "all".to_owned(), |joint| joint.to_string())
    }
}
