//! [`Verdict`]: which compensation lowers what the structure really feels of a lock, and where none does.

use super::{Rotors, SearchMethod, Sweep};

/// One gain and one set of rotors, over all failure times.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The servo's gain, rad/s.
    pub gain: f64,
    /// The rotors.
    pub rotors: Rotors,
    /// Whether both are the scenario's.
    pub own: bool,
    /// One for each failure time.
    pub locks: Vec<LockVerdict>,
}

/// The same at one failure time.
#[derive(Clone, Debug, PartialEq)]
pub struct LockVerdict {
    /// s.
    pub failure_time: f64,
    /// The norm of the step that the healthy joints really transmit without compensation, N·m (N); `None` where it could not be simulated.
    pub without: Option<f64>,
    /// The same with the compensation of each method that there is one of.
    pub with: Vec<(SearchMethod, Option<f64>)>,
}

impl Verdict {
    /// What differs by less than this share of the step without compensation is as good as the same.
    pub const NOTABLE: f64 = 0.01;

    /// One for each gain and all rotors of `sweeps`, which are those of one experiment at its failure times.
    pub fn of(sweeps: &[Sweep]) -> Vec<Self> {
        let Some(first) = sweeps.first() else {
            return Vec::new();
        };
        let settings = first
            .gains
            .iter()
            .flat_map(|gain| first.rotors.iter().map(move |rotors| (*gain, rotors)));
        let verdict = |(gain, rotors): (f64, &Rotors)| Self {
            gain,
            rotors: rotors.clone(),
            own: gain == first.own_gain && *rotors == first.own_rotors,
            locks: sweeps
                .iter()
                .map(|sweep| LockVerdict::of(sweep, gain, rotors))
                .collect(),
        };
        settings.map(verdict).collect()
    }
}

impl LockVerdict {
    fn of(sweep: &Sweep, gain: f64, rotors: &Rotors) -> Self {
        let step = |method| sweep.felt(gain, rotors, method).map(|felt| felt.step);
        let methods = sweep.methods().into_iter();
        Self {
            failure_time: sweep.failure_time,
            without: step(None),
            with: methods.map(|method| (method, step(Some(method)))).collect(),
        }
    }

    /// The step with the compensation of `method`, relative to the one without; `None` where one of them is not known, or there is no step.
    pub fn ratio(&self, method: SearchMethod) -> Option<f64> {
        let without = self.without.filter(|step| *step > 0.0)?;
        let (_, with) = self.with.iter().find(|(with, _)| *with == method)?;
        Some((*with)? / without)
    }

    /// Whether the compensation of `method` lowers the step, and notably.
    pub fn lowers(&self, method: SearchMethod) -> bool {
        self.ratio(method)
            .is_some_and(|ratio| ratio < 1.0 - Verdict::NOTABLE)
    }

    /// The method that leaves least, and what it leaves relative to the step without compensation.
    pub fn best(&self) -> Option<(SearchMethod, f64)> {
        let ratios = self.with.iter().filter_map(|(method, _)| {
            let ratio = self.ratio(*method)?;
            Some((*method, ratio))
        });
        ratios.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The method that lowers the step most, if one does, and what it leaves.
    pub fn helps(&self) -> Option<(SearchMethod, f64)> {
        self.best().filter(|(method, _)| self.lowers(*method))
    }
}
