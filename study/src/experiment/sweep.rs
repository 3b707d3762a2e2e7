//! [`Sweep`]: what the structure feels of a lock, over the servo's gain and the rotors' inertia.

use super::lock::{COARSE, Lock};
use super::{ExperimentError, ExperimentRunner, SearchMethod, for_each_joint};
use crate::scenario::{Experiment, ServoSettings};
use ulna::Trajectory;
use ulna::control::compensation::Compensation;

/// One experiment and one failure time, simulated with every gain and all rotors, without compensation and with that of each method.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// [`Experiment::section`].
    pub section: String,
    /// When the brakes fall, s.
    pub failure_time: f64,
    /// The joints whose brakes fall, counted from 0.
    pub failed_joints: Vec<usize>,
    /// How long the brakes take, s.
    pub brake_time: f64,
    /// From the failure until the controller knows, s.
    pub detection: f64,
    /// The motors hold their torques so long, s.
    pub cycle: f64,
    /// So long the compensation has acted before the lock, s.
    pub lead: f64,
    /// The gains, rad/s, ascending; the scenario's is among them.
    pub gains: Vec<f64>,
    /// Those of [`GAINS`](Self::GAINS) whose loop is not stable with this cycle
    /// ([`ServoSettings::is_stable`]): they would say nothing about a lock.
    pub unstable_gains: Vec<f64>,
    /// The rotors, the lightest first; the scenario's are among them, and none.
    pub rotors: Vec<Rotors>,
    /// The scenario's gain, rad/s.
    pub own_gain: f64,
    /// The scenario's rotors.
    pub own_rotors: Rotors,
    /// Gain by gain, rotors by rotors, without compensation first.
    pub points: Vec<SweepPoint>,
}

/// The rotors' inertia as the joints feel it.
#[derive(Clone, Debug, PartialEq)]
pub enum Rotors {
    /// The same at every joint, kg·m² (kg).
    Common(f64),
    /// The scenario's, where the joints have different ones; an entry for each.
    Own(Vec<f64>),
}

/// One simulated lock of a [`Sweep`].
#[derive(Clone, Debug, PartialEq)]
pub struct SweepPoint {
    /// The servo's gain, rad/s.
    pub gain: f64,
    /// The rotors.
    pub rotors: Rotors,
    /// `None` without compensation.
    pub method: Option<SearchMethod>,
    /// What came of it; `None` if the simulation did not come to its end.
    pub felt: Option<Felt>,
}

/// What the healthy joints transmit to the structure at a lock, N·m (N).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Felt {
    /// The norm of the step as the paper predicts it (Eq. 18).
    pub predicted_step: f64,
    /// The norm of the step as it is, from just before the lock to when the brakes have done their work and the controller knows,
    /// as a control cycle at either time makes it ([`Impact::torque_step`](crate::simulation::Impact::torque_step)).
    pub step: f64,
    /// The largest torque of one of them in that time.
    pub peak: f64,
}

impl Sweep {
    /// The gains that are tried besides the scenario's, rad/s.
    pub const GAINS: [f64; 4] = [0.0, 1.0, 5.0, 20.0];

    /// What the structure feels with these rotors, this gain and the compensation of `method`, or none.
    pub fn felt(&self, gain: f64, rotors: &Rotors, method: Option<SearchMethod>) -> Option<Felt> {
        let mut points = self.points.iter();
        let point = points.find(|point| {
            point.gain == gain && point.method == method && point.rotors == *rotors
        })?;
        point.felt
    }

    /// The methods that there is a compensation of.
    pub fn methods(&self) -> Vec<SearchMethod> {
        let mut methods = Vec::new();
        for method in self.points.iter().filter_map(|point| point.method) {
            if !methods.contains(&method) {
                methods.push(method);
            }
        }
        methods
    }
}

impl Rotors {
    /// Those of a list with an entry for each joint, kg·m² (kg).
    pub fn of(reflected_inertia: &[f64]) -> Self {
        match reflected_inertia {
            [first, others @ ..] if others.iter().all(|other| other == first) => {
                Self::Common(*first)
            }
            own => Self::Own(own.to_vec()),
        }
    }

    /// Of an arm of so many joints, kg·m² (kg).
    pub fn reflected_inertia(&self, joints: usize) -> Vec<f64> {
        match self {
            Self::Common(inertia) => vec![*inertia; joints],
            Self::Own(own) => own.clone(),
        }
    }

    /// What the list of rotors is sorted by: the heaviest.
    fn weight(&self) -> f64 {
        match self {
            Self::Common(inertia) => *inertia,
            Self::Own(own) => own.iter().copied().fold(0.0, f64::max),
        }
    }
}

impl<const N: usize> ExperimentRunner<'_, N> {
    /// One experiment with the brakes falling at `failure_time`, with every gain and all rotors.
    ///
    /// # Errors
    /// As [`study`](Self::study). A simulation that does not come to its end is left out ([`SweepPoint::felt`]).
    pub fn sweep(
        &self,
        experiment: &Experiment,
        failure_time: f64,
    ) -> Result<Sweep, ExperimentError> {
        let operation = self.operation(experiment, failure_time)?;
        let own = self.lock(failure_time)?;
        let cycle = self.scenario.cycle();
        let (mut gains, unstable_gains): (Vec<f64>, Vec<f64>) = Sweep::GAINS
            .into_iter()
            .filter(|gain| *gain != own.gain)
            .partition(|gain| ServoSettings::is_stable(*gain, cycle));
        gains.push(own.gain);
        gains.sort_by(f64::total_cmp);
        let own_rotors = Rotors::of(own.reflected_inertia.as_slice());
        let rotors = self.rotors(&own_rotors);
        let compensations = self.compensations(&operation);
        let mut points = Vec::new();
        for gain in &gains {
            for rotors in &rotors {
                let lock = Lock {
                    gain: *gain,
                    reflected_inertia: for_each_joint(&rotors.reflected_inertia(N))?,
                    ..own
                };
                for (method, compensation) in &compensations {
                    points.push(SweepPoint {
                        gain: *gain,
                        rotors: rotors.clone(),
                        method: *method,
                        felt: self.felt(experiment, *compensation, &lock)?,
                    });
                }
            }
        }
        Ok(Sweep {
            section: experiment.section().to_owned(),
            failure_time,
            failed_joints: own.brake.failure.joints.iter().collect(),
            brake_time: own.brake.duration,
            detection: own.brake.detection,
            cycle,
            lead: own.lead,
            gains,
            unstable_gains,
            rotors,
            own_gain: own.gain,
            own_rotors,
            points,
        })
    }

    /// None, four decades around the arm's own inertia, and the scenario's: the same at every failure time.
    fn rotors(&self, own: &Rotors) -> Vec<Rotors> {
        let times = self.scenario.failure_times().iter();
        let largest = times
            .map(|time| {
                self.arm
                    .mass_matrix(&self.motion().state(*time).q)
                    .diagonal()
                    .max()
            })
            .fold(f64::MIN_POSITIVE, f64::max);
        let decade = largest.log10().ceil() as i32;
        let decades = (decade - 2..=decade + 1).map(|decade| Rotors::Common(10_f64.powi(decade)));
        let mut rotors: Vec<_> = std::iter::once(Rotors::Common(0.0))
            .chain(decades)
            .collect();
        if !rotors.contains(own) {
            rotors.push(own.clone());
        }
        rotors.sort_by(|a, b| a.weight().total_cmp(&b.weight()));
        rotors
    }

    fn felt(
        &self,
        experiment: &Experiment,
        compensation: Compensation<N>,
        lock: &Lock<N>,
    ) -> Result<Option<Felt>, ExperimentError> {
        let joints = lock.brake.failure.joints;
        let run = (lock.span(), COARSE);
        match self.simulate(experiment, compensation, lock, run, &mut |_| ()) {
            Ok((impact, _)) => {
                let felt = Felt {
                    predicted_step: joints.without(&impact.predicted_step).norm(),
                    step: joints.without(&impact.torque_step).norm(),
                    peak: joints.without(&impact.peak_torque).amax(),
                };
                let finite = felt.step.is_finite() && felt.peak.is_finite();
                Ok(finite.then_some(felt))
            }
            Err(ExperimentError::Unfinished { .. }) => Ok(None),
            Err(error) => Err(error),
        }
    }
}
