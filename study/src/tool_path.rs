//! A straight path of the tool, resolved into joint motion through the pseudoinverse.

use nalgebra::{SMatrix, SVector, Vector6};

use ulna::Arm;
use ulna::control::null_space::{NEAR_SINGULAR, NullSpace};
use ulna::control::trajectory::{
    JointLimits, JointState, Trajectory, TrajectoryError, TrapezoidProfile,
};

/// The tool moved along a straight line, joint rates resolved as `q̇ = J†v` over the task's rows
/// (Siciliano et al., Robotics: Modelling, Planning and Control, 3.5.1), with a trapezoidal speed.
///
/// Knots are integrated by the classical fourth-order Runge–Kutta rule; between knots a quintic takes over
/// position, velocity and acceleration of both, so that the three stay each other's derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolPath<const N: usize> {
    profile: TrapezoidProfile,
    /// Speeding up, cruising, slowing down: the acceleration jumps between them, so none shares a knot.
    phases: [Phase<N>; 3],
}

#[derive(Clone, Debug, PartialEq)]
struct Phase<const N: usize> {
    start: f64,
    step: f64,
    knots: Vec<JointState<N>>,
}

/// A straight displacement of the tool and its timing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StraightLine {
    /// `[translation; rotation vector]`, world axes, m and rad; only the task's rows are followed.
    pub displacement: Vector6<f64>,
    /// The whole motion, s.
    pub duration: f64,
    /// Speeding up and slowing down, s each.
    pub blend: f64,
    /// The largest time between two knots, s.
    pub knot_period: f64,
}

impl<const N: usize> ToolPath<N> {
    /// Moves the tool of `arm` from its place at `start` along `line`.
    ///
    /// Refuses lines that make no motion, poses with a conditioning below [`NEAR_SINGULAR`], and joint rates beyond `limits`.
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
        let profile = TrapezoidProfile::new(line.duration, line.blend)?;
        let knots = line.duration / line.knot_period;
        if !(knots > 0.0 && knots <= 1e6) {
            return Err(TrajectoryError::KnotPeriod(line.knot_period));
        }
        let (blend, cruise) = (line.blend, line.duration - 2.0 * line.blend);
        let acceleration = profile.acceleration();
        let resolver = Resolver {
            arm,
            displacement: line.displacement,
            limits,
        };
        let mut q = *start;
        let mut phase = |start: f64, length: f64, acceleration: f64| {
            let steps = (length / line.knot_period).ceil().max(1.0);
            let speed = profile.at(start).1;
            let phase = resolver.phase(
                q,
                start,
                length / steps,
                steps as usize,
                speed,
                acceleration,
            )?;
            if let Some(last) = phase.knots.last() {
                q = last.q;
            }
            Ok(phase)
        };
        Ok(Self {
            profile,
            phases: [
                phase(0.0, blend, acceleration)?,
                phase(blend, cruise, 0.0)?,
                phase(blend + cruise, blend, -acceleration)?,
            ],
        })
    }
}

struct Resolver<'a, A: ?Sized, const N: usize> {
    arm: &'a A,
    displacement: Vector6<f64>,
    limits: &'a JointLimits<N>,
}

impl<A: Arm<N> + ?Sized, const N: usize> Resolver<'_, A, N> {
    /// `steps` + 1 knots from `q` at the time `start`, with the path's speed growing by `acceleration`.
    fn phase(
        &self,
        mut q: SVector<f64, N>,
        start: f64,
        step: f64,
        steps: usize,
        speed: f64,
        acceleration: f64,
    ) -> Result<Phase<N>, TrajectoryError> {
        let mut knots = Vec::with_capacity(steps + 1);
        let speed_at = |elapsed: f64| speed + acceleration * elapsed;
        knots.push(self.knot(q, start, speed, acceleration)?);
        for i in 0..steps {
            let elapsed = step * i as f64;
            let rate = |q: SVector<f64, N>, elapsed: f64| {
                self.rate(&q, start + elapsed, speed_at(elapsed))
            };
            let k1 = rate(q, elapsed)?;
            let k2 = rate(q + k1 * (0.5 * step), elapsed + 0.5 * step)?;
            let k3 = rate(q + k2 * (0.5 * step), elapsed + 0.5 * step)?;
            let k4 = rate(q + k3 * step, elapsed + step)?;
            q += (k1 + (k2 + k3) * 2.0 + k4) * (step / 6.0);
            let elapsed = elapsed + step;
            knots.push(self.knot(q, start + elapsed, speed_at(elapsed), acceleration)?);
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
        speed: f64,
        acceleration: f64,
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
        self.limits.admit(&qd, &qdd, time)?;
        Ok(JointState { q, qd, qdd })
    }
}

impl<const N: usize> Trajectory<N> for ToolPath<N> {
    fn duration(&self) -> f64 {
        self.profile.duration()
    }

    fn state(&self, time: f64) -> JointState<N> {
        let [first, _, last] = &self.phases;
        if time < 0.0 {
            return JointState::at_rest(first.knots[0].q);
        }
        if time >= self.profile.duration() {
            return JointState::at_rest(last.knots[last.knots.len() - 1].q);
        }
        let phase = self
            .phases
            .iter()
            .rev()
            .find(|phase| time >= phase.start)
            .unwrap_or(first);
        phase.state(time - phase.start)
    }
}

impl<const N: usize> Phase<N> {
    fn state(&self, elapsed: f64) -> JointState<N> {
        if self.step <= 0.0 {
            return self.knots[0];
        }
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
