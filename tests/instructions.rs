//! Every set of instructions of the machine: batches are single calls to the bit, whatever their length.
//!
//! One test, since the choice of instructions is the whole program's.

use std::fmt::Debug;

use ulna::Instructions;
use ulna::nalgebra::{IsometryMatrix3, SMatrix, SVector};
use ulna::proof::states;
use ulna::{Arm, ArmBatch, LengthMismatch};
use ulna_generated::Oblique6;

type Q = SVector<f64, 6>;

/// Every rest of a division by the lanes' widths.
const LENGTHS: std::ops::RangeInclusive<usize> = 0..=17;

fn same<T: Clone + PartialEq + Debug>(
    q: &[Q],
    zero: &T,
    batch: impl Fn(&[Q], &mut [T]) -> Result<(), LengthMismatch>,
    single: impl Fn(&Q) -> T,
) {
    let expected: Vec<T> = q.iter().map(single).collect();
    for length in LENGTHS {
        let mut out = vec![zero.clone(); length];
        assert_eq!(batch(&q[..length], &mut out), Ok(()));
        assert_eq!(out, expected[..length], "{:?}", Instructions::in_use());
    }
}

#[test]
fn batches_are_single_calls_on_every_set() {
    let mut q: Vec<Q> = states(&Oblique6::CHAIN)
        .map(|s| s.q)
        .take(*LENGTHS.end())
        .collect();
    // Absurd coordinates take another way.
    q[9] *= 1e9;
    let (vector, square) = (Q::zeros(), SMatrix::<f64, 6, 6>::zeros());
    let all = [
        Instructions::Avx512,
        Instructions::Avx2,
        Instructions::Compiled,
    ];
    for set in all {
        set.limit();
        assert_eq!(Instructions::in_use(), set.min(Instructions::of_machine()));
        let arm = Oblique6;
        same(
            &q,
            &IsometryMatrix3::identity(),
            |q, out| arm.forward_kinematics_batch(q, out),
            |q| arm.forward_kinematics(q),
        );
        same(
            &q,
            &square,
            |q, out| arm.mass_matrix_batch(q, out),
            |q| arm.mass_matrix(q),
        );
        same(
            &q,
            &[square; 6],
            |q, out| arm.mass_matrix_derivatives_batch(q, out),
            |q| arm.mass_matrix_derivatives(q),
        );
        same(
            &q,
            &(1.0, vector),
            |q, out| arm.dynamic_manipulability_gradient_batch(q, out),
            |q| arm.dynamic_manipulability_gradient(q),
        );
        same(
            &q,
            &vector,
            |q, out| arm.forward_dynamics_batch(q, q, q, out),
            |q| arm.forward_dynamics(q, q, q),
        );
    }
}
