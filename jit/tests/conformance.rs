//! Every arm of `arms/`: machine code against the textbook and the interpreter, method by method.

use std::fs;

use ulna::SerialChain;
use ulna::proof::{State, compare, compare_with, states};
use ulna_codegen::Interpreter;
use ulna_jit::Jit;
use ulna_table::Model;

fn prove<const N: usize>(name: &str) {
    let model = Model::load(format!("../arms/{name}.toml")).unwrap();
    let chain = SerialChain::<N>::try_from(&model).unwrap();
    let compiled = ulna_codegen::compile(&model);
    let jit = Jit::<N>::of(&model, &compiled).unwrap();
    let poses = || states(&chain).take(4).chain([State::default()]);
    let report = compare(&jit, &chain, poses());
    assert!(report.passes(), "{name}: {report}");
    let interpreter = Interpreter::<N>::of(&model, compiled).unwrap();
    let report = compare_with(&jit, &interpreter, &chain, poses());
    assert!(report.passes(), "{name}: {report}");
}

macro_rules! arms {
    ($($name:ident $joints:literal)+) => {
        $(
            #[test]
            fn $name() {
                prove::<$joints>(stringify!($name));
            }
        )+

        const PROVED: &[&str] = &[$(stringify!($name)),+];
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
    let mut names: Vec<String> = fs::read_dir("../arms")
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|it| it == "toml"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    assert_eq!(names, PROVED);
}
