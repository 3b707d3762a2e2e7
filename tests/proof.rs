//! `proof::compare` finds what is wrong, and only that.

use ulna::nalgebra::{IsometryMatrix3, SMatrix, SVector, Translation3};
use ulna::proof::{Deviation, State, compare, differences, states};
use ulna::{Angle, Arm, Joint, JointKind, Link, Placement, SerialChain, TaskRow, TaskRows};
use ulna_generated::{Planar2r, Ssrms};

const fn joint(kind: JointKind, a: f64) -> Joint {
    Joint {
        kind,
        alpha: Angle::from_radians(0.3),
        a,
        theta: Angle::from_radians(-0.2),
        d: 0.4,
        rated_torque: Some(10.0),
        link: Link {
            mass: 2.0,
            com: [0.1, 0.2, -0.3],
            inertia: [[0.3, 0.01, 0.0], [0.01, 0.2, 0.02], [0.0, 0.02, 0.25]],
        },
    }
}

const CHAIN: SerialChain<3> = SerialChain {
    joints: [
        joint(JointKind::Revolute, 0.0),
        joint(JointKind::Prismatic, 0.5),
        joint(JointKind::Revolute, 0.7),
    ],
    base: Placement::IDENTITY,
    tool: Placement {
        translation: [0.2, 0.1, 0.3],
        ..Placement::IDENTITY
    },
    gravity: [0.0, 1.0, -9.81],
    task: TaskRows::new(&[TaskRow::X, TaskRow::Z]),
};

/// The chain, with one method off by a relative `error`.
struct Off {
    method: &'static str,
    error: f64,
}

impl Off {
    fn factor(&self, method: &str) -> f64 {
        if method == self.method {
            1.0 + self.error
        } else {
            1.0
        }
    }
}

type Vector = SVector<f64, 3>;

impl Arm<3> for Off {
    fn task(&self) -> TaskRows {
        match self.method {
            "task" => TaskRows::POSE,
            _ => CHAIN.task(),
        }
    }

    fn rated_torque(&self) -> Vector {
        CHAIN.rated_torque() * self.factor("rated_torque")
    }

    fn forward_kinematics(&self, q: &Vector) -> IsometryMatrix3<f64> {
        let pose = CHAIN.forward_kinematics(q);
        let away = pose.translation.vector * self.factor("forward_kinematics");
        IsometryMatrix3::from_parts(Translation3::from(away), pose.rotation)
    }

    fn geometric_jacobian(&self, q: &Vector) -> SMatrix<f64, 6, 3> {
        CHAIN.geometric_jacobian(q) * self.factor("geometric_jacobian")
    }

    fn jacobian_derivatives(&self, q: &Vector) -> [SMatrix<f64, 6, 3>; 3] {
        CHAIN
            .jacobian_derivatives(q)
            .map(|dj| dj * self.factor("jacobian_derivatives"))
    }

    fn mass_matrix(&self, q: &Vector) -> SMatrix<f64, 3, 3> {
        CHAIN.mass_matrix(q) * self.factor("mass_matrix")
    }

    fn mass_matrix_derivatives(&self, q: &Vector) -> [SMatrix<f64, 3, 3>; 3] {
        CHAIN
            .mass_matrix_derivatives(q)
            .map(|dm| dm * self.factor("mass_matrix_derivatives"))
    }

    fn dynamic_manipulability(&self, q: &Vector) -> f64 {
        CHAIN.dynamic_manipulability(q) * self.factor("dynamic_manipulability")
    }

    fn dynamic_manipulability_gradient(&self, q: &Vector) -> (f64, Vector) {
        let (w, gradient) = CHAIN.dynamic_manipulability_gradient(q);
        (w, gradient * self.factor("dynamic_manipulability_gradient"))
    }

    fn inverse_dynamics(&self, q: &Vector, qd: &Vector, qdd: &Vector) -> Vector {
        CHAIN.inverse_dynamics(q, qd, qdd) * self.factor("inverse_dynamics")
    }

    fn bias_force(&self, q: &Vector, qd: &Vector) -> Vector {
        CHAIN.bias_force(q, qd) * self.factor("bias_force")
    }

    fn gravity_torque(&self, q: &Vector) -> Vector {
        CHAIN.gravity_torque(q) * self.factor("gravity_torque")
    }

    fn forward_dynamics(&self, q: &Vector, qd: &Vector, tau: &Vector) -> Vector {
        CHAIN.forward_dynamics(q, qd, tau) * self.factor("forward_dynamics")
    }

    fn mass_matrix_and_derivatives(
        &self,
        q: &Vector,
    ) -> (SMatrix<f64, 3, 3>, [SMatrix<f64, 3, 3>; 3]) {
        let (m, dm) = CHAIN.mass_matrix_and_derivatives(q);
        (
            m,
            dm.map(|dm| dm * self.factor("mass_matrix_and_derivatives")),
        )
    }

    fn jacobian_and_gradient(&self, q: &Vector) -> (SMatrix<f64, 6, 3>, f64, Vector) {
        let (j, w, gradient) = CHAIN.jacobian_and_gradient(q);
        (j, w * self.factor("jacobian_and_gradient"), gradient)
    }
}

#[test]
fn an_arm_agrees_with_itself() {
    let report = compare(&CHAIN, &CHAIN, states(&CHAIN).take(20));
    assert!(report.passes(), "{report}");
    assert_eq!(report.states, 20);
}

macro_rules! generated {
    ($(($Type:ident, $name:ident, $n:literal))*) => {
        $(
            #[test]
            fn $name() {
                let chain = ulna_generated::$Type::CHAIN;
                let report = compare(&ulna_generated::$Type, &chain, states(&chain).take(25));
                println!("{}\n{report}", stringify!($name));
                assert!(report.passes(), "{report}");
            }
        )*
    };
}

/// Every generated arm does what the textbook does.
mod generated_agrees_with_generic {
    use super::{compare, states};

    ulna_generated::for_each_arm!(generated);
}

/// No method of any backend allocates, and neither does the comparison.
#[test]
fn nothing_is_allocated() {
    let pairs = || states(&Ssrms::CHAIN).take(2);
    let allocated = allocation_counter::measure(|| {
        let report = compare(&Ssrms, &Ssrms::CHAIN, pairs());
        assert_eq!(report.states, 2);
    });
    assert_eq!(allocated.count_total, 0);
}

#[test]
fn no_states_prove_nothing() {
    assert!(!compare(&CHAIN, &CHAIN, []).passes());
}

#[test]
fn an_error_is_found_where_it_is() {
    let methods = compare(&CHAIN, &CHAIN, [])
        .deviations
        .map(|deviation| deviation.method);
    for method in methods {
        for error in [1e-6, f64::NAN] {
            let report = compare(&Off { method, error }, &CHAIN, states(&CHAIN).take(5));
            let wrong: Vec<_> = report
                .deviations
                .iter()
                .filter(|deviation| !deviation.passes())
                .collect();
            assert_eq!(wrong.len(), 1, "{report}");
            assert_eq!(wrong[0].method, method, "{report}");
            assert!(report.to_string().contains("WRONG"), "{report}");
        }
    }
}

#[test]
fn states_are_reproducible_and_within_their_ranges() {
    let first: Vec<_> = states(&CHAIN).take(50).collect();
    assert!(states(&CHAIN).take(50).eq(first.iter().copied()));
    let spread = |i: usize| {
        first
            .iter()
            .fold(0.0_f64, |max, state| max.max(state.q[i].abs()))
    };
    assert!(
        spread(0) > 2.0 && spread(0) <= core::f64::consts::PI,
        "a revolute joint turns all round"
    );
    assert!(
        spread(1) > 0.5 && spread(1) <= 1.0,
        "a prismatic joint stays within a metre"
    );
}

#[test]
fn right_derivatives_are_close_to_differences() {
    let deviations = differences::compare(
        &Planar2r,
        &Planar2r::CHAIN,
        states(&Planar2r::CHAIN).take(50),
    );
    assert!(deviations.iter().all(Deviation::passes), "{deviations:?}");
    assert!(deviations.iter().all(|deviation| deviation.error > 0.0));
}

#[test]
fn derivatives_are_compared_where_they_vanish_and_beside_the_kink_of_w_d() {
    for elbow in [0.0, 1e-9, 3e-6, 2e-4, 1e-2] {
        let state = State {
            q: SVector::from([0.7, elbow]),
            qd: SVector::zeros(),
            qdd: SVector::zeros(),
            tau: SVector::zeros(),
        };
        for deviation in differences::compare(&Planar2r, &Planar2r::CHAIN, [state].into_iter()) {
            assert!(deviation.passes(), "{elbow}: {deviation:?}");
        }
    }
}
