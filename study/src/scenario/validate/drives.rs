//! `[servo]` and `[motors]`.

use super::Reader;
use crate::scenario::drives::{MotorSettings, ServoSettings};
use crate::scenario::format::{motors, servo};
use crate::scenario::read::{CommonOrEach, MotorsTable, Number, ProjectorWord, ServoTable};
use ulna::Joint;
use ulna::control::compensation::Projector;
use ulna_table::toml_reader::Key;

impl Reader<'_> {
    pub(super) fn servo(&self, table: &ServoTable) -> Option<ServoSettings> {
        let or = |number: &Number, default: f64, key: &Key| match number {
            Some(_) => self.bounded(number, key),
            None => Some(default),
        };
        let gain = or(&table.gain, servo::DEFAULT_GAIN, &servo::GAIN);
        let detection = or(
            &table.detection,
            servo::DEFAULT_DETECTION,
            &servo::DETECTION,
        );
        let lead = or(&table.lead, servo::DEFAULT_LEAD, &servo::LEAD);
        let projector = match table.projector.unwrap_or(servo::DEFAULT_PROJECTOR) {
            ProjectorWord::Static => Projector::Static,
            ProjectorWord::DynamicallyConsistent => Projector::DynamicallyConsistent,
        };
        Some(ServoSettings {
            gain: gain?,
            detection: detection?,
            lead: lead?,
            projector,
        })
    }

    pub(super) fn motors(&self, table: &MotorsTable) -> Option<MotorSettings> {
        let default = motors::DEFAULT_ROTOR_INERTIA;
        let inertia = self.common_or_each(&table.rotor_inertia, default, &motors::ROTOR_INERTIA);
        let ratio = self.common_or_each(&table.ratio, motors::DEFAULT_RATIO, &motors::RATIO);
        self.counted_once(table)?;
        Some(MotorSettings {
            rotor_inertia: inertia?,
            ratio: ratio?,
        })
    }

    /// Refuses rotors that are in the arm's dynamics already.
    fn counted_once(&self, table: &MotorsTable) -> Option<()> {
        let has_rotor = |joint: &Joint| joint.motor.reflected_inertia() > 0.0;
        let (span, name) = match &table.rotor_inertia {
            Some(CommonOrEach::Common(number)) => (&number.span, &number.name),
            Some(CommonOrEach::Each(list)) => (&list.span, &list.name),
            None => return Some(()),
        };
        if !self.joints?.iter().any(has_rotor) {
            return Some(());
        }
        let message = format!("{name} would count rotors twice: the arm's table has them");
        let help = "leave it out here, or the `motor` keys out of the table";
        self.refuse(span, message, "", help);
        None
    }

    fn common_or_each(
        &self,
        written: &Option<CommonOrEach>,
        default: f64,
        key: &Key,
    ) -> Option<Vec<f64>> {
        let common = match written {
            Some(CommonOrEach::Each(list)) => {
                return key.admit_all(self.one_each(list)?, self.sink);
            }
            Some(CommonOrEach::Common(number)) => key.admit(number, self.sink)?,
            None => default,
        };
        Some(vec![common; self.joint_count?])
    }
}
