//! Rules for the regressor.
//!
//! The entry of row j and a parameter of link i is a torque: an arm from joint j to the link's frame times a force, and a moment.
//! With ℓ the longest that the arm can be, W = (Σ|q̇|)² + Σ|q̈| the acceleration of turning links (rates of prismatic joints over the
//! chain's length) and A = |g| + ℓ₀ W that of the frame's origin, ℓ₀ being its longest distance from the base, the terms amount to
//! ℓ A for the mass, ℓ W + A for a first moment, W for the inertia; to A, W and 0 in the row of a prismatic joint.

use nalgebra::SMatrix;

use super::{Judge, Verdict, rounded};
use crate::JointKind;
use crate::arm::Parameter;
use crate::arm::coordinates::coordinates;
use crate::proof::{relative, worse};

type Regressor<const N: usize> = [SMatrix<f64, N, 10>; N];

impl<const N: usize> Judge<'_, N> {
    pub(in crate::proof) fn regressor(
        &self,
        found: Regressor<N>,
        expected: impl FnOnce() -> Regressor<N>,
    ) -> Verdict {
        let expected = expected();
        self.columns(&found, &expected, |_, _| true)
    }

    /// A column that is kept is Y's, and the same columns are kept.
    ///
    /// Which are kept follows from the arm alone. Of an arm that is special but for so little that rounding decides which columns
    /// depend on each other, only those are compared that are kept.
    pub(in crate::proof) fn base_regressor(
        &self,
        found: Regressor<N>,
        expected: impl FnOnce() -> Regressor<N>,
    ) -> Verdict {
        let expected = expected();
        let (q, qd, qdd) = (&self.state.q, &self.state.qd, &self.state.qdd);
        let all = self.reference.regressor(q, qd, qdd);
        let kept = |regressor: &Regressor<N>, i: usize, column: usize| {
            regressor[i].column(column).iter().any(|x| *x != 0.0)
        };
        let (error, allowed) = self.columns(&found, &all, |i, column| kept(&found, i, column));
        let mut places = (0..N).flat_map(|i| (0..Parameter::COUNT).map(move |column| (i, column)));
        let same = places.all(|(i, column)| kept(&found, i, column) == kept(&expected, i, column));
        let others = if same || !self.chain.base_columns().are_clear {
            0.0
        } else {
            f64::INFINITY
        };
        (worse(error, others), allowed)
    }

    /// The largest error of an entry among some columns.
    fn columns(
        &self,
        found: &Regressor<N>,
        expected: &Regressor<N>,
        among: impl Fn(usize, usize) -> bool,
    ) -> Verdict {
        let turning = self.turning();
        let gravity = self.chain.gravity.map(f64::abs).iter().sum::<f64>();
        let mut error = 0.0;
        for i in 0..N {
            let field = gravity + self.reach(0, i) * turning;
            for j in 0..N {
                let arm = self.reach(j + 1, i);
                let sizes = match self.chain.joints[j].kind {
                    JointKind::Revolute => [arm * field, arm * turning + field, turning],
                    JointKind::Prismatic => [field, turning, 0.0],
                };
                for parameter in Parameter::ALL {
                    let column = parameter.index();
                    if among(i, column) {
                        let difference = found[i][(j, column)] - expected[i][(j, column)];
                        error = worse(error, relative(difference, sizes[parameter.degree()]));
                    }
                }
            }
        }
        rounded::<N>(error)
    }

    /// The longest distance between the origins of two frames, by the rows from `first` to `last`, m.
    fn reach(&self, first: usize, last: usize) -> f64 {
        let offsets = coordinates(self.chain, &self.state.q.data.0[0]);
        let rows = self.chain.joints.iter().zip(offsets);
        let rows = rows.take(last + 1).skip(first);
        rows.map(|(joint, offset)| {
            let travel = match joint.kind {
                JointKind::Revolute => 0.0,
                JointKind::Prismatic => offset.abs(),
            };
            joint.a.abs() + joint.d.abs() + travel
        })
        .sum()
    }

    /// W.
    fn turning(&self) -> f64 {
        let sum = |rates: &nalgebra::SVector<f64, N>| -> f64 {
            (0..N).map(|i| rates[i].abs() / self.unit(i)).sum()
        };
        let speed = sum(&self.state.qd);
        speed * speed + sum(&self.state.qdd)
    }
}
