//! [`ScenarioTable`] → [`Scenario`]: numbers of joints, units, bounds. The last stage that can fail on what the file says.

mod assess;
mod campaign;
mod drives;
mod experiment;
mod failure;
mod laws;
mod motion;

use super::arm::ScenarioArm;
use super::format::bounds::{DURATION, MAX_CYCLES, MAX_STUDIES};
use super::format::{self, DEFAULT_BRAKE};
use super::read::{
    ExperimentTable, FailureTable, List, MotionTable, Number, Numbers, ScenarioTable, SearchTable,
};
use super::{BrakeSettings, Scenario, SearchGrid};
use ulna::Joint;
use ulna_table::AngleUnit;
use ulna_table::diagnostics::{Diagnostic, Sink};
use ulna_table::toml_reader::{Key, Located};

/// What the lists of a scenario are checked against.
struct Reader<'s> {
    sink: &'s Sink,
    /// How many joints the arm has; `None` as long as it is not known.
    joint_count: Option<usize>,
    joints: Option<&'s [Joint]>,
    arm: Option<&'s ScenarioArm>,
    unit: Option<AngleUnit>,
}

impl ScenarioTable {
    /// The scenario. `arm` is `None` if it has been reported, as is everything else that is wrong.
    pub(super) fn into_scenario(self, arm: Option<ScenarioArm>, sink: &Sink) -> Option<Scenario> {
        let reader = Reader {
            sink,
            joint_count: match &arm {
                Some(arm) => Some(arm.joints().len()),
                None => self.motion.as_ref().and_then(MotionTable::joint_count),
            },
            joints: arm.as_ref().map(ScenarioArm::joints),
            arm: arm.as_ref(),
            unit: self.angle_unit,
        };
        let motion = self.motion.as_ref().and_then(|table| reader.motion(table));
        let written = self.motion.as_ref();
        let duration = written
            .and_then(|table| table.duration.as_ref())
            .map(|duration| duration.value);
        let duration = duration.filter(|duration| DURATION.range.contains(duration));
        let failure = self.failure.as_ref();
        let failure = failure.and_then(|table| reader.failure(table, duration));
        let cycle = reader.cycle(&self.cycle, duration);
        let search = self.search.as_ref().and_then(|table| reader.search(table));
        let experiments = self
            .experiments
            .as_ref()
            .and_then(|tables| reader.experiments(tables, failure.as_ref(), duration));
        let studies = reader.studies(self.failure.as_ref(), self.experiments.as_deref());
        let brake = match &self.brake.duration {
            Some(_) => reader.bounded(&self.brake.duration, &format::BRAKE_DURATION),
            None => Some(DEFAULT_BRAKE),
        };
        let brake = brake.map(|duration| BrakeSettings {
            duration,
            profile: self.brake.profile.unwrap_or_default(),
        });
        let servo = reader.servo(&self.servo);
        let motors = reader.motors(&self.motors);
        let campaign = reader.campaign(&self.campaign);
        let assess = reader.assess(&self.assess);
        let failure = failure?;
        studies?;
        Some(Scenario {
            name: self.name?,
            description: self.description,
            motion: motion?,
            failed_joints: failure.joints,
            failure_times: failure.times,
            cycle: cycle?,
            search: search?,
            brake: brake?,
            servo: servo?,
            motors: motors?,
            experiments: experiments?,
            campaign: campaign?,
            assess: assess?,
            arm: arm?,
        })
    }
}

impl Reader<'_> {
    /// Joints counted from 1 in the text, from 0 in the result; each once.
    fn joint_numbers(&self, list: &Located<Numbers>) -> Option<Vec<usize>> {
        self.not_empty(list, "joints = [2]")?;
        let mut joints = Vec::new();
        let mut sound = true;
        for number in &list.value {
            let Some(number) = number else {
                sound = false;
                continue;
            };
            let most = self.joint_count.unwrap_or(usize::MAX);
            let joint = number.value as usize;
            let fault = if number.value.fract() != 0.0 || joint == 0 || joint > most {
                "is no joint of the arm"
            } else if joints.contains(&(joint - 1)) {
                "is there twice"
            } else {
                joints.push(joint - 1);
                continue;
            };
            sound = false;
            let help = match self.joint_count {
                Some(count) => format!("joints count from 1, at the base, to {count}"),
                None => "joints count from 1, at the base".to_owned(),
            };
            let message = format!("{} {fault}", number.name);
            self.refuse(&number.span, message, "", help);
        }
        sound.then_some(joints)
    }

    fn cycle(&self, cycle: &Number, duration: Option<f64>) -> Option<f64> {
        let value = self.bounded(cycle, &format::CYCLE)?;
        let cycle = cycle.as_ref()?;
        if duration.is_some_and(|duration| duration / value > MAX_CYCLES) {
            let message = format!(
                "{} cuts the motion into more than {MAX_CYCLES} cycles",
                cycle.name
            );
            let help = "write a longer cycle, or a shorter `duration` of [motion]";
            self.refuse(&cycle.span, message, "", help);
            return None;
        }
        Some(value)
    }

    /// Refuses more studies than fit into a run.
    fn studies(
        &self,
        failure: Option<&FailureTable>,
        experiments: Option<&[ExperimentTable]>,
    ) -> Option<()> {
        let times = failure?.times.as_ref()?;
        let (count, experiments) = (times.value.len(), experiments?.len());
        if count.saturating_mul(experiments) <= MAX_STUDIES {
            return Some(());
        }
        let message = format!(
            "{} has {count} for each of {experiments} experiments",
            times.name
        );
        let most = format!("times and experiments multiply to at most {MAX_STUDIES}");
        let help = "write fewer times or experiments, or several scenarios";
        self.refuse(&times.span, message, most, help);
        None
    }

    fn search(&self, table: &SearchTable) -> Option<SearchGrid> {
        let start = self.bounded(&table.start, &format::START);
        let step = self.bounded(&table.step, &format::STEP);
        Some(SearchGrid {
            start: start?,
            step: step?,
        })
    }

    /// A count from 1 to `most`, or what it is if it is not there.
    fn count(&self, number: &Option<Located<u64>>, default: u64, most: u64) -> Option<u64> {
        let Some(number) = number else {
            return Some(default);
        };
        if (1..=most).contains(&number.value) {
            return Some(number.value);
        }
        let message = format!("{} is out of bounds", number.name);
        let label = format!("must be within 1 to {most}");
        self.refuse(&number.span, message, label, "write a count");
        None
    }

    /// A number within its bounds, or what it is if it is not there.
    fn number_or(&self, number: &Number, default: f64, key: &Key) -> Option<f64> {
        match number {
            Some(_) => self.bounded(number, key),
            None => Some(default),
        }
    }

    fn bounded(&self, number: &Number, key: &Key) -> Option<f64> {
        key.admit(number.as_ref()?, self.sink)
    }

    fn for_each_joint<'l>(&self, list: &'l List) -> Option<&'l Numbers> {
        self.one_each(list.as_ref()?)
    }

    fn one_each<'l>(&self, list: &'l Located<Numbers>) -> Option<&'l Numbers> {
        self.has_length(list, self.joint_count?, "one for each joint")
    }

    fn counted<'l>(&self, list: &'l List, count: usize, what: &str) -> Option<&'l Numbers> {
        self.has_length(list.as_ref()?, count, what)
    }

    fn has_length<'l>(
        &self,
        list: &'l Located<Numbers>,
        count: usize,
        what: &str,
    ) -> Option<&'l Numbers> {
        let here = list.value.len();
        if here == count {
            return Some(&list.value);
        }
        let message = format!("{} must have {count} numbers, not {here}", list.name);
        self.refuse(
            &list.span,
            message,
            format!("{here} here"),
            format!("write {count} numbers: {what}"),
        );
        None
    }

    fn not_empty<T>(&self, list: &Located<Vec<T>>, example: &str) -> Option<()> {
        if !list.value.is_empty() {
            return Some(());
        }
        let message = format!("{} is empty", list.name);
        self.refuse(
            &list.span,
            message,
            "nothing here",
            format!("write `{example}`"),
        );
        None
    }

    fn refuse(
        &self,
        span: &core::ops::Range<usize>,
        message: String,
        label: impl Into<String>,
        help: impl Into<String>,
    ) {
        let error = Diagnostic::error(span.clone(), message);
        self.sink.push(error.label(label).help(help));
    }
}
