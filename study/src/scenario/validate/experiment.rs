//! `[[experiment]]`.

use nalgebra::Vector6;

use super::Reader;
use super::failure::{FailureRead, latest};
use crate::scenario::format::DEFAULT_STEP_TIME;
use crate::scenario::format::bounds::{MAX_COEFFICIENTS, MAX_FIGURES};
use crate::scenario::format::experiment as format;
use crate::scenario::read::{
    ExperimentTable, FigureTable, FigureWord, List, Numbers, RatedTable, ReferenceTable,
};
use crate::scenario::{Experiment, Figure, FigureKind, Reference, ToolForce};
use ulna::Joint;
use ulna_table::toml_reader::{Key, Located};

impl Reader<'_> {
    /// The experiments; each section and each figure's name may be there once. `failure` and `duration` are `None` if they
    /// have been reported.
    pub(super) fn experiments(
        &self,
        tables: &[ExperimentTable],
        failure: Option<&FailureRead>,
        duration: Option<f64>,
    ) -> Option<Vec<Experiment>> {
        let mut sections: Vec<&str> = Vec::new();
        let mut names: Vec<&str> = Vec::new();
        let mut read = Vec::new();
        for table in tables {
            let mut experiment = self.experiment(table, failure, duration);
            if let Some(section) = &table.section {
                if sections.contains(&section.value.as_str()) {
                    let message = format!("section {:?} is there twice", section.value);
                    self.refuse(
                        &section.span,
                        message,
                        "repeated",
                        "give each experiment its own section",
                    );
                    experiment = None;
                }
                // It becomes a part of files' names.
                let plain = |c: char| c.is_ascii_alphanumeric() || ".-_".contains(c);
                let name = &section.value;
                if !name.chars().all(plain) || !(1..=32).contains(&name.len()) {
                    let message = format!("section {name:?} cannot be part of a file's name");
                    let help = "write up to 32 letters, digits, dots, hyphens and underscores";
                    self.refuse(&section.span, message, "", help);
                    experiment = None;
                }
                sections.push(name);
            }
            for name in table
                .figures
                .iter()
                .filter_map(|figure| figure.name.as_ref())
            {
                if names.contains(&name.value.as_str()) {
                    let message = format!("a figure is called {:?} already", name.value);
                    self.refuse(
                        &name.span,
                        message,
                        "repeated",
                        "give each figure its own name",
                    );
                    experiment = None;
                }
                names.push(&name.value);
                if names.len() == MAX_FIGURES + 1 {
                    let message = format!("there are more than {MAX_FIGURES} figures");
                    let help = "write fewer figures, or several scenarios";
                    self.refuse(&name.span, message, "one too many", help);
                    experiment = None;
                }
            }
            read.push(experiment);
        }
        read.into_iter().collect()
    }

    fn experiment(
        &self,
        table: &ExperimentTable,
        failure: Option<&FailureRead>,
        duration: Option<f64>,
    ) -> Option<Experiment> {
        let times = failure.map(|failure| failure.times.as_slice());
        let none: [Vec<f64>; 3] = Default::default();
        let force = self.polynomials(&table.force, &format::FORCE);
        let moment = match &table.moment {
            None => Some(none),
            moment => self.polynomials(moment, &format::MOMENT),
        };
        let rated_torque = table.rated_torque.as_ref();
        let rated_torque = rated_torque.map(|rated| self.rated_torque(rated));
        let step_time = match &table.step_time {
            None => Some(failure.map_or(DEFAULT_STEP_TIME, |failure| failure.step_time)),
            written => {
                let span = times.and_then(latest).zip(duration);
                self.step_time(written, &format::STEP_TIME, span)
            }
        };
        let references: Vec<_> = table
            .references
            .iter()
            .map(|reference| self.reference(reference))
            .collect();
        let figures = table.figures.iter();
        let figures: Vec<_> = figures.map(|figure| self.figure(figure, times)).collect();
        let [fx, fy, fz] = force?;
        let [nx, ny, nz] = moment?;
        Some(Experiment {
            section: table.section.as_ref()?.value.clone(),
            title: table.title.clone(),
            force: ToolForce {
                coefficients: [fx, fy, fz, nx, ny, nz],
                lock_step: failure.map_or(Vector6::zeros(), |failure| failure.wrench_step),
            },
            rated_torque: rated_torque??,
            step_time: step_time?,
            references: references.into_iter().collect::<Option<_>>()?,
            figures: figures.into_iter().collect::<Option<_>>()?,
        })
    }

    /// `Some(None)` for no limit.
    pub(super) fn rated_torque(&self, rated: &RatedTable) -> Option<Option<Vec<f64>>> {
        match rated {
            RatedTable::None => Some(None),
            RatedTable::OfArm => {
                let of_arm = |joint: &Joint| joint.rated_torque.unwrap_or(f64::INFINITY);
                Some(Some(self.joints?.iter().map(of_arm).collect()))
            }
            RatedTable::Common(rated) => {
                let rated = format::RATED_TORQUE.admit(rated, self.sink)?;
                Some(Some(vec![rated; self.joint_count?]))
            }
            RatedTable::Each(list) => {
                let numbers = self.one_each(list)?;
                Some(Some(format::RATED_TORQUE.admit_all(numbers, self.sink)?))
            }
        }
    }

    fn figure(&self, table: &FigureTable, times: Option<&[f64]>) -> Option<Figure> {
        let name = table.name.as_ref().filter(|name| {
            // It becomes the name of files.
            let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
            let sound = name.value.chars().all(plain) && (1..=64).contains(&name.value.len());
            if !sound {
                let message = format!("{} cannot name a file", name.name);
                self.refuse(
                    &name.span,
                    message,
                    "",
                    "write up to 64 of a to z, 0 to 9 and _",
                );
            }
            sound
        });
        let joints = table.joints.as_ref();
        let joints = joints.and_then(|joints| self.joint_numbers(joints));
        let time = table.time.as_ref().filter(|time| {
            let planned = times.is_none_or(|times| times.contains(&time.value));
            if !planned {
                let message = format!("{} is no failure time", time.name);
                self.refuse(&time.span, message, "", "write one of `times` of [failure]");
            }
            planned
        });
        let kind = match table.kind? {
            FigureWord::Impact => FigureKind::Impact,
            FigureWord::Torque => FigureKind::Torque {
                joints: joints?,
                time: time?.value,
            },
        };
        Some(Figure {
            name: name?.value.clone(),
            kind,
        })
    }

    fn polynomials(
        &self,
        list: &Option<Located<Vec<Option<Numbers>>>>,
        key: &Key,
    ) -> Option<[Vec<f64>; 3]> {
        let list = list.as_ref()?;
        let admit = |component: &Option<Numbers>| {
            let component = component.as_ref()?;
            if component.len() > MAX_COEFFICIENTS {
                let message = format!(
                    "a component of {} has {} coefficients",
                    list.name,
                    component.len()
                );
                let most = format!("at most {MAX_COEFFICIENTS}");
                self.refuse(
                    &list.span,
                    message,
                    most,
                    "the constant comes first, then the factor of t",
                );
                return None;
            }
            key.admit_all(component, self.sink)
        };
        let components: Vec<_> = list.value.iter().map(admit).collect();
        let count = components.len();
        let Ok(components) = <[_; 3]>::try_from(components) else {
            let message = format!("{} must have 3 components, not {count}", list.name);
            let label = format!("{count} here");
            self.refuse(
                &list.span,
                message,
                label,
                "write x, y and z, each a number or [c0, c1, c2] for c0 + c1 t + c2 t^2",
            );
            return None;
        };
        let [x, y, z] = components;
        Some([x?, y?, z?])
    }

    fn reference(&self, table: &ReferenceTable) -> Option<Reference> {
        let joints = match &table.joints {
            Some(list) => self.joint_numbers(list),
            None => self.joint_count.map(|count| (0..count).collect()),
        };
        let failed_joints = match &table.failed_joints {
            Some(list) => self.joint_numbers(list).map(|mut joints| {
                joints.sort_unstable();
                Some(joints)
            }),
            None => Some(None),
        };
        let time = self.bounded(&table.time, &format::REFERENCE_TIME);
        let joints = joints?;
        let spread = |list: &List, key: &Key| {
            let mut row = vec![None; self.joint_count?];
            if list.is_some() {
                let numbers = self.counted(list, joints.len(), "a figure for each joint")?;
                for (joint, figure) in joints.iter().zip(key.admit_all(numbers, self.sink)?) {
                    row[*joint] = Some(figure);
                }
            }
            Some(row)
        };
        let (before, after) = (
            spread(&table.before, &format::BEFORE),
            spread(&table.after, &format::AFTER),
        );
        let coefficients = spread(&table.coefficients, &format::COEFFICIENTS);
        let (free_after, decrease) = (
            spread(&table.free_after, &format::FREE_AFTER),
            spread(&table.decrease, &format::DECREASE),
        );
        let mean_room = match &table.mean_room {
            None => Some(None),
            written => self.bounded(written, &format::MEAN_ROOM).map(Some),
        };
        Some(Reference {
            source: table.source.clone(),
            time: time?,
            failed_joints: failed_joints?,
            before: before?,
            after: after?,
            coefficients: coefficients?,
            free_after: free_after?,
            decrease: decrease?,
            mean_room: mean_room?,
        })
    }
}
