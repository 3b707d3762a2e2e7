//! Batches against the methods of `Arm`, to the bit, for any length.

use nalgebra::{IsometryMatrix3, SMatrix, SVector};
use ulna::proof::{State, states};
use ulna::{Arm, ArmBatch, LengthMismatch, Unrolled as _};
use ulna_generated::{Oblique6, Planar2r, Ssrms};
use wide::{f32x8, f64x8};

/// None, fewer than the lanes, as many, and few or many over.
const LENGTHS: [usize; 8] = [0, 1, 3, 4, 8, 11, 15, 33];

fn column<const N: usize>(
    all: &[State<N>],
    of: impl Fn(&State<N>) -> SVector<f64, N>,
) -> Vec<SVector<f64, N>> {
    all.iter().map(of).collect()
}

/// Calls a batch method and its single counterpart, and compares all results.
macro_rules! same {
    ($arm:expr, $chain:expr, $n:literal, $batch:ident, $method:ident($($field:ident),+), $zero:expr) => {
        for length in LENGTHS {
            let all: Vec<State<$n>> = states(&$chain).take(length).collect();
            let mut out = vec![$zero; length];
            $arm.$batch($(&column(&all, |state| state.$field)),+, &mut out)
                .expect("slices of one length");
            for (state, result) in all.iter().zip(&out) {
                assert_eq!(*result, $arm.$method($(&state.$field),+), "{} of {length}", stringify!($batch));
            }
        }
    };
}

macro_rules! every_method {
    ($arm:expr, $chain:expr, $n:literal) => {{
        let (vector, square) = (SVector::<f64, $n>::zeros(), SMatrix::<f64, $n, $n>::zeros());
        let jacobian = SMatrix::<f64, 6, $n>::zeros();
        same!(
            $arm,
            $chain,
            $n,
            forward_kinematics_batch,
            forward_kinematics(q),
            IsometryMatrix3::identity()
        );
        same!(
            $arm,
            $chain,
            $n,
            geometric_jacobian_batch,
            geometric_jacobian(q),
            jacobian
        );
        same!(
            $arm,
            $chain,
            $n,
            jacobian_derivatives_batch,
            jacobian_derivatives(q),
            [jacobian; $n]
        );
        same!($arm, $chain, $n, mass_matrix_batch, mass_matrix(q), square);
        same!(
            $arm,
            $chain,
            $n,
            mass_matrix_derivatives_batch,
            mass_matrix_derivatives(q),
            [square; $n]
        );
        same!(
            $arm,
            $chain,
            $n,
            dynamic_manipulability_batch,
            dynamic_manipulability(q),
            1.0
        );
        same!(
            $arm,
            $chain,
            $n,
            dynamic_manipulability_gradient_batch,
            dynamic_manipulability_gradient(q),
            (1.0, vector)
        );
        same!(
            $arm,
            $chain,
            $n,
            inverse_dynamics_batch,
            inverse_dynamics(q, qd, qdd),
            vector
        );
        same!(
            $arm,
            $chain,
            $n,
            bias_force_batch,
            bias_force(q, qd),
            vector
        );
        same!(
            $arm,
            $chain,
            $n,
            gravity_torque_batch,
            gravity_torque(q),
            vector
        );
        same!(
            $arm,
            $chain,
            $n,
            forward_dynamics_batch,
            forward_dynamics(q, qd, tau),
            vector
        );
        same!(
            $arm,
            $chain,
            $n,
            mass_matrix_and_derivatives_batch,
            mass_matrix_and_derivatives(q),
            (square, [square; $n])
        );
        same!(
            $arm,
            $chain,
            $n,
            jacobian_and_gradient_batch,
            jacobian_and_gradient(q),
            (jacobian, 1.0, vector)
        );
    }};
}

#[test]
fn every_method_of_a_generated_arm() {
    every_method!(Planar2r, Planar2r::CHAIN, 2);
}

#[test]
fn every_method_of_the_generic_path() {
    every_method!(Planar2r::CHAIN, Planar2r::CHAIN, 2);
}

#[test]
fn gradient_of_the_ssrms() {
    let zero = (1.0, SVector::<f64, 7>::zeros());
    same!(
        Ssrms,
        Ssrms::CHAIN,
        7,
        dynamic_manipulability_gradient_batch,
        dynamic_manipulability_gradient(q),
        zero
    );
}

#[test]
fn an_arm_with_a_prismatic_joint() {
    let identity = IsometryMatrix3::identity();
    same!(
        Oblique6,
        Oblique6::CHAIN,
        6,
        forward_kinematics_batch,
        forward_kinematics(q),
        identity
    );
    let zero = SMatrix::<f64, 6, 6>::zeros();
    same!(
        Oblique6,
        Oblique6::CHAIN,
        6,
        mass_matrix_batch,
        mass_matrix(q),
        zero
    );
}

/// A kernel on other scalars: lanes of `wide`, and single precision.
#[test]
fn kernels_run_on_every_scalar() {
    let q = proof_configuration();
    let exact = Ssrms::mass_matrix_kernel::<f64>(&q);
    let lanes = Ssrms::mass_matrix_kernel::<f64x8>(&q.map(f64x8::splat));
    let single = Ssrms::mass_matrix_kernel::<f32>(&q.map(|x| x as f32));
    let single_lanes = Ssrms::mass_matrix_kernel::<f32x8>(&q.map(|x| f32x8::splat(x as f32)));
    for (i, j) in (0..7).flat_map(|i| (0..7).map(move |j| (i, j))) {
        assert_eq!(lanes[i][j].to_array(), [exact[i][j]; 8]);
        let allowed = 1e-5 * exact[0][0];
        assert!((f64::from(single[i][j]) - exact[i][j]).abs() < allowed);
        for lane in single_lanes[i][j].to_array() {
            assert!((f64::from(lane) - exact[i][j]).abs() < allowed);
        }
    }
}

fn proof_configuration() -> [f64; 7] {
    let state = states(&Ssrms::CHAIN).next().expect("states without end");
    state.q.into()
}

#[test]
fn singular_tasks_are_settled_lane_by_lane() {
    let regular = SVector::<f64, 2>::new(0.3, 0.7);
    let stretched = SVector::<f64, 2>::zeros();
    let q = [regular, stretched, regular, stretched, stretched];
    let mut out = [(1.0, SVector::zeros()); 5];
    Planar2r
        .dynamic_manipulability_gradient_batch(&q, &mut out)
        .expect("slices of one length");
    for (q, result) in q.iter().zip(out) {
        assert_eq!(result, Planar2r.dynamic_manipulability_gradient(q));
        assert_eq!(result.0 == 0.0, *q == stretched);
    }
}

/// A slice of another length is named, and nothing is written, by either backend.
#[test]
fn slices_of_different_lengths_are_an_error() {
    fn refuses(arm: &impl ArmBatch<2>) {
        let zero = SVector::<f64, 2>::zeros();
        let (three, five) = ([zero; 3], [zero; 5]);
        let untouched = SVector::repeat(7.0);
        let mut out = [untouched; 4];
        let mismatch = |slice, length| LengthMismatch {
            states: 3,
            slice,
            length,
        };
        let results = [
            arm.inverse_dynamics_batch(&three, &five, &three, &mut out[..3]),
            arm.inverse_dynamics_batch(&three, &three, &[], &mut out[..3]),
            arm.forward_dynamics_batch(&three, &three, &five, &mut out),
            arm.gravity_torque_batch(&three, &mut out),
            arm.gravity_torque_batch(&three, &mut out[..2]),
        ];
        let slices = [("qd", 5), ("qdd", 0), ("tau", 5), ("out", 4), ("out", 2)];
        assert_eq!(
            results,
            slices.map(|(slice, length)| Err(mismatch(slice, length)))
        );
        assert_eq!(out, [untouched; 4]);
    }
    refuses(&Planar2r);
    refuses(&Planar2r::CHAIN);
    let mismatch = LengthMismatch {
        states: 3,
        slice: "out",
        length: 4,
    };
    assert_eq!(
        mismatch.to_string(),
        "`out` has 4 entries in a batch of 3 states"
    );
}
