//! The laws with coefficients k_d: what U is per coefficient, and Eq. 16 in closed form.

use std::time::Instant;

use nalgebra::{SMatrix, SVector};

use super::{Assessment, OperatingPoint, Operation, SearchError, Solution, SolveStatus};
use ulna::control::compensation::Compensation;

/// A coefficient that does less than this much of what ∇w_D itself would do, or the strongest coefficient does, has no say:
/// it stays 0, or as near to 0 as it may.
pub(super) const NO_SAY: f64 = 1e-9;

/// A law with coefficients k_d.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CoefficientLaw {
    /// Eq. 16. What counts is each joint's own step, the locked one's too.
    PerJoint,
    /// Eq. 20. What counts is the norm of the steps of the healthy joints: they share the coefficients.
    ///
    /// They do not share much. With J' of the locked arm, the null space of J without the locked joint is that of J',
    /// so that P' and P differ, on the healthy joints, by one direction for each locked joint:
    /// one locked joint leaves all coefficients together a single direction of the step to take away.
    Projected,
}

impl CoefficientLaw {
    /// The law with the coefficients `k`.
    pub fn with<const N: usize>(self, k: SVector<f64, N>) -> Compensation<N> {
        match self {
            Self::PerJoint => Compensation::PerJoint(k),
            Self::Projected => Compensation::Projected(k),
        }
    }

    /// ∂U/∂k_d at a sample: U is linear in k_d.
    pub(super) fn map<const N: usize>(self, sample: &OperatingPoint<N>) -> SMatrix<f64, N, N> {
        let pose = &sample.pose;
        match self {
            Self::PerJoint => SMatrix::from_diagonal(&pose.project(&pose.gradient)),
            Self::Projected => {
                let mut map = SMatrix::<f64, N, N>::zeros();
                for i in 0..N {
                    let mut weight = SVector::<f64, N>::zeros();
                    weight[i] = pose.gradient[i];
                    map.set_column(i, &pose.project(&weight));
                }
                map
            }
        }
    }
}

/// The maps of a law at every sample of an operation.
pub(super) struct Maps<'a, const N: usize> {
    pub(super) operation: &'a Operation<N>,
    pub(super) law: CoefficientLaw,
    pub(super) at: Vec<SMatrix<f64, N, N>>,
}

impl<'a, const N: usize> Maps<'a, N> {
    pub(super) fn new(operation: &'a Operation<N>, law: CoefficientLaw) -> Self {
        let at = operation.samples().iter().map(|sample| law.map(sample));
        Self {
            operation,
            law,
            at: at.collect(),
        }
    }

    /// ∂Δτ̃/∂k_d.
    pub(super) fn step(&self) -> SMatrix<f64, N, N> {
        self.after() - self.before()
    }

    /// ∂U/∂k_d just before the lock.
    pub(super) fn before(&self) -> &SMatrix<f64, N, N> {
        &self.at[self.operation.lock() - 1]
    }

    /// ∂U/∂k_d just after it.
    pub(super) fn after(&self) -> &SMatrix<f64, N, N> {
        &self.at[self.operation.lock()]
    }

    /// Whether under Eq. 16 joint i's compensation takes more from its step than what it weighs as an effort, `‖(U_i, U'_i)‖` at the lock.
    pub(super) fn worth(&self, i: usize) -> bool {
        let (before, after) = (self.before()[(i, i)], self.after()[(i, i)]);
        (after - before).abs() > self.operation.effort() * before.hypot(after)
    }
}

/// Eq. 16 exactly: `k_di = −step_i / ∂Δτ̃_i/∂k_di` cancels each joint's step; where a rated torque forbids it,
/// the nearest value that Eq. 28 allows leaves the least, since |Δτ̃_i| is convex in k_di.
///
/// With a weight e of effort ([`OperationOptions::effort`](super::OperationOptions::effort)), `|Δτ̃_i| + e ‖(U_i, U'_i)‖` is made least.
/// It is convex too, with corners at 0 and where the step is cancelled: a joint is left alone, with k_di = 0 or as near to it as may be,
/// if a newton metre of its compensation takes less than e newton metres from its step, and is treated as without a weight if more.
pub fn cancel_per_joint<const N: usize>(
    operation: &Operation<N>,
) -> Result<Solution<N>, SearchError> {
    let clock = Instant::now();
    let maps = Maps::new(operation, CoefficientLaw::PerJoint);
    let slopes = step_slopes(operation);
    let step = operation.step();
    let mut k = SVector::zeros();
    for i in 0..N {
        let worth = slopes[i].filter(|_| maps.worth(i));
        let wish = worth.map_or(0.0, |slope| -step[i] / slope);
        k[i] = maps.interval(i, &k)?.nearest(wish);
    }
    let seconds = clock.elapsed().as_secs_f64();
    let compensation = Compensation::PerJoint(k);
    Ok(Solution {
        compensation,
        assessment: operation.assess(&compensation),
        status: SolveStatus::ClosedForm,
        gap: Some(0.0),
        iterations: 0,
        seconds,
    })
}

/// The coefficients of Eq. 16 that would change each joint's step as much as it was changed from `operation`'s to `assessment`'s,
/// by whatever law: `k_di = (impact_i − step_i) / ∂Δτ̃_i/∂k_di`; 0 where Eq. 16 has no say.
///
/// They stand beside coefficients that were searched for; away from the lock, and in the tool force, Eq. 16 would act otherwise.
pub fn equivalent_per_joint<const N: usize>(
    operation: &Operation<N>,
    assessment: &Assessment<N>,
) -> SVector<f64, N> {
    let slopes = step_slopes(operation);
    let change = assessment.impact - operation.step();
    SVector::from_fn(|i, _| slopes[i].map_or(0.0, |slope| change[i] / slope))
}

/// ∂Δτ̃_i/∂k_di of Eq. 16; `None` where k_di has no say.
fn step_slopes<const N: usize>(operation: &Operation<N>) -> [Option<f64>; N] {
    let (before, after) = (operation.before(), operation.after());
    let map = |sample: &OperatingPoint<N>| CoefficientLaw::PerJoint.map(sample).diagonal();
    let slopes = map(after) - map(before);
    // Slopes that are all far below ∇w_D are what rounding leaves of a projection that takes all of it away.
    let gradient = before.pose.gradient.amax().max(after.pose.gradient.amax());
    let strongest = slopes.amax().max(gradient);
    core::array::from_fn(|i| Some(slopes[i]).filter(|slope| slope.abs() > NO_SAY * strongest))
}
