//! `[servo]` and `[motors]`.

use super::Reader;
use crate::scenario::drives::{MotorSettings, ServoSettings};
use crate::scenario::format::{motors, servo};
use crate::scenario::read::{CommonOrEach, MotorsTable, Number, ProjectorWord, ServoTable};
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
        Some(MotorSettings {
            rotor_inertia: inertia?,
            ratio: ratio?,
        })
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
