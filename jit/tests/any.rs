//! What callers see who learn the number of joints at run time: shapes, batches, payloads, refusals, memory, threads.

use std::fs;
use std::thread;

use ulna::internal::numbers;
use ulna::nalgebra::Vector2;
use ulna::proof::{self, State, states};
use ulna::{Argument, Arm, Method, Payload, PayloadError};
use ulna_codegen::{Generator, Input, Operand};
use ulna_generated::{Geared6, Planar2r};
use ulna_jit::{AnyJit, CallError, Error, Jit};
use ulna_table::Model;

fn model(name: &str) -> Model {
    Model::load(format!("../arms/{name}.toml")).unwrap_or_else(|errors| panic!("{errors}"))
}

fn planar() -> AnyJit {
    AnyJit::compile(&model("planar_2r")).unwrap()
}

fn of<A: Arm<N>, const N: usize>(arm: &A, method: Method, state: &State<N>) -> Vec<f64> {
    let mut all = Vec::new();
    numbers(arm, method, state, |number| all.push(number));
    all
}

/// The arguments of a method, from a state.
fn arguments<const N: usize>(method: Method, state: &State<N>) -> Vec<Vec<f64>> {
    let slice = |argument: &Argument| match argument {
        Argument::Q => state.q.as_slice().to_vec(),
        Argument::Qd => state.qd.as_slice().to_vec(),
        Argument::Qdd => state.qdd.as_slice().to_vec(),
        Argument::Tau => state.tau.as_slice().to_vec(),
        Argument::Wrench => state.wrench.as_slice().to_vec(),
    };
    method.arguments().iter().map(slice).collect()
}

#[test]
fn slices_hold_what_the_arm_returns_alone_and_in_batches() {
    let any = planar();
    let arm = Jit::<2>::new(any.clone()).unwrap();
    let states: Vec<State<2>> = states(&Planar2r::CHAIN).take(5).collect();
    for method in Method::ALL {
        let length = any.length(*method);
        let mut expected = Vec::new();
        let mut batch: Vec<Vec<f64>> = vec![Vec::new(); method.arguments().len()];
        for state in &states {
            let own = arguments(*method, state);
            let slices: Vec<&[f64]> = own.iter().map(Vec::as_slice).collect();
            let mut result = vec![f64::NAN; length];
            any.call(*method, &slices, &mut result).unwrap();
            assert_eq!(result, of(&arm, *method, state), "{method}");
            expected.extend(result);
            for (all, own) in batch.iter_mut().zip(own) {
                all.extend(own);
            }
        }
        let slices: Vec<&[f64]> = batch.iter().map(Vec::as_slice).collect();
        let mut results = vec![f64::NAN; length * states.len()];
        any.call_batch(*method, &slices, &mut results).unwrap();
        assert_eq!(results, expected, "{method}");
        any.call_batch(*method, &vec![&[][..]; slices.len()], &mut [])
            .unwrap();
    }
}

#[test]
fn shapes_are_those_that_users_see() {
    let any = planar();
    let expected: [(Method, &[&[usize]]); 9] = [
        (Method::ForwardKinematics, &[&[3, 3], &[3]]),
        (Method::LinkPoses, &[&[2, 3, 4]]),
        (Method::GeometricJacobian, &[&[6, 2]]),
        (Method::JacobianDerivatives, &[&[2, 6, 2]]),
        (Method::KineticEnergy, &[&[]]),
        (Method::InverseDynamics, &[&[2]]),
        (Method::Regressor, &[&[2, 2, 10]]),
        (Method::DynamicallyConsistentInverse, &[&[2, 6]]),
        (Method::DynamicManipulabilityGradient, &[&[], &[2]]),
    ];
    for (method, shape) in expected {
        assert_eq!(any.shape(method), shape, "{method}");
    }
    assert_eq!(any.length(Method::ForwardKinematics), 12);
    assert_eq!((any.name(), any.joints()), ("planar_2r", 2));
    assert_eq!(any.methods(), ulna::MethodSet::ALL);
}

#[test]
fn a_singular_task_has_no_gradient() {
    let arm = Jit::<2>::new(planar()).unwrap();
    let zero = (0.0, Vector2::zeros());
    let q = Vector2::new(0.3, 0.0);
    assert_eq!(arm.dynamic_manipulability_gradient(&q), zero);
    let (jacobian, w, gradient) = arm.jacobian_and_gradient(&q);
    assert!((w, gradient) == zero && jacobian.norm() > 1.0);
    let (w, gradient) = arm.dynamic_manipulability_gradient(&Vector2::new(0.3, 0.1));
    assert!(w > 0.0 && gradient.norm() > 0.0);
    let nowhere = arm.mass_matrix(&Vector2::new(0.0, f64::INFINITY));
    assert!(nowhere.iter().any(|entry| entry.is_nan()));
}

#[test]
fn a_payload_is_carried_where_the_table_allows_one() {
    let bare = AnyJit::compile(&model("geared_6")).unwrap();
    let payload = proof::payload(&Geared6::CHAIN);
    let arm = Jit::<6>::new(bare.carrying(&payload).unwrap()).unwrap();
    let also = Jit::<6>::new(bare.clone())
        .unwrap()
        .carrying(&payload)
        .unwrap();
    let generated = Geared6::carrying(payload).unwrap();
    for state in states(&Geared6::CHAIN).take(3) {
        for method in [
            Method::MassMatrix,
            Method::InverseDynamics,
            Method::ForwardDynamics,
        ] {
            let expected = of(&generated, method, &state);
            assert_eq!(of(&arm, method, &state), expected);
            assert_eq!(of(&also, method, &state), expected);
            assert_ne!(of(&Geared6::default(), method, &state), expected);
        }
    }
    assert_eq!(bare.payload(), Payload::NONE);
    let heavy = Payload::new(1e6, [0.0; 3], [[0.0; 3]; 3]).unwrap();
    assert_eq!(
        bare.carrying(&heavy).err(),
        Geared6::CHAIN.admit(&heavy).err()
    );
    assert_eq!(
        planar().carrying(&payload).err(),
        Some(PayloadError::NotAtRunTime)
    );
    assert!(planar().carrying(&Payload::NONE).is_ok());
}

#[test]
fn what_does_not_fit_is_refused_and_nothing_is_written() {
    let any = planar();
    let method = Method::InverseDynamics;
    let two: &[f64] = &[0.1, 0.2];
    let mut result = [7.0; 2];
    let refused = |arguments: &[&[f64]], result: &mut [f64]| {
        let alone = any.call(method, arguments, result).unwrap_err();
        assert_eq!(
            any.call_batch(method, arguments, result),
            Err(alone.clone())
        );
        alone.to_string()
    };
    assert_eq!(
        refused(&[two, &[0.1], two], &mut result),
        "`qd` has 1 numbers, where 2 are needed"
    );
    assert_eq!(
        refused(&[two, two, two], &mut result[..1]),
        "`result` has 1 numbers, where 2 are needed"
    );
    assert_eq!(
        refused(&[two, two], &mut result),
        "`inverse_dynamics` takes 3 arguments, not 2"
    );
    assert_eq!(result, [7.0; 2]);
    assert!(matches!(
        Jit::<3>::compile(&model("planar_2r")),
        Err(Error::Joints(_))
    ));
}

#[test]
fn what_is_not_compiled_is_refused_or_left_to_the_textbook() {
    let model = model("planar_2r");
    let compiled = Generator::new()
        .methods(&[Method::MassMatrix])
        .compile(&model);
    let arm = Jit::<2>::of(&model, &compiled).unwrap();
    let refused = arm
        .any()
        .call(Method::GravityTorque, &[&[0.0; 2]], &mut [0.0; 2]);
    assert_eq!(refused, Err(CallError::NotCompiled(Method::GravityTorque)));
    let q = Vector2::new(0.3, 0.4);
    assert_eq!(arm.gravity_torque(&q), Planar2r::CHAIN.gravity_torque(&q));
}

/// Programs are public, and may be anything.
#[test]
fn a_program_of_another_arm_is_refused() {
    let foreign = ulna_codegen::compile(&model("planar_3r"));
    let refused = AnyJit::of(&model("planar_2r"), &foreign);
    assert!(matches!(refused, Err(Error::Program { .. })), "{refused:?}");
    let operands = [
        Operand::Step(0),
        Operand::Input(Input::Q(2)),
        Operand::Input(Input::Sin(9)),
        Operand::Input(Input::Tau(0)),
    ];
    for operand in operands {
        let mut broken = Generator::new()
            .methods(&[Method::MassMatrix])
            .compile(&model("planar_2r"));
        broken.methods[0].program.steps[0].a = operand;
        let refused = AnyJit::of(&model("planar_2r"), &broken);
        assert!(
            matches!(refused, Err(Error::Program { .. })),
            "{operand:?}: {refused:?}"
        );
    }
}

/// No page of this process, all code in memory among them, is writable and executable at once.
#[cfg(target_os = "linux")]
#[test]
fn no_page_is_writable_and_executable() {
    let any = planar();
    let maps = fs::read_to_string("/proc/self/maps").unwrap();
    let rights: Vec<(&str, &str)> = maps
        .lines()
        .filter_map(|line| Some((line.split(' ').nth(1)?, line.split(' ').next_back()?)))
        .collect();
    assert!(
        rights
            .iter()
            .all(|(rights, _)| !(rights.contains('w') && rights.contains('x')))
    );
    let in_memory = rights
        .iter()
        .filter(|(rights, name)| rights.contains('x') && name.is_empty());
    assert!(in_memory.count() > 0, "{maps}");
    drop(any);
}

#[test]
fn clones_run_in_threads_and_outlive_the_first() {
    let first = planar();
    let expected = of(
        &Jit::<2>::new(first.clone()).unwrap(),
        Method::MassMatrix,
        &State::default(),
    );
    let threads: Vec<_> = (0..4)
        .map(|_| {
            let (any, expected) = (first.clone(), expected.clone());
            thread::spawn(move || {
                for _ in 0..1000 {
                    let mut result = [0.0; 4];
                    any.call(Method::MassMatrix, &[&[0.0; 2]], &mut result)
                        .unwrap();
                    assert_eq!(result, *expected);
                }
            })
        })
        .collect();
    drop(first);
    for thread in threads {
        thread.join().unwrap();
    }
}
