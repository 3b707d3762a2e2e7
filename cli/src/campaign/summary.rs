//! [`Summary`]: a campaign joint by joint, for the console, for `campaign.md` and for `campaign-summary.json`.

use serde::Serialize;
use ulna_campaign::{CaseCells, LawCells, Row};
use ulna_study::{LawName, LawSet, Scenario};

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
    #[serde(skip)]
    laws: LawSet,
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
    /// Its name.
    law: &'static str,
    /// Of the cases in which the limits leave it something.
    outcomes: usize,
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
        let laws = scenario.campaign().laws();
        let of_joint = |joint: usize| {
            let rows = rows.iter();
            let rows = rows.filter(move |row| row.case.failed_joint == joint);
            JointSummary::of(Some(joint), laws, &rows.collect::<Vec<_>>())
        };
        Self {
            scenario: scenario.name(),
            arm: scenario.arm().name(),
            seed: scenario.campaign().seed(),
            cases: rows.len(),
            outcomes: rows.iter().filter(|row| row.case.before.is_some()).count(),
            task,
            all: JointSummary::of(None, laws, &rows.iter().collect::<Vec<_>>()),
            joints: joints.map(of_joint).collect(),
            laws,
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

    /// Medians, a line for each joint: the impacts, and the force errors of the laws that bend the tool force.
    pub(super) fn console(&self) -> String {
        let names = self.laws.iter().map(|law| law.name().to_owned());
        let titles: Vec<_> = std::iter::once("before".to_owned()).chain(names).collect();
        let impacts = |joint: &JointSummary| {
            let after = joint.laws.iter().map(|law| law.impact.median);
            std::iter::once(joint.before.median).chain(after).collect()
        };
        let mut parts = vec![
            self.heading(),
            "median impact, norm over the healthy joints, N m".to_owned(),
            self.lines(&titles, impacts),
        ];
        let bending: Vec<_> = self.laws.iter().filter(|law| law.bends_force()).collect();
        if !bending.is_empty() {
            let titles = bending
                .iter()
                .flat_map(|law| [format!("{law} at lock"), "at worst".to_owned()]);
            let titles: Vec<_> = std::iter::once("asked".to_owned()).chain(titles).collect();
            let forces = |joint: &JointSummary| {
                let laws = joint.laws.iter();
                let laws = laws.filter(|law| bending.iter().any(|name| name.name() == law.law));
                let errors = laws
                    .flat_map(|law| [law.force_error_at_lock.median, law.max_force_error.median]);
                std::iter::once(joint.asked_force.median)
                    .chain(errors)
                    .collect()
            };
            parts.push(
                "\nmedian force error at the lock and at worst, and what is asked, N".to_owned(),
            );
            parts.push(self.lines(&titles, forces));
        }
        parts.join("\n")
    }

    /// A head, and a line for each joint and for all.
    fn lines(
        &self,
        titles: &[String],
        values: impl Fn(&JointSummary) -> Vec<Option<f64>>,
    ) -> String {
        let widths: Vec<_> = titles.iter().map(|title| title.len().max(10)).collect();
        let line = |head: &str, cells: &[String]| {
            let cells = cells.iter().zip(&widths);
            let cells = cells.map(|(cell, width)| format!(" {cell:>width$}"));
            format!("{head:>6}{}", cells.collect::<String>())
        };
        let text = |value: Option<f64>| value.map_or_else(String::new, significant);
        let rows = self.joints.iter().chain([&self.all]);
        let rows = rows.map(|joint| {
            let cells: Vec<_> = values(joint).into_iter().map(text).collect();
            line(&joint.head(), &cells)
        });
        let rows: Vec<_> = std::iter::once(line("joint", titles)).chain(rows).collect();
        rows.join("\n")
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
        for (law, all) in self.laws.iter().zip(&self.all.laws) {
            page += &self.sentence(law, all);
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
        page += "\nThe laws:\n\n";
        for law in self.laws.iter() {
            page += &format!("- `{law}`: {}.\n", law.meaning());
        }
        let bending = self.laws.iter().filter(|law| law.bends_force());
        let bending: Vec<_> = bending.map(LawName::title).collect();
        let forces = match &bending[..] {
            [] => String::new(),
            titles => format!(", and the force errors of {}", titles.join(" and ")),
        };
        page += &format!(
            "\n![Medians over joint and failure time](figures/campaign.svg)\n\n\
             *Medians over joint and failure time: impacts{forces}.*\n\n\
             The cases are in `campaign.csv`, the numbers of this page in `campaign-summary.json`; \
             `campaign.json` is the record by which an interrupted campaign goes on.\n"
        );
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
    fn sentence(&self, law: LawName, all: &LawSummary) -> String {
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
        let without = match self.outcomes - all.outcomes {
            0 => String::new(),
            count => format!(
                " In {count} cases the rated torques leave it nothing, and it is not counted."
            ),
        };
        format!(
            "- `{law}` leaves {} % of the impact in the median and {} % at worst; it makes {worse} % of the cases worse, and a healthy joint in {a_joint} % of them.{force}{without}\n",
            significant(100.0 * median),
            significant(100.0 * worst),
        )
    }
}

fn percent(share: f64) -> String {
    format!("{:.1}", 100.0 * share)
}

impl JointSummary {
    fn of(failed_joint: Option<usize>, laws: LawSet, rows: &[&Row]) -> Self {
        let spread = |quantity: fn(&CaseCells) -> Option<f64>| {
            Spread::of(rows.iter().filter_map(|row| quantity(&row.case)))
        };
        let laws = laws.iter().enumerate();
        Self {
            failed_joint,
            outcomes: rows.iter().filter(|row| row.case.before.is_some()).count(),
            before: spread(|case| case.before),
            asked_force: spread(|case| case.asked_force),
            laws: laws
                .map(|(index, law)| LawSummary::of(law, index, rows))
                .collect(),
        }
    }

    fn head(&self) -> String {
        self.failed_joint
            .map_or_else(|| "all".to_owned(), |joint| joint.to_string())
    }
}

impl LawSummary {
    /// Of the law whose cells are the `index`-th.
    fn of(law: LawName, index: usize, rows: &[&Row]) -> Self {
        let cells = || rows.iter().filter_map(|row| row.laws.get(index));
        let spread =
            |quantity: fn(&LawCells) -> Option<f64>| Spread::of(cells().filter_map(quantity));
        let pairs = || {
            let rows = rows.iter();
            rows.filter_map(|row| Some((row.case.before?, row.laws.get(index)?.impact?)))
        };
        let ratios = pairs().filter(|(before, _)| *before > NONE);
        let worse = pairs().filter(|(before, after)| *after > before * (1.0 + WORSE) + NONE);
        let outcomes = pairs().count();
        let share = |cases: usize| (outcomes > 0).then(|| cases as f64 / outcomes as f64);
        let joints = cells().filter_map(|cells| cells.worse_joints);
        Self {
            law: law.name(),
            outcomes,
            impact: spread(|cells| cells.impact),
            ratio: Spread::of(ratios.map(|(before, after)| after / before)),
            made_worse: share(worse.count()),
            a_joint_made_worse: share(joints.filter(|joints| *joints > 0).count()),
            force_error_at_lock: spread(|cells| cells.force_error),
            max_force_error: spread(|cells| cells.max_force_error),
        }
    }
}
