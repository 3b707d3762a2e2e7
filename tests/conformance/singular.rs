//! Where w_D is 0: exactly 0, with a zero gradient, although rounding leaves J of full rank there.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Rotation3, SVector, vector};
use ulna::proof::states;
use ulna::{Arm, Placement, SerialChain, TaskRows};
use ulna_generated::{Planar2r, Ssrms};

use crate::chain;

/// Stretched and folded: the tool, the elbow and the shoulder on one line.
fn planar_2r() -> Vec<SVector<f64, 2>> {
    let shoulders = [0.0, 0.7, -2.9];
    let elbows = [0.0, PI, -PI];
    let pairs = shoulders.map(|shoulder| elbows.map(|elbow| vector![shoulder, elbow]));
    pairs.into_iter().flatten().collect()
}

/// Quarter turns at which one line through the tool point meets, or is parallel to, every joint's axis.
fn ssrms() -> Vec<SVector<f64, 7>> {
    [
        [0, 0, 2, 0, 1],
        [0, 1, 0, 1, 1],
        [0, 1, 0, 3, 3],
        [0, 1, 2, 1, 1],
        [0, 2, 2, 2, 1],
    ]
    .into_iter()
    .map(|[q2, q3, q4, q5, q6]| {
        let [q2, q3, q4, q5, q6] = [q2, q3, q4, q5, q6].map(|turns| f64::from(turns) * FRAC_PI_2);
        vector![0.7, q2, q3, q4, q5, q6, -0.4]
    })
    .collect()
}

fn vanishes_at<const N: usize>(arm: &impl Arm<N>, poses: &[SVector<f64, N>]) {
    for q in poses {
        let (w, gradient) = arm.dynamic_manipulability_gradient(q);
        let (_, w_beside, gradient_beside) = arm.jacobian_and_gradient(q);
        assert_eq!(
            [arm.dynamic_manipulability(q), w, w_beside],
            [0.0; 3],
            "w_D at {q}"
        );
        assert_eq!(
            [gradient, gradient_beside],
            [SVector::<f64, N>::zeros(); 2],
            "gradient at {q}"
        );
        let kinematic = arm.manipulability_gradient(q);
        assert_eq!(kinematic, (0.0, SVector::zeros()), "w at {q}");
        assert_eq!(arm.task_space_inertia(q).amax(), 0.0, "Λ at {q}");
        let inverse = arm.dynamically_consistent_inverse(q);
        assert_eq!(inverse.amax(), 0.0, "J̄ at {q}");
    }
}

/// Hardly away, w_D is there again, and rises in proportion to the distance.
fn returns_beside<const N: usize>(arm: &impl Arm<N>, poses: &[SVector<f64, N>]) {
    for q in poses {
        let away = SVector::from_fn(|i, _| 1e-4 * (i + 1) as f64);
        let (w, gradient) = arm.dynamic_manipulability_gradient(&(q + away));
        assert!(w > 0.0, "w_D beside {q} is {w:e}");
        let slope = gradient.dot(&away) / w;
        assert!(
            (slope - 1.0).abs() < 0.1,
            "w_D beside {q} rises by {slope} of itself"
        );
    }
}

#[test]
fn planar_2r_stretched_or_folded() {
    vanishes_at(&chain::<2>("planar_2r"), &planar_2r());
    returns_beside(&chain::<2>("planar_2r"), &planar_2r());
    vanishes_at(&Planar2r, &planar_2r());
    returns_beside(&Planar2r, &planar_2r());
}

#[test]
fn ssrms_with_a_line_through_all_axes() {
    vanishes_at(&chain::<7>("ssrms"), &ssrms());
    returns_beside(&chain::<7>("ssrms"), &ssrms());
    vanishes_at(&Ssrms, &ssrms());
    returns_beside(&Ssrms, &ssrms());
}

/// A planar arm cannot move across its plane. With the base tilted, that is no row of zeros but three dependent ones,
/// to which every transform adds its rounding.
#[test]
fn planar_2r_with_a_full_position() {
    let flat = chain::<2>("planar_2r");
    let tilt = Rotation3::from_euler_angles(0.4, -1.1, 2.3);
    let tilted = Placement {
        rotation: core::array::from_fn(|r| core::array::from_fn(|c| tilt[(r, c)])),
        translation: [3.0, -20.0, 100.0],
    };
    for base in [flat.base, tilted] {
        let arm = SerialChain {
            task: TaskRows::POSITION,
            base,
            ..flat
        };
        let poses: Vec<_> = states(&arm).take(100).map(|state| state.q).collect();
        vanishes_at(&arm, &poses);
    }
}
