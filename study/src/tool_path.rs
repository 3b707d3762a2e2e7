//! A straight path of the tool, resolved into joint motion through the pseudoinverse.

use nalgebra::{SMatrix, SVector, Vector6};

use ulna::Arm;
use ulna::control::null_space::{NEAR_SINGULAR, NullSpace};
use ulna::control::trajectory::{JointLimits, JointState, Profile, Trajectory, TrajectoryError};

/// The tool moved along a straight line, joint rates resolved as `q̇ = J†v` over the task's rows
/// (Siciliano et al., Robotics: Modelling, Planning and Control, 3.5.1), along a [`Profile`].
///
/// Knots are integrated along the path by the classical fourth-order Runge–Kutta rule; between knots a quintic takes over
/// position, velocity and acceleration of both, so that the three stay each other's derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolPath<const N: usize> {
    profile: Profile,
    /// Those of the profile: acceleration or jerk jumps between them, so none shares a knot. At least one.
    phases: Vec<Phase<N>>,
}

#[derive(Clone, Debug, PartialEq)]
struct Phase<const N: usize> {
    start: f64,
    step: f64,
    /// At least two.
    knots: Vec<JointState<N>>,
}

/// A straight displacement of the tool and its timing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StraightLine {
    /// `[translation; rotation vector]`, world axes, m and rad; only the task's rows are followed.
    pub displacement: Vector6<f64>,
    /// How the tool speeds up and slows down.
    pub profile: Profile,
    /// The largest time between two knots, s.
    pub knot_period: f64,
}

/// Below this share of the motion a phase is rounding of its ends, and left to its neighbour.
const NO_PHASE: f64 = 1e-12;

impl<const N: usize> ToolPath<N> {
    /// Moves the tool of `arm` from its place at `start` along `line`.
    ///
    /// Refuses lines that make no motion, poses with a conditioning below [`NEAR_SINGULAR`], and joint rates beyond `limits`:
    /// velocities and accelerations at the knots, the jerk on the mean from knot to knot.
    pub fn straight(
        arm: &(impl Arm<N> + ?Sized),
        start: &SVector<f64, N>,
        line: &StraightLine,
        limits: &JointLimits<N>,
    ) -> Result<Self, TrajectoryError> {
        if !JointState::at_rest(*start).is_finite() {
            return Err(TrajectoryError::NotFinite("start"));
        }
        if !line.displacement.iter().all(|x| x.is_finite()) {
            return Err(TrajectoryError::NotFinite("displacement"));
        }
        let profile = line.profile;
        let knots = profile.duration() / line.knot_period;
        if !(knots > 0.0 && knots <= 1e6) {
            return Err(TrajectoryError::KnotPeriod(line.knot_period));
        }
        let resolver = Resolver {
            arm,
            displacement: line.displacement,
            profile,
            limits,
        };
        let mut q = *start;
        let mut phases: Vec<Phase<N>> = Vec::new();
        let ends: Vec<f64> = profile.phase_ends().collect();
        for pair in ends.windows(2) {
            let (start, end) = (pair[0], pair[1]);
            let length = end - start;
            if length <= NO_PHASE * profile.duration() {
                continue;
            }
            let steps = (length / line.knot_period).ceil().max(1.0);
            let phase = resolver.phase(q, start, end, steps)?;
            if let Some(last) = phase.knots.last() {
                q = last.q;
            }
            phases.push(phase);
        }
        let path = Self { profile, phases };
        path.admit_jerk(limits)?;
        Ok(path)
    }

    /// How the tool speeds up and slows down.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The planned state at `time`, s; where q̈ jumps, with its value before the jump.
    pub fn state_before(&self, time: f64) -> JointState<N> {
        let [first, last] = self.ends();
        if time <= 0.0 {
            JointState::at_rest(first.q)
        } else if time > self.profile.duration() {
            JointState::at_rest(last.q)
        } else {
            self.phase(|phase| time > phase.start).state(time)
        }
    }

    /// The knots, each with its time, s.
    pub fn states(&self) -> impl Iterator<Item = (f64, &JointState<N>)> {
        self.phases.iter().flat_map(|phase| {
            let knots = phase.knots.iter().enumerate();
            knots.map(|(index, knot)| (phase.start + index as f64 * phase.step, knot))
        })
    }

    /// The first and the last knot.
    fn ends(&self) -> [&JointState<N>; 2] {
        let last = &self.phases[self.phases.len() - 1].knots;
        [&self.phases[0].knots[0], &last[last.len() - 1]]
    }

    /// The last of the phases that have `begun`.
    fn phase(&self, begun: impl Fn(&Phase<N>) -> bool) -> &Phase<N> {
        let found = self.phases.iter().rev().find(|phase| begun(phase));
        found.unwrap_or(&self.phases[0])
    }

    fn admit_jerk(&self, limits: &JointLimits<N>) -> Result<(), TrajectoryError> {
        if limits.jerk.iter().all(|limit| *limit == f64::INFINITY) {
            return Ok(());
        }
        for phase in &self.phases {
            if self.profile.peak_jerk() == f64::INFINITY {
                // The tool's acceleration jumps, and with it that of every joint that moves for it.
                let jump = self.state_before(phase.start).qdd - phase.knots[0].qdd;
                let jerk = jump.map(|jump| if jump == 0.0 { 0.0 } else { f64::INFINITY });
                limits.admit_jerk(&jerk, phase.start)?;
            }
            for (i, pair) in phase.knots.windows(2).enumerate() {
                let jerk = (pair[1].qdd - pair[0].qdd) / phase.step;
                limits.admit_jerk(&jerk, phase.start + phase.step * (i as f64 + 0.5))?;
            }
        }
        Ok(())
    }
}

struct Resolver<'a, A: ?Sized, const N: usize> {
    arm: &'a A,
    displacement: Vector6<f64>,
    profile: Profile,
    limits: &'a JointLimits<N>,
}

impl<A: Arm<N> + ?Sized, const N: usize> Resolver<'_, A, N> {
    /// `steps` + 1 knots from `q` at the time `start` to `end`.
    fn phase(
        &self,
        mut q: SVector<f64, N>,
        start: f64,
        end: f64,
        steps: f64,
    ) -> Result<Phase<N>, TrajectoryError> {
        let step = (end - start) / steps;
        let steps = steps as usize;
        let mut knots = Vec::with_capacity(steps + 1);
        knots.push(self.knot(q, start, self.profile.at(start))?);
        for i in 0..steps {
            let from = start + step * i as f64;
            let last = i + 1 == steps;
            let to = if last { end } else { from + step };
            // At the phase's end its own acceleration, not that of the next one.
            let point = if last {
                self.profile.just_before(end)
            } else {
                self.profile.at(to)
            };
            // Along the path instead of over time: what is integrated does not know the profile, nor suffers from it.
            let way = point.0 - self.profile.at(from).0;
            let slope = |q: SVector<f64, N>, time: f64| self.rate(&q, time, 1.0);
            let middle = 0.5 * (from + to);
            let k1 = slope(q, from)?;
            let k2 = slope(q + k1 * (0.5 * way), middle)?;
            let k3 = slope(q + k2 * (0.5 * way), middle)?;
            let k4 = slope(q + k3 * way, to)?;
            q += (k1 + (k2 + k3) * 2.0 + k4) * (way / 6.0);
            knots.push(self.knot(q, to, point)?);
        }
        Ok(Phase { start, step, knots })
    }

    fn rate(
        &self,
        q: &SVector<f64, N>,
        time: f64,
        speed: f64,
    ) -> Result<SVector<f64, N>, TrajectoryError> {
        let null_space = NullSpace::new(&self.arm.geometric_jacobian(q), self.arm.task());
        let conditioning = null_space.conditioning();
        if conditioning < NEAR_SINGULAR {
            return Err(TrajectoryError::NearSingular { time, conditioning });
        }
        Ok(null_space.resolve(&(self.displacement * speed)))
    }

    /// The state in `q`: with q̇ = Jᵀλ, q̈ = J†(v̇ − J̇q̇) + (I − J†J) J̇ᵀλ.
    fn knot(
        &self,
        q: SVector<f64, N>,
        time: f64,
        (_, speed, acceleration): (f64, f64, f64),
    ) -> Result<JointState<N>, TrajectoryError> {
        let qd = self.rate(&q, time, speed)?;
        let null_space = NullSpace::new(&self.arm.geometric_jacobian(&q), self.arm.task());
        let jacobian_rate: SMatrix<f64, 6, N> = self
            .arm
            .jacobian_derivatives(&q)
            .iter()
            .zip(&qd)
            .map(|(derivative, rate)| derivative * *rate)
            .sum();
        let multiplier = null_space.static_wrench(&qd);
        let qdd = null_space.resolve(&(self.displacement * acceleration - jacobian_rate * qd))
            + null_space.project(&jacobian_rate.tr_mul(&multiplier));
        self.limits.admit_velocity(&qd, time)?;
        self.limits.admit_acceleration(&qdd, time)?;
        Ok(JointState { q, qd, qdd })
    }
}

impl<const N: usize> Trajectory<N> for ToolPath<N> {
    fn duration(&self) -> f64 {
        self.profile.duration()
    }

    fn state(&self, time: f64) -> JointState<N> {
        let [first, last] = self.ends();
        if time < 0.0 {
            JointState::at_rest(first.q)
        } else if time >= self.profile.duration() {
            JointState::at_rest(last.q)
        } else {
            self.phase(|phase| time >= phase.start).state(time)
        }
    }
}

impl<const N: usize> Phase<N> {
    fn state(&self, time: f64) -> JointState<N> {
        let elapsed = time - self.start;
        let interval = ((elapsed / self.step) as usize).min(self.knots.len() - 2);
        let from_knot = elapsed - interval as f64 * self.step;
        quintic(
            &self.knots[interval],
            &self.knots[interval + 1],
            self.step,
            from_knot,
        )
    }
}

/// The quintic that takes `length` s from `a` to `b`, after `t` s (Craig, 7.3).
fn quintic<const N: usize>(
    a: &JointState<N>,
    b: &JointState<N>,
    length: f64,
    t: f64,
) -> JointState<N> {
    // What a parabola from `a` misses of `b`, in units of the interval.
    let (h, s) = (length, t / length);
    let position = b.q - a.q - a.qd * h - a.qdd * (0.5 * h * h);
    let velocity = (b.qd - a.qd - a.qdd * h) * h;
    let acceleration = (b.qdd - a.qdd) * (h * h);
    let c3 = position * 10.0 - velocity * 4.0 + acceleration * 0.5;
    let c4 = position * -15.0 + velocity * 7.0 - acceleration;
    let c5 = position * 6.0 - velocity * 3.0 + acceleration * 0.5;
    JointState {
        q: a.q + a.qd * t + a.qdd * (0.5 * t * t) + (c3 + (c4 + c5 * s) * s) * (s * s * s),
        qd: a.qd + a.qdd * t + (c3 * 3.0 + (c4 * 4.0 + c5 * (5.0 * s)) * s) * (s * s / h),
        qdd: a.qdd + (c3 * 6.0 + (c4 * 12.0 + c5 * (20.0 * s)) * s) * (s / (h * h)),
    }
}
