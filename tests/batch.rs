//! Batches against the methods of `Arm`, to the bit, for any length.

use nalgebra::{IsometryMatrix3, SMatrix, SVector};
use ulna::internal::Quantity;
use ulna::proof::{State, states};
use ulna::{Arm, ArmBatch, LengthMismatch, SerialChain, Unrolled as _};
use ulna_generated::{Oblique6, Planar2r, Ssrms};
use wide::f64x4;

/// None, fewer than the lanes, as many, and few or many over.
const LENGTHS: [usize; 8] = [0, 1, 3, 4, 8, 11, 15, 33];

fn column<const N: usize, const K: usize>(
    all: &[State<N>],
    of: impl Fn(&State<N>) -> SVector<f64, K>,
) -> Vec<SVector<f64, K>> {
    all.iter().map(of).collect()
}

macro_rules! define_check {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        { kernel $($kernel:tt)+ }
        { batch $batch:ident from $width:literal }
        $({ $($rest:tt)* })*
    )+) => {
        /// Calls every batch and its single counterpart, and compares all results.
        fn every_method<const N: usize>(arm: &impl ArmBatch<N>, chain: &SerialChain<N>) {
            for length in LENGTHS {
                let all: Vec<State<N>> = states(chain).take(length).collect();
                $({
                    let mut out = vec![<$output>::zero(); length];
                    arm.$batch($(&column(&all, |state| state.$argument)),+, &mut out)
                        .expect("slices of one length");
                    for (state, result) in all.iter().zip(&out) {
                        let expected = arm.$method($(&state.$argument),+);
                        assert_eq!(*result, expected, "{} of {length}", stringify!($batch));
                    }
                })+
            }
        }
    };
}

ulna::methods! { [N] define_check {} }

#[test]
fn every_method_of_a_generated_arm() {
    every_method(&Planar2r, &Planar2r::CHAIN);
}

#[test]
fn every_method_of_the_generic_path() {
    every_method(&Planar2r::CHAIN, &Planar2r::CHAIN);
}

#[test]
fn gradient_of_the_ssrms() {
    let q = column(&states(&Ssrms::CHAIN).take(11).collect::<Vec<_>>(), |s| s.q);
    let mut out = vec![(1.0, SVector::zeros()); q.len()];
    let written = Ssrms.dynamic_manipulability_gradient_batch(&q, &mut out);
    assert_eq!(written, Ok(()));
    for (q, result) in q.iter().zip(&out) {
        assert_eq!(*result, Ssrms.dynamic_manipulability_gradient(q));
    }
}

#[test]
fn an_arm_with_a_prismatic_joint() {
    let q = column(
        &states(&Oblique6::CHAIN).take(11).collect::<Vec<_>>(),
        |s| s.q,
    );
    let mut poses = vec![IsometryMatrix3::identity(); q.len()];
    let mut masses = vec![SMatrix::<f64, 6, 6>::zeros(); q.len()];
    assert_eq!(Oblique6.forward_kinematics_batch(&q, &mut poses), Ok(()));
    assert_eq!(Oblique6.mass_matrix_batch(&q, &mut masses), Ok(()));
    for ((q, pose), mass) in q.iter().zip(&poses).zip(&masses) {
        assert_eq!(*pose, Oblique6.forward_kinematics(q));
        assert_eq!(*mass, Oblique6.mass_matrix(q));
    }
}

/// A kernel on other scalars: lanes of `wide`, and single precision.
#[test]
fn kernels_run_on_every_scalar() {
    let q = proof_configuration();
    let exact = Ssrms.mass_matrix_kernel::<f64>(&q);
    let lanes = Ssrms.mass_matrix_kernel::<f64x4>(&q.map(f64x4::splat));
    let single = Ssrms.mass_matrix_kernel::<f32>(&q.map(|x| x as f32));
    for (i, j) in (0..7).flat_map(|i| (0..7).map(move |j| (i, j))) {
        assert_eq!(lanes[i][j].to_array(), [exact[i][j]; 4]);
        let allowed = 1e-5 * exact[0][0];
        assert!((f64::from(single[i][j]) - exact[i][j]).abs() < allowed);
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
