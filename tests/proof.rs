//! `proof::compare` finds what is wrong, and only that.

use ulna::internal::Quantity;
use ulna::nalgebra::SVector;
use ulna::proof::{State, compare, differences, states};
use ulna::{
    Angle, Arm, Friction, Joint, JointKind, Limits, Link, Method, Motor, Placement, SerialChain,
    TaskRow, TaskRows,
};
use ulna_generated::{Planar2r, Ssrms};

const fn joint(kind: JointKind, a: f64) -> Joint {
    Joint {
        kind,
        alpha: Angle::from_radians(0.3),
        a,
        theta: Angle::from_radians(-0.2),
        d: 0.4,
        rated_torque: Some(10.0),
        limits: Limits::NONE,
        motor: Motor {
            inertia: 1e-4,
            ratio: 80.0,
        },
        friction: Friction {
            viscous: 0.5,
            coulomb: 2.0,
            ..Friction::NONE
        },
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

macro_rules! define_off {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        $({ $($rest:tt)* })*
    )+) => {
        impl Arm<3> for Off {
            fn task(&self) -> TaskRows {
                match self.method {
                    "task" => TaskRows::POSE,
                    _ => CHAIN.task(),
                }
            }

            fn rated_torque(&self) -> SVector<f64, 3> {
                CHAIN.rated_torque() * self.factor("rated_torque")
            }

            $(
                fn $method(&self, $($argument: &ulna::argument_type!([3] $argument)),+) -> $output {
                    let mut result = CHAIN.$method($($argument),+);
                    let last = result.part_mut(<$output>::PARTS - 1);
                    last.iter_mut().for_each(|x| *x *= self.factor(stringify!($method)));
                    result
                }
            )+
        }
    };
}

ulna::methods! { [3] define_off {} }

#[test]
fn an_arm_agrees_with_itself() {
    let report = compare(&CHAIN, &CHAIN, states(&CHAIN).take(20));
    assert!(report.passes(), "{report}");
    assert_eq!(report.states(), 20);
}

macro_rules! generated {
    ($(($Type:ident, $name:ident, $n:literal))*) => {
        $(
            #[test]
            fn $name() {
                let chain = ulna_generated::$Type::CHAIN;
                let report = compare(&ulna_generated::$Type::default(), &chain, states(&chain).take(25));
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
        assert_eq!(report.states(), 2);
    });
    assert_eq!(allocated.count_total, 0);
}

#[test]
fn no_states_prove_nothing() {
    assert!(!compare(&CHAIN, &CHAIN, []).passes());
}

#[test]
fn an_error_is_found_where_it_is() {
    let none = compare(&CHAIN, &CHAIN, []);
    let methods = none.deviations().iter().map(|deviation| deviation.method);
    assert_eq!(methods.len(), Method::ALL.len() + 2);
    for method in methods {
        for error in [1e-6, f64::NAN] {
            let report = compare(&Off { method, error }, &CHAIN, states(&CHAIN).take(5));
            let wrong: Vec<_> = report
                .deviations()
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
    let chain = Planar2r::CHAIN;
    let report = differences::compare(&Planar2r, &chain, states(&chain).take(50));
    assert!(report.passes(), "{report}");
    assert_eq!(report.deviations().len(), 3);
    assert!(report.deviations().iter().all(|line| line.error > 0.0));
}

#[test]
fn derivatives_are_compared_where_they_vanish_and_beside_the_kink_of_w_d() {
    for elbow in [0.0, 1e-9, 3e-6, 2e-4, 1e-2] {
        let state = State {
            q: SVector::from([0.7, elbow]),
            ..State::default()
        };
        let report = differences::compare(&Planar2r, &Planar2r::CHAIN, [state]);
        assert!(report.passes(), "{elbow}: {report}");
    }
}
