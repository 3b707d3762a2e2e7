//! `[[experiment]]`.

use super::Reader;
use crate::Joint;
use crate::scenario::read::{ExperimentTable, List, Numbers, RatedTable, ReferenceTable};
use crate::scenario::{Experiment, Reference, ToolForce};
use crate::toml_reader::{Bound, Located};

const FORCE: Bound = Bound {
    range: -1e7..=1e7,
    unit: "N (N m) per power of s",
    help: "forces are in newtons",
};
const RATED: Bound = Bound {
    range: 1e-6..=1e7,
    unit: "N m (N if prismatic)",
    help: "a rated torque is positive; write \"none\" if there is none",
};
const FIGURE: Bound = Bound {
    range: -1e16..=1e16,
    unit: "",
    help: "write the figure as it is printed",
};
const FAILURE_TIME: Bound = Bound {
    range: 0.0..=1e5,
    unit: "s",
    help: "times are in seconds",
};

/// The highest power of time in a force, plus 1.
const MAX_COEFFICIENTS: usize = 8;

impl Reader<'_> {
    pub(super) fn experiments(&self, tables: &[ExperimentTable]) -> Option<Vec<Experiment>> {
        let mut sections: Vec<&str> = Vec::new();
        let mut read = Vec::new();
        for table in tables {
            let mut experiment = self.experiment(table);
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
                sections.push(&section.value);
            }
            read.push(experiment);
        }
        read.into_iter().collect()
    }

    fn experiment(&self, table: &ExperimentTable) -> Option<Experiment> {
        let none: [Vec<f64>; 3] = Default::default();
        let force = self.polynomials(&table.force);
        let moment = match &table.moment {
            None => Some(none),
            moment => self.polynomials(moment),
        };
        let rated_torque = table.rated_torque.as_ref().map(|rated| match rated {
            RatedTable::None => Some(None),
            RatedTable::OfArm => {
                let of_arm = |joint: &Joint| joint.rated_torque.unwrap_or(f64::INFINITY);
                Some(Some(self.joints?.iter().map(of_arm).collect()))
            }
            RatedTable::Common(rated) => {
                let rated = RATED.admit(rated, self.sink)?;
                Some(Some(vec![rated; self.joint_count?]))
            }
            RatedTable::Each(list) => {
                let numbers = self.one_each(list)?;
                Some(Some(RATED.admit_all(numbers, self.sink)?))
            }
        });
        let references: Vec<_> = table
            .references
            .iter()
            .map(|reference| self.reference(reference))
            .collect();
        let [fx, fy, fz] = force?;
        let [nx, ny, nz] = moment?;
        Some(Experiment {
            section: table.section.as_ref()?.value.clone(),
            title: table.title.clone(),
            force: ToolForce {
                coefficients: [fx, fy, fz, nx, ny, nz],
            },
            rated_torque: rated_torque??,
            references: references.into_iter().collect::<Option<_>>()?,
        })
    }

    fn polynomials(&self, list: &Option<Located<Vec<Option<Numbers>>>>) -> Option<[Vec<f64>; 3]> {
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
            FORCE.admit_all(component, self.sink)
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
        let time = self.bounded(&table.time, &FAILURE_TIME);
        let joints = joints?;
        let spread = |list: &List| {
            let mut row = vec![None; self.joint_count?];
            if list.is_some() {
                let numbers = self.counted(list, joints.len(), "a figure for each joint")?;
                for (joint, figure) in joints.iter().zip(FIGURE.admit_all(numbers, self.sink)?) {
                    row[*joint] = Some(figure);
                }
            }
            Some(row)
        };
        let (before, after) = (spread(&table.before), spread(&table.after));
        let coefficients = spread(&table.coefficients);
        Some(Reference {
            source: table.source.clone(),
            time: time?,
            before: before?,
            after: after?,
            coefficients: coefficients?,
        })
    }
}
