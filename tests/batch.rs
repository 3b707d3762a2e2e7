//! Batches against the methods of `Arm`, to the bit, for any length.

use nalgebra::{IsometryMatrix3, SMatrix, SVector};
use ulna::proof::{State, states};
use ulna::{Arm, ArmBatch, SerialChain, Unrolled as _};
use ulna_generated::{Oblique6, Planar2r, Ssrms};
use wide::{f32x8, f64x8};

/// None, fewer than the lanes, as many, and some over.
const LENGTHS: [usize; 7] = [0, 1, 3, 4, 8, 11, 33];

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
            $arm.$batch($(&column(&all, |state| state.$field)),+, &mut out);
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
    Planar2r.dynamic_manipulability_gradient_batch(&q, &mut out);
    for (q, result) in q.iter().zip(out) {
        assert_eq!(result, Planar2r.dynamic_manipulability_gradient(q));
        assert_eq!(result.0 == 0.0, *q == stretched);
    }
}

#[test]
fn the_shorter_length_counts() {
    let q = [SVector::<f64, 2>::zeros(); 3];
    let mut out = [SMatrix::<f64, 2, 2>::zeros(); 5];
    Planar2r.mass_matrix_batch(&q, &mut out);
    assert_eq!(out[2], Planar2r.mass_matrix(&q[0]));
    assert_eq!(out[3], SMatrix::<f64, 2, 2>::zeros());
    let chain: SerialChain<2> = Planar2r::CHAIN;
    chain.mass_matrix_batch(&q, &mut out[..1]);
    assert_eq!(out[0], chain.mass_matrix(&q[0]));
}
