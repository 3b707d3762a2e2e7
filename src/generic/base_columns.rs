//! Which columns of the regressor are those of base parameters, found numerically (Gautier 1991; Khalil and Dombre, section 9.4).

use nalgebra::{SVector, Vector3};

use super::SerialChain;
use crate::arm::Parameter;
use crate::{JointKind, Real};

/// The most columns of a block that do not always depend on those of the link before: see [`candidates`].
const CANDIDATES: usize = 7;

/// States at which columns are compared. Each gives a link's block a row at least.
const STATES: usize = CANDIDATES + 2;

/// What is left of a column that depends on others, relative to what its terms can amount to, at most.
const DEPENDENT: f64 = 1e-9;
/// What is left of one where none of the others is nearly dependent: rounding alone, 4e-16 at most of arms of up to 30 joints.
/// The generator, with more digits, keeps what exceeds 1e-14.
const CLEARLY_DEPENDENT: f64 = 2e-14;
/// What is left, at least, of one that is not even nearly dependent.
const CLEARLY_INDEPENDENT: f64 = 1e-5;

/// A column of Y at all states, one below the other.
type Column<const N: usize> = [[f64; N]; STATES];

/// The candidates of a link's block.
type Block<const N: usize> = [Column<N>; CANDIDATES];

/// The columns of Y that are those of base parameters.
pub(crate) struct BaseColumns<const N: usize> {
    /// Of each link, in the order of the regressor's columns.
    pub(crate) kept: [[bool; Parameter::COUNT]; N],
    /// Whether doubles are enough to tell.
    pub(crate) are_clear: bool,
}

impl<const N: usize> SerialChain<N> {
    /// The columns that depend on none before them in the order of [`Parameter::BASE_ORDER`], by orthogonalising Y stacked over states,
    /// column after column.
    ///
    /// Decided in doubles: of an arm that is nearly but not quite special (axes a millionth of a degree from parallel),
    /// others may be kept than those that the exact numbers tell. It is clear which where no column is left as small as that.
    pub(crate) fn base_columns(&self) -> BaseColumns<N> {
        // Half a megabyte for an arm of 32 joints: in place, and once.
        let mut columns = [[[[0.0; N]; STATES]; CANDIDATES]; N];
        self.stack(&mut columns);
        let mut kept = [[false; Parameter::COUNT]; N];
        let mut are_clear = true;
        for (i, kept) in kept.iter_mut().enumerate() {
            let (before, own) = columns.split_at_mut(i);
            for (place, parameter) in candidates(self.joints[i].kind).iter().enumerate() {
                let (earlier, rest) = own[0].split_at_mut(place);
                let column = &mut rest[0];
                // Twice is enough (Parlett). A column that was not kept is 0 by now.
                for _ in 0..2 {
                    before
                        .iter()
                        .flatten()
                        .chain(&*earlier)
                        .for_each(|unit| take_out(unit, column));
                }
                let length = Real::sqrt(dot(column, column));
                are_clear &= !(CLEARLY_DEPENDENT..=CLEARLY_INDEPENDENT).contains(&length);
                let is_kept = length > DEPENDENT;
                kept[parameter.index()] = is_kept;
                let factor = if is_kept { 1.0 / length } else { 0.0 };
                column
                    .as_flattened_mut()
                    .iter_mut()
                    .for_each(|x| *x *= factor);
            }
        }
        BaseColumns { kept, are_clear }
    }

    /// Y's columns at all states, relative to what their terms can amount to: of link i, with ℓ_i the longest distance of its origin
    /// from the base and A = |g| + ℓ_i, ℓ_i A for the mass, ℓ_i + A for first moments, 1 for the inertia, at rates of about 1.
    /// A force counts as the torque that it is at its joint's longest distance.
    fn stack(&self, columns: &mut [Block<N>; N]) {
        let gravity = Vector3::from(self.gravity).norm();
        let reach = self.reach();
        let state = |index: usize, which: usize| {
            SVector::from_fn(|i, _| spread((index * 3 + which) * N + i))
        };
        for index in 0..STATES {
            let (q, qd, qdd) = (state(index, 0) * 3.0, state(index, 1), state(index, 2));
            let regressor = self.regressor_at(&q, &qd, &qdd);
            for (i, (columns, block)) in columns.iter_mut().zip(&regressor).enumerate() {
                let field = gravity + reach[i];
                let sizes = [reach[i] * field, reach[i] + field, 1.0];
                let parameters = candidates(self.joints[i].kind).iter();
                for (parameter, own) in parameters.zip(columns) {
                    let size = sizes[parameter.degree()];
                    let column = block.column(parameter.index());
                    own[index] = core::array::from_fn(|j| {
                        let unit = match self.joints[j].kind {
                            JointKind::Revolute => 1.0,
                            JointKind::Prismatic => reach[j],
                        };
                        if size > 0.0 {
                            column[j] * unit / size
                        } else {
                            0.0
                        }
                    });
                }
            }
        }
    }

    /// How far each link's origin can be from the base's, a prismatic joint being a metre out, m.
    fn reach(&self) -> [f64; N] {
        let mut length = 0.0;
        self.joints.map(|joint| {
            length += joint.a.abs() + joint.d.abs();
            if joint.kind == JointKind::Prismatic {
                length += 1.0;
            }
            length
        })
    }
}

/// The columns that remain when what a joint's motion cannot change of its link's parameters is counted with the link before,
/// in the order of [`Parameter::BASE_ORDER`]. The others depend on those of the link before, and a revolute joint's Iyy on Ixx besides.
const fn candidates(kind: JointKind) -> &'static [Parameter] {
    use Parameter::{Ixx, Ixy, Ixz, Iyz, Izz, Mass, Mx, My, Mz};
    match kind {
        JointKind::Revolute => &[Ixx, Ixy, Ixz, Iyz, Izz, Mx, My],
        JointKind::Prismatic => &[Mx, My, Mz, Mass],
    }
}

/// Takes out of a column what lies along a unit one.
fn take_out<const N: usize>(unit: &Column<N>, column: &mut Column<N>) {
    let along = dot(unit, column);
    let pairs = column.as_flattened_mut().iter_mut();
    let pairs = pairs.zip(unit.as_flattened());
    pairs.for_each(|(x, unit)| *x -= along * unit);
}

fn dot<const N: usize>(a: &Column<N>, b: &Column<N>) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| a * b).sum()
}

/// The terms of a sequence that fills [−1, 1] evenly (Weyl: the squares times an irrational number, modulo 1).
fn spread(index: usize) -> f64 {
    let index = (index + 1) as f64;
    2.0 * ((index * index * core::f64::consts::SQRT_2) % 1.0) - 1.0
}
