//! The ground truth: what an arm really does while a joint is braked and locked.
//!
//! The impact torque of Eq. 1–12 assumes that the healthy joints keep their planned motion through the lock.
//! Here nothing is assumed: the arm obeys
//!
//! `(M + R) q̈ + c(q, q̇) + g(q) + f(q̇) + Jᵀ F_e = τ_motor + τ_brake`,
//!
//! with `f` the joints' friction, `F_e` the wrench that the tool exerts on its surroundings and R the inertia of rotors behind their gears that M has not in it; motors give what the [`Controller`] asks for (computed torque
//! along the planned motion, plus compensation), and the brakes take their joints to rest in a finite time and hold them.
//! A braked joint's acceleration is given, so that it is eliminated from the equations and its torque computed: exact, without a penalty.
//! The limit of ever shorter brakes is the impulse of [`ideal_lock`].
//!
//! What a joint transmits to the structure is `τ_motor + τ_brake − R q̈`: what accelerates its rotor does not get through.
//! Without rotors (direct drive) all does. With heavy ones the arm cannot push its joints about, and the healthy ones keep their plan as Eq. 1–12 have it;
//! but then the rotors also take up what a compensation adds.
//!
//! Beside the motion, work and impulses are integrated; [`Balance`] says how well energy and momentum account for it.
//! Motors follow their commands at once.
//!
//! ```
//! use ulna::nalgebra::Vector6;
//! use ulna::{Arm, Compensation, Controller, Failure, Trajectory};
//! use ulna_study::simulation::{Brake, Control, Feedback, Resolution, Simulation};
//!
//! /// What a joint's brake gives, N·m·s, beside what the ideal lock would ask of it.
//! fn brake_impulse<const N: usize>(
//!     arm: &impl Arm<N>,
//!     trajectory: &impl Trajectory<N>,
//!     failure: Failure<N>,
//! ) -> Option<[f64; 2]> {
//!     let joint = failure.joints.iter().next()?;
//!     let simulation = Simulation {
//!         plant: arm,
//!         controller: Controller::new(arm, Compensation::none()),
//!         trajectory,
//!         wrench: |_| Vector6::zeros(),
//!         feedback: Feedback::critical(5.0),
//!         control: Control::Every(1e-3),
//!         brake: Brake::new(failure, 0.1),
//!         reflected_inertia: [0.0; N].into(),
//!     };
//!     let span = 0.0..trajectory.duration();
//!     let outcome = simulation.run(span, &Resolution::default(), |_| ()).ok()?;
//!     let impact = outcome.impact?;
//!     Some([impact.brake_impulse[joint], impact.ideal.brake[joint]])
//! }
//! ```

mod brake;
mod dormand_prince;
mod flow;
mod motion;
mod outcome;
mod peak;
mod run;
mod servo;
mod tool_acceleration;

use std::ops::Range;

use nalgebra::{SVector, Vector6};

use ulna::control::trajectory::{JointState, Trajectory};
use ulna::{Arm, Controller, Cycle, Failure};

pub use brake::{Brake, BrakeProfile, LockImpulse, ideal_lock};
use flow::Flow;
pub use flow::Work;
pub use outcome::{Balance, Ending, Impact, Outcome};
use run::Run;
pub use servo::{Control, Feedback};
pub use tool_acceleration::tool_acceleration;

/// An arm, its controller, its task and its failure.
#[derive(Clone, Copy, Debug)]
pub struct Simulation<'a, P: ?Sized, A: ?Sized, T, W, const N: usize> {
    /// The arm as it is. The controller may have another picture of it.
    pub plant: &'a P,
    /// What drives it.
    pub controller: Controller<'a, A, N>,
    /// The planned motion.
    pub trajectory: &'a T,
    /// `F_e` at a time in s: the wrench `[f; n]` that the tool exerts, world axes, at the tool point.
    pub wrench: W,
    /// How the controller meets departures from the planned motion.
    pub feedback: Feedback,
    /// When the controller acts.
    pub control: Control,
    /// The failure.
    pub brake: Brake<N>,
    /// R, the inertia of each joint's rotor as the joint feels it: its own times the square of its gear's ratio, kg·m² (kg);
    /// 0 where the plant's table has the rotor, and with it M ([`ulna::Motor`]).
    /// Controllers know it, and give what its planned acceleration takes on top of their torque; rated torques are about the latter.
    pub reflected_inertia: SVector<f64, N>,
}

/// How finely a run is computed and seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Bound of a step's local error in every entry of the state, relative to 1 (rad, rad/s, J, N·m·s) plus its size.
    pub tolerance: f64,
    /// The largest time between two samples, s.
    pub sample_period: f64,
    /// Samples that every stretch between two events has at least, so that a short brake is seen too; 0 counts as 1.
    pub samples_at_least: u32,
    /// Steps that are tried at most, so that a run ends whatever is asked of it.
    pub steps: u32,
}

impl Default for Resolution {
    /// 1e-10, 10 ms, 16 samples between two events and a hundred thousand steps.
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            sample_period: 0.01,
            samples_at_least: 16,
            steps: 100_000,
        }
    }
}

/// The arm at one time of a run. Where an event makes something jump there are two samples, before and after.
#[derive(Clone, Copy, Debug)]
pub struct Sample<const N: usize> {
    /// s.
    pub time: f64,
    /// Since the failure, s, without the rounding of `time`; below 0 before it.
    pub elapsed: f64,
    /// The arm's motion.
    pub state: JointState<N>,
    /// The motion that the paper assumes: as planned, but the locked joints at rest from the failure on.
    pub planned: JointState<N>,
    /// The motors' torques, N·m (N).
    pub motor: SVector<f64, N>,
    /// The brakes' torques, N·m (N); 0 where none acts.
    pub brake: SVector<f64, N>,
    /// What accelerates the rotors, `R q̈`, N·m (N).
    pub rotor: SVector<f64, N>,
    /// The control cycle that made the motors' torques.
    pub control: Cycle<N>,
}

impl<const N: usize> Sample<N> {
    /// What each joint transmits to the structure, N·m (N): its motor's torque and its brake's, without what its rotor takes up.
    pub fn joint_torque(&self) -> SVector<f64, N> {
        self.motor + self.brake - self.rotor
    }
}

/// Why a run cannot begin.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// A span that is empty or not finite.
    #[error("the run must begin before it ends, at finite times, not go from {0} s to {1} s")]
    Span(f64, f64),
    /// A number that has to be finite and above 0.
    #[error("the {0} must be finite and above 0, not {1}")]
    NotPositive(&'static str, f64),
    /// A number that has to be finite and not below 0.
    #[error("the {0} must be finite and not below 0, not {1}")]
    Negative(&'static str, f64),
    /// A failure at no finite time, or before the run.
    #[error("the failure's time must be finite and not before the run's begin, not {0} s")]
    FailureTime(f64),
}

impl<P, A, T, W, const N: usize> Simulation<'_, P, A, T, W, N>
where
    P: Arm<N> + ?Sized,
    A: Arm<N> + ?Sized,
    T: Trajectory<N>,
    W: Fn(f64) -> Vector6<f64>,
{
    /// Runs from the planned state at `span.start`, s, to `span.end` and shows every sample to `observe`, in order of time.
    ///
    /// The times of all events are hit exactly. Nothing is allocated.
    ///
    /// # Errors
    /// When an argument makes no run. What goes wrong on the way stands in [`Outcome::ending`].
    pub fn run(
        &self,
        span: Range<f64>,
        resolution: &Resolution,
        mut observe: impl FnMut(&Sample<N>),
    ) -> Result<Outcome<N>, SimulationError> {
        self.check(&span, resolution)?;
        let start = self.trajectory.state(span.start);
        let start = Flow::new(start.q, start.qd);
        let mut run = Run::new(self, resolution, &mut observe, start);
        let ending = run.through(&span);
        Ok(Outcome {
            ending,
            impact: run.impact(),
            balance: self.balance(&start, &run.flow),
            status: run.status,
            steps: run.steps(),
        })
    }

    /// [`run`](Self::run) with all samples in one series.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn record(
        &self,
        span: Range<f64>,
        resolution: &Resolution,
    ) -> Result<(Vec<Sample<N>>, Outcome<N>), SimulationError> {
        let mut series = Vec::new();
        let outcome = self.run(span, resolution, |sample| series.push(*sample))?;
        Ok((series, outcome))
    }

    fn check(&self, span: &Range<f64>, resolution: &Resolution) -> Result<(), SimulationError> {
        let (start, end) = (span.start, span.end);
        if !(start.is_finite() && end.is_finite() && start < end) {
            return Err(SimulationError::Span(start, end));
        }
        let Failure { joints, time } = self.brake.failure;
        if !time.is_finite() || (time < start && !joints.is_empty()) {
            return Err(SimulationError::FailureTime(time));
        }
        let control_period = match self.control {
            Control::Continuous => f64::MAX,
            Control::Every(period) => period,
        };
        for (name, value) in [
            ("control period", control_period),
            ("tolerance", resolution.tolerance),
            ("sample period", resolution.sample_period),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(SimulationError::NotPositive(name, value));
            }
        }
        for (name, value) in [
            ("brake's duration", self.brake.duration),
            ("detection", self.brake.detection),
            ("feedback's position gain", self.feedback.position),
            ("feedback's rate gain", self.feedback.rate),
            ("rotors' inertia", self.least_rotor()),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(SimulationError::Negative(name, value));
            }
        }
        Ok(())
    }

    /// The least of the rotors' inertias, or one that is no finite number.
    fn least_rotor(&self) -> f64 {
        let mut rotors = self.reflected_inertia.iter().copied();
        let odd = rotors.clone().find(|inertia| !inertia.is_finite());
        odd.unwrap_or_else(|| rotors.by_ref().fold(f64::MAX, f64::min))
    }

    fn balance(&self, start: &Flow<N>, end: &Flow<N>) -> Balance<N> {
        let momentum = |flow: &Flow<N>| {
            let rotors = self.reflected_inertia.component_mul(&flow.qd);
            self.plant.mass_matrix(&flow.q) * flow.qd + rotors
        };
        let (p0, p1) = (momentum(start), momentum(end));
        let (kinetic0, kinetic1) = (0.5 * p0.dot(&start.qd), 0.5 * p1.dot(&end.qd));
        let kinetic = kinetic1 - kinetic0;
        let largest = end.work.largest().max(kinetic0).max(kinetic1);
        let momentum = p1 - p0 - end.momentum;
        let largest_momentum = p0.amax().max(p1.amax()).max(end.momentum.amax());
        Balance {
            kinetic,
            work: end.work,
            energy_error: relative(kinetic - end.work.total(), largest),
            momentum_error: relative(momentum.amax(), largest_momentum),
        }
    }
}

/// `error` by the size of what it is an error of; if that is 0, the error as it is.
fn relative(error: f64, size: f64) -> f64 {
    let error = error.abs();
    if size > 0.0 { error / size } else { error }
}
