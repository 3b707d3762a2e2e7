//! The C code of every arm: compiled without a warning, and the same numbers as the programs that it is printed from.

mod process;

use std::collections::BTreeSet;

use nalgebra::SVector;
use ulna::internal::numbers;
use ulna::proof::{State, compare, payload, states};
use ulna::{Arm, Method, SerialChain};
use ulna_codegen::{COptions, Generator, Interpreter, Precision};
use ulna_table::Model;

use process::CArm;

/// So short that every arm but the planar ones has methods in parts.
const SHORT: usize = 100;

macro_rules! arms {
    ($($name:ident $n:literal)+) => {
        const ARMS: &[&str] = &[$(stringify!($name)),+];

        $(
            #[test]
            fn $name() {
                agrees::<$n>(stringify!($name));
            }
        )+
    };
}

arms! {
    franka_panda 7
    geared_6 6
    gen3 7
    iiwa_14 7
    oblique_6 6
    planar_2r 2
    planar_3r 3
    puma_560 6
    ssrms 7
    stanford_arm 6
    table1_literal 7
    ur5e 6
}

#[test]
fn no_arm_is_left_out() {
    let entries = std::fs::read_dir("../arms").expect("the folder of arm tables");
    let paths = entries.map(|entry| entry.expect("readable").path());
    let tables = paths.filter(|path| path.extension().is_some_and(|x| x == "toml"));
    let names: BTreeSet<String> = tables
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    assert!(names.iter().eq(ARMS.iter()), "{names:?}");
}

fn load(name: &str) -> Model {
    Model::load(format!("../arms/{name}.toml")).unwrap_or_else(|errors| panic!("{errors}"))
}

fn chain_of<const N: usize>(model: &Model) -> SerialChain<N> {
    SerialChain::try_from(model).unwrap_or_else(|error| panic!("{error}"))
}

fn agrees<const N: usize>(name: &str) {
    let model = load(name);
    let chain = chain_of::<N>(&model);
    let interpreter = Interpreter::<N>::new(&model).unwrap_or_else(|error| panic!("{error}"));
    let options = COptions::new();

    let c = CArm::new(
        &model,
        interpreter.compiled(),
        options.function_length(SHORT),
    );
    let report = compare(&c, &chain, states(&chain).take(20));
    assert!(report.passes(), "{report}");
    for state in states(&chain).take(20).chain(folded()) {
        same(&c, &interpreter, &state);
    }
    // Coordinates so large that they are read as others: the angle is found in another way, and may differ in its last digits.
    let report = compare(&c, &chain, absurd(&chain));
    assert!(report.passes(), "{report}");

    let single = options.precision(Precision::Float);
    let c = CArm::new(&model, interpreter.compiled(), single);
    for state in states(&chain).take(5) {
        near(&c, &interpreter, &state);
    }
}

/// Poses that most arms are singular at: stretched, folded, at right angles.
fn folded<const N: usize>() -> impl Iterator<Item = State<N>> {
    let quarter = std::f64::consts::FRAC_PI_2;
    (0..12).map(move |number: u32| State {
        q: SVector::from_fn(|i, _| quarter * f64::from((number >> (i % 4)) % 3)),
        ..State::default()
    })
}

/// States whose coordinates are absurd.
fn absurd<const N: usize>(chain: &SerialChain<N>) -> impl Iterator<Item = State<N>> {
    let sizes = [17.0, 1e3, -1e6, 1e15, -1e300];
    states(chain).zip(sizes).map(|(state, size)| State {
        q: state.q * size,
        ..state
    })
}

/// Where sines are those of the same library, and nothing is fused, the same operations give the same bits; elsewhere a few ulp.
const ULP: f64 = if cfg!(all(
    target_os = "linux",
    target_env = "gnu",
    target_arch = "x86_64"
)) {
    0.0
} else {
    64.0
};

/// Both give the same numbers, but for so many [`ULP`] of the largest.
fn same<const N: usize>(c: &CArm<N>, interpreter: &Interpreter<N>, state: &State<N>) {
    for method in Method::ALL {
        for [ours, theirs, largest] in pairs(c, interpreter, *method, state) {
            let difference = (ours - theirs).abs();
            assert!(
                difference <= ULP * f64::EPSILON * largest,
                "{method}: {ours:e} for {theirs:e}, {:.1} ulp of the largest",
                difference / largest / f64::EPSILON
            );
        }
    }
}

/// In single precision errors are those of double precision on another scale. What was measured there is relative to the largest entry,
/// which for a single number, as an energy, may come near 0 itself.
fn near<const N: usize>(c: &CArm<N>, interpreter: &Interpreter<N>, state: &State<N>) {
    let epsilon = f64::from(f32::EPSILON);
    for method in &interpreter.compiled().methods {
        let allowed = 8.0 * (method.error * epsilon / f64::EPSILON).max(epsilon);
        for [ours, theirs, largest] in pairs(c, interpreter, method.method, state) {
            assert!(
                (ours - theirs).abs() <= allowed * largest,
                "{}: {ours:e} for {theirs:e}, {:.1e} of the largest, {allowed:.1e} allowed",
                method.method,
                (ours - theirs).abs() / largest
            );
        }
    }
}

/// What both return, number by number, and the largest number.
fn pairs<const N: usize>(
    c: &impl Arm<N>,
    other: &impl Arm<N>,
    method: Method,
    state: &State<N>,
) -> impl Iterator<Item = [f64; 3]> {
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    numbers(c, method, state, |x| ours.push(x));
    numbers(other, method, state, |x| theirs.push(x));
    let largest = theirs
        .iter()
        .fold(0.0_f64, |largest, x| largest.max(x.abs()));
    ours.into_iter()
        .zip(theirs)
        .map(move |(ours, theirs)| [ours, theirs, largest])
}

/// What an arm carries, in its C code as in the textbook; the C function that reads it too.
#[test]
fn a_payload_is_carried() {
    let model = load("geared_6");
    let chain = chain_of::<6>(&model);
    let load = payload(&chain);
    let compiled = Generator::new().compile(&model);
    let mut c = CArm::new(&model, &compiled, COptions::new());
    c.carry(&load);
    let report = compare(&c, &chain.carrying(&load), states(&chain).take(20));
    assert!(report.passes(), "{report}");
}

/// What is infinite or no number stays that, and is not called singular.
#[test]
fn what_is_no_configuration_has_no_results() {
    let model = load("planar_2r");
    let c = CArm::<2>::new(&model, &Generator::new().compile(&model), COptions::new());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let q = SVector::from([0.3, bad]);
        let (w, gradient) = c.dynamic_manipulability_gradient(&q);
        assert!(w.is_nan() && gradient.iter().any(|x| x.is_nan()), "{bad}");
        let pose = c.forward_kinematics(&q);
        assert!(pose.translation.vector.iter().any(|x| x.is_nan()), "{bad}");
    }
}
