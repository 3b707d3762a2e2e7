//! Base parameters: as many as the stacked regressor has independent columns, and τ follows from them alone.

use std::fmt::Write as _;
use std::path::Path;

use nalgebra::{DMatrix, SVector};
use ulna::{Arm as _, Parameter, SerialChain, proof};
use ulna_codegen::internal::{
    Arguments, Chain, Choices, Columns, Graph, Scalar, formulate, schedule,
};
use ulna_codegen::{BaseParameters, Generator, Interpreter, Program};
use ulna_table::Model;

/// Random numbers that are the same on every machine.
struct Random(ulna::internal::random::SplitMix64);

impl Random {
    fn symmetric(&mut self) -> f64 {
        self.0.symmetric()
    }

    fn vector(&mut self, length: usize) -> Vec<f64> {
        (0..length).map(|_| self.symmetric()).collect()
    }

    fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        let place = (self.symmetric() + 1.0) / 2.0 * choices.len() as f64;
        choices[(place as usize).min(choices.len() - 1)]
    }
}

fn random(seed: u64) -> Random {
    Random(ulna::internal::random::SplitMix64::new(seed))
}

/// Y as a program, in full or its base columns.
fn program(model: &Model, method: ulna::Method) -> Program {
    let base = BaseParameters::of(model);
    let columns = base.list().iter().map(|base| (base.link, base.parameter));
    let choices = Choices {
        base: Columns::of(columns),
        ..Choices::default()
    };
    let graph = Graph::new();
    let chain = Chain::new(&graph, model);
    schedule(&graph, &formulate(method, &chain, choices))
}

/// The regressor at a random state, N×10N.
fn regressor(program: &Program, joints: usize, random: &mut Random) -> DMatrix<f64> {
    let q: Vec<f64> = random.vector(joints).iter().map(|x| 3.0 * x).collect();
    let (qd, qdd) = (random.vector(joints), random.vector(joints));
    let numbers = f64::run(
        program,
        Arguments {
            q: &q,
            qd: &qd,
            qdd: &qdd,
            ..Arguments::default()
        },
    );
    DMatrix::from_column_slice(joints, Parameter::COUNT * joints, &numbers)
}

fn parameters(model: &Model) -> Vec<[f64; Parameter::COUNT]> {
    let links = model.joints().iter().map(|joint| &joint.link);
    links.map(ulna::Link::parameters).collect()
}

/// What a stack of regressors says of an arm: the singular values on either side of the rank.
struct Gap {
    least: f64,
    next: f64,
}

/// Checks the base parameters of an arm.
fn examine(model: &Model) -> Gap {
    let joints = model.joints().len();
    let base = BaseParameters::of(model);
    let count = base.list().len();
    let all = program(model, ulna::Method::Regressor);
    let kept = program(model, ulna::Method::BaseRegressor);
    let mut states = random(7);
    let stack: Vec<DMatrix<f64>> = (0..30)
        .map(|_| regressor(&all, joints, &mut states))
        .collect();
    let mut stacked = DMatrix::zeros(30 * joints, Parameter::COUNT * joints);
    for (index, block) in stack.iter().enumerate() {
        stacked
            .view_mut((index * joints, 0), (joints, Parameter::COUNT * joints))
            .copy_from(block);
    }
    // Every column in units of its own: what counts is whether they depend on each other.
    for mut column in stacked.column_iter_mut() {
        let length = column.norm();
        if length > 1e-12 {
            column /= length;
        }
    }
    let mut values: Vec<f64> = stacked.singular_values().iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values.push(0.0);
    let gap = Gap {
        least: values[count - 1] / values[0],
        next: values[count] / values[0],
    };

    let own = parameters(model);
    let flat: Vec<f64> = own.concat();
    let base_values = base.values(&own);
    let mut states = random(7);
    for full in stack {
        let part = regressor(&kept, joints, &mut states);
        let mut torque = DMatrix::zeros(joints, 1);
        for (parameter, value) in base.list().iter().zip(&base_values) {
            let column = parameter.link * Parameter::COUNT + parameter.parameter.index();
            torque += part.column(column) * *value;
            let difference = part.column(column) - full.column(column);
            assert!(difference.amax() <= 1e-13 * full.column(column).amax().max(1.0));
        }
        let columns = part.column_iter().filter(|column| column.amax() > 0.0);
        assert!(columns.count() <= count);
        let sizes =
            full.map(f64::abs) * DMatrix::from_vec(flat.len(), 1, flat.clone()).map(f64::abs);
        let expected = &full * DMatrix::from_vec(flat.len(), 1, flat.clone());
        let error = (&torque - &expected).amax();
        assert!(
            error <= 1e-12 * sizes.amax(),
            "{error:e} of {:e}\n{base}",
            sizes.amax()
        );
    }
    gap
}

fn of_the_house(arm: &str) -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../arms/{arm}.toml"));
    Model::load(path).unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn arms_have_as_many_as_their_regressor_has_independent_columns() {
    for (arm, count) in [
        ("planar_2r", 6),
        ("ssrms", 0),
        ("oblique_6", 0),
        ("table1_literal", 0),
    ] {
        let model = of_the_house(arm);
        let found = BaseParameters::of(&model).list().len();
        let Gap { least, next } = examine(&model);
        println!("{arm:16} {found:3} base parameters; singular values {least:.1e} | {next:.1e}");
        assert!(count == 0 || count == found);
        assert!(least > 1e-6 && next < 1e-13, "{arm}: {least:e} {next:e}");
    }
}

/// Arms of parallel and square axes, sliding joints, no gravity or some: all that keeps links from moving freely.
fn random_arm(random: &mut Random) -> Model {
    let mut table =
        String::from("name = \"random_arm\"\nconvention = \"modified\"\nangle_unit = \"deg\"\n");
    let gravity = random.of(&[
        "[0.0, 0.0, 0.0]",
        "[0.0, 0.0, -9.81]",
        "[0.0, -9.81, 0.0]",
        "[3.0, 2.0, -9.0]",
    ]);
    writeln!(table, "gravity = {gravity}\n[task]\nrows = [\"x\"]").unwrap();
    let joints = random.of(&[1, 2, 3, 4, 5, 6]);
    for _ in 0..joints {
        let kind = random.of(&["revolute", "revolute", "prismatic"]);
        let alpha = random.of(&[0.0, 0.0, 90.0, -90.0, 180.0, 35.0]);
        let theta = random.of(&[0.0, 90.0, 20.0]);
        let [a, d] = [0, 1].map(|_| random.of(&[0.0, 0.0, 0.3, -0.7]));
        writeln!(
            table,
            "[[joint]]\nkind = \"{kind}\"\ntheta = {theta:?}\nd = {d:?}\na = {a:?}\nalpha = {alpha:?}\n[joint.link]\nmass = 2.0\n\
             com = [0.1, 0.02, 0.03]\ninertia = {{ xx = 0.02, yy = 0.03, zz = 0.025, xy = 0.001, xz = 0.002, yz = 0.003 }}",
        )
        .unwrap();
    }
    Model::parse(&table, "random").unwrap_or_else(|errors| panic!("{errors}\n{table}"))
}

#[test]
fn random_arms_have_as_many_as_their_regressor_has_independent_columns() {
    let mut random = random(1);
    let (mut least_of_all, mut largest_rest) = (1.0_f64, 0.0_f64);
    for _ in 0..100 {
        let model = random_arm(&mut random);
        let Gap { least, next } = examine(&model);
        let base = BaseParameters::of(&model);
        assert!(
            least > 1e-7 && next < 1e-12,
            "{least:e} {next:e} {:?}\n{base}",
            model
                .joints()
                .iter()
                .map(|joint| (joint.kind, joint.alpha, joint.a, joint.d))
                .collect::<Vec<_>>()
        );
        (least_of_all, largest_rest) = (least_of_all.min(least), largest_rest.max(next));
    }
    println!("singular values {least_of_all:.1e} | {largest_rest:.1e}");
}

#[test]
fn what_is_grouped_is_readable() {
    println!("{}\n", BaseParameters::of(&of_the_house("ssrms")));
    println!("{}\n", BaseParameters::of(&of_the_house("oblique_6")));
    println!("{}", BaseParameters::of(&of_the_house("table1_literal")));
    let base = BaseParameters::of(&of_the_house("planar_2r"));
    insta::assert_snapshot!(base);
}

/// The textbook decides in doubles, on the stack, and finds the same columns: of the longest arm too.
#[test]
fn the_textbook_finds_the_same_columns_of_the_longest_arm() {
    let mut table = String::from(
        "name = \"long_arm\"\nconvention = \"modified\"\nangle_unit = \"deg\"\n[task]\nrows = [\"x\"]\n",
    );
    for joint in 0..32 {
        let alpha = [0.0, 90.0, 35.0][joint % 3];
        writeln!(
            table,
            "[[joint]]\ntheta = 10.0\nd = 0.1\na = 0.2\nalpha = {alpha:?}\n[joint.link]\nmass = 2.0\n\
             com = [0.1, 0.02, 0.03]\ninertia = {{ xx = 0.02, yy = 0.03, zz = 0.025 }}",
        )
        .unwrap();
    }
    let model = Model::parse(&table, "long").unwrap_or_else(|errors| panic!("{errors}"));
    let chain = SerialChain::<32>::try_from(&model).expect("32 joints");
    let q = SVector::from_fn(|i, _| 0.1 * (i + 1) as f64);
    let blocks = chain.base_regressor(&q, &q, &q);
    let kept = (0..32).flat_map(|link| Parameter::ALL.map(|parameter| (link, parameter)));
    let kept =
        kept.filter(|(link, parameter)| blocks[*link].column(parameter.index()).amax() > 0.0);
    let base = BaseParameters::of(&model);
    let listed = base.list().iter().map(|base| (base.link, base.parameter));
    assert_eq!(kept.collect::<Vec<_>>(), listed.collect::<Vec<_>>());
}

/// A base turned by π as files have it, in some digits: gravity is then along the first axis but for the rest. Which columns depend on
/// each other is decided in doubles by the textbook, with more digits by the generator; neither is wrong.
#[test]
fn rounded_turns_are_no_disagreement() {
    for pi in ["3.141592653589793", "3.14159265359", "3.14159265", "3.1416"] {
        let mut table = format!(
            "name = \"rounded\"\nconvention = \"modified\"\nangle_unit = \"rad\"\ngravity = [0.0, 0.0, -9.81]\n\
             [task]\nrows = \"position\"\n[base]\nrpy = [0.0, {pi}, 0.0]\n"
        );
        for (a, alpha) in [("0.0", "0.0"), ("0.0", "1.57079632679"), ("0.4", "0.0")] {
            writeln!(
                table,
                "[[joint]]\ntheta = 0.0\nd = 0.1\na = {a}\nalpha = {alpha}\n[joint.link]\nmass = 1.0\ncom = [0.2, 0.01, 0.02]\n\
                 inertia = {{ xx = 0.01, yy = 0.012, zz = 0.009 }}"
            )
            .unwrap();
        }
        let model = Model::parse(&table, "rounded.toml").unwrap();
        let generator = Generator::new().methods(&[ulna::Method::BaseRegressor]);
        let emitted = Interpreter::<3>::of(&model, generator.compile(&model)).unwrap();
        let chain = SerialChain::<3>::try_from(&model).unwrap();
        let states = proof::states(&chain).take(10);
        let report = proof::compare(&emitted, &chain, states).of(generator.chosen());
        assert!(report.passes(), "{pi}: {report}");
    }
}
