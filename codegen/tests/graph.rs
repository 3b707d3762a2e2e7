//! Properties of graph, derivatives and schedule under random expressions.

use proptest::prelude::*;
use ulna_codegen::internal::{Expr, Graph, reverse, schedule};
use ulna_codegen::{AngleSum, DoubleDouble, Input, Op, Operand, Output, Program};

const JOINTS: usize = 3;

/// An expression as it is written, before any folding.
#[derive(Clone, Debug)]
enum Tree {
    Constant(f64),
    Input(Input),
    Add(Box<Tree>, Box<Tree>),
    Sub(Box<Tree>, Box<Tree>),
    Mul(Box<Tree>, Box<Tree>),
    Neg(Box<Tree>),
    /// `a / (b² + 1)`: never by zero.
    Quotient(Box<Tree>, Box<Tree>),
    /// `√(a² + 1)`: never of a negative number.
    Root(Box<Tree>),
}

/// The joints that each angle of the tests adds up.
fn angle(index: usize) -> AngleSum {
    let joints = [vec![0], vec![1], vec![1, 2]][index].clone();
    let offset = [0.0, 0.3, 0.0][index].into();
    AngleSum { joints, offset }
}

fn tree() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        prop::sample::select(vec![0.0, 1.0, -1.0, 2.0, -0.5, 0.25]).prop_map(Tree::Constant),
        (0..JOINTS).prop_map(|i| Tree::Input(Input::Sin(i))),
        (0..JOINTS).prop_map(|i| Tree::Input(Input::Cos(i))),
        (0..JOINTS).prop_map(|i| Tree::Input(Input::Q(i))),
        (0..JOINTS).prop_map(|i| Tree::Input(Input::Qd(i))),
    ];
    leaf.prop_recursive(6, 64, 2, |inner| {
        let one = inner.clone().prop_map(Box::new);
        let two = (one.clone(), one.clone());
        prop_oneof![
            two.clone().prop_map(|(a, b)| Tree::Add(a, b)),
            two.clone().prop_map(|(a, b)| Tree::Sub(a, b)),
            two.clone().prop_map(|(a, b)| Tree::Mul(a, b)),
            two.prop_map(|(a, b)| Tree::Quotient(a, b)),
            one.clone().prop_map(Tree::Neg),
            one.prop_map(Tree::Root),
        ]
    })
}

fn read(input: Input, angle: impl Fn(usize) -> AngleSum, q: &[f64; JOINTS]) -> f64 {
    let value = |index| angle(index).at(|i| q[i], DoubleDouble::to_f64);
    match input {
        Input::Q(i) => q[i],
        Input::Sin(index) => value(index).sin(),
        Input::Cos(index) => value(index).cos(),
        Input::Qd(i) => 0.7 - i as f64,
        Input::Qdd(_) | Input::Tau(_) | Input::Wrench(_) | Input::Payload(_) => 0.0,
    }
}

impl Tree {
    fn value(&self, q: &[f64; JOINTS]) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Input(input) => read(*input, angle, q),
            Self::Add(a, b) => a.value(q) + b.value(q),
            Self::Sub(a, b) => a.value(q) - b.value(q),
            Self::Mul(a, b) => a.value(q) * b.value(q),
            Self::Neg(a) => -a.value(q),
            Self::Quotient(a, b) => a.value(q) / (b.value(q) * b.value(q) + 1.0),
            Self::Root(a) => (a.value(q) * a.value(q) + 1.0).sqrt(),
        }
    }

    fn on<'g>(&self, graph: &'g Graph) -> Expr<'g> {
        let one = graph.constant(1.0);
        match self {
            Self::Constant(value) => graph.constant(*value),
            Self::Input(Input::Sin(i)) => graph.sin_cos(&angle(*i)).0,
            Self::Input(Input::Cos(i)) => graph.sin_cos(&angle(*i)).1,
            Self::Input(input) => graph.input(*input),
            Self::Add(a, b) => a.on(graph) + b.on(graph),
            Self::Sub(a, b) => a.on(graph) - b.on(graph),
            Self::Mul(a, b) => a.on(graph) * b.on(graph),
            Self::Neg(a) => -a.on(graph),
            Self::Quotient(a, b) => {
                let b = b.on(graph);
                a.on(graph) / (b * b + one)
            }
            Self::Root(a) => {
                let a = a.on(graph);
                (a * a + one).sqrt()
            }
        }
    }
}

fn program<'g>(graph: &'g Graph, elements: Vec<Expr<'g>>) -> Program {
    let output = Output::new("values", &[elements.len()], elements);
    schedule(graph, &[output])
}

fn evaluate(program: &Program, q: &[f64; JOINTS]) -> Vec<f64> {
    program.evaluate(DoubleDouble::to_f64, |input, angles| {
        read(input, |index| angles[index].clone(), q)
    })
}

/// Relative to the sizes that rounding acts on.
fn close(a: f64, b: f64) -> bool {
    !b.is_finite() || (a - b).abs() <= 1e-9 * (1.0 + a.abs().max(b.abs()))
}

fn coordinates() -> impl Strategy<Value = [f64; JOINTS]> {
    prop::array::uniform3(-2.0..2.0)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn folding_and_scheduling_keep_the_value(tree in tree(), q in coordinates()) {
        let graph = Graph::new();
        let value = evaluate(&program(&graph, vec![tree.on(&graph)]), &q)[0];
        prop_assert!(close(value, tree.value(&q)), "{value} is not {}", tree.value(&q));
    }

    #[test]
    fn derivatives_are_difference_quotients(tree in tree(), q in coordinates()) {
        let graph = Graph::new();
        let root = tree.on(&graph);
        let gradient = reverse(&graph, &[(root, graph.constant(1.0))], JOINTS);
        let gradient = evaluate(&program(&graph, gradient), &q);
        for (joint, derivative) in gradient.into_iter().enumerate() {
            let at = |step: f64| {
                let mut shifted = q;
                shifted[joint] += step;
                tree.value(&shifted)
            };
            let quotient = |h: f64| (at(h) - at(-h)) / (2.0 * h);
            // Richardson's extrapolation of two central differences.
            let expected = (4.0 * quotient(5e-4) - quotient(1e-3)) / 3.0;
            let scale = 1.0 + at(0.0).abs() + expected.abs();
            prop_assume!((quotient(1e-3) - quotient(5e-4)).abs() < 1e-4 * scale);
            prop_assert!((derivative - expected).abs() < 1e-6 * scale, "{derivative} is not {expected}");
        }
    }

    #[test]
    fn seeds_weigh_the_derivatives_of_several_expressions(a in tree(), b in tree(), q in coordinates()) {
        let graph = Graph::new();
        let (a, b) = (a.on(&graph), b.on(&graph));
        let (one, seeds) = (graph.constant(1.0), [graph.constant(2.0), graph.input(Input::Qd(0))]);
        let together = reverse(&graph, &[(a, seeds[0]), (b, seeds[1])], JOINTS);
        let apart = [a, b].map(|root| reverse(&graph, &[(root, one)], JOINTS));
        for (joint, together) in together.into_iter().enumerate() {
            let sum = seeds[0] * apart[0][joint] + seeds[1] * apart[1][joint];
            let values = evaluate(&program(&graph, vec![together, sum]), &q);
            prop_assert!(close(values[0], values[1]), "joint {joint}: {values:?}");
        }
    }

    #[test]
    fn a_program_has_no_step_too_many(trees in prop::collection::vec(tree(), 1..4)) {
        let graph = Graph::new();
        let roots = trees.iter().map(|tree| tree.on(&graph)).collect();
        let program = program(&graph, roots);
        let mut used = vec![false; program.steps.len()];
        let mut mark = |operand: Operand, before: usize| {
            if let Operand::Step(index) = operand {
                assert!(index < before, "step {index} is used before it is there");
                used[index] = true;
            }
        };
        for (index, step) in program.steps.iter().enumerate() {
            mark(step.a, index);
            mark(step.b, index);
            assert!(!program.steps[..index].contains(step), "{step:?} stands twice");
            let is_number = |operand| matches!(operand, Operand::Constant(_));
            assert!(!(is_number(step.a) && is_number(step.b)), "{step:?} could be folded");
        }
        for output in &program.outputs {
            for element in &output.elements {
                mark(*element, program.steps.len());
            }
        }
        prop_assert!(used.iter().all(|used| *used), "dead code");
    }
}

#[test]
fn neutral_and_absorbing_operands_fold_away() {
    let graph = Graph::new();
    let (x, zero, one) = (
        graph.input(Input::Q(0)),
        graph.constant(0.0),
        graph.constant(1.0),
    );
    let rules = [
        ("x + 0", x + zero, x),
        ("x - 0", x - zero, x),
        ("0 - x", zero - x, -x),
        ("x * 1", x * one, x),
        ("x * 0", x * zero, zero),
        ("0 / x", zero / x, zero),
        ("x - x", x - x, zero),
        ("-(-x)", -(-x), x),
        ("x + x", x + x, graph.constant(2.0) * x),
        ("(-x)(-x)", (-x) * (-x), x * x),
        ("x + (-x)", x + (-x), zero),
        ("(x + 1) + 1", (x + one) + one, x + graph.constant(2.0)),
        ("2 (2 x)", (x + x) + (x + x), graph.constant(4.0) * x),
    ];
    for (rule, folded, expected) in rules {
        assert_eq!(folded, expected, "{rule}");
    }
}

#[test]
fn every_operator_builds_what_its_row_computes() {
    for op in Op::ALL {
        let graph = Graph::new();
        let (a, b) = (graph.input(Input::Q(0)), graph.input(Input::Q(1)));
        let built = match op {
            Op::Add => a + b,
            Op::Sub => a - b,
            Op::Mul => a * b,
            Op::Div => a / b,
            Op::Neg => -a,
            Op::Sqrt => a.sqrt(),
        };
        let program = program(&graph, vec![built]);
        let value = evaluate(&program, &[1.5, 0.5, 0.0])[0];
        assert_eq!(value, op.apply(1.5, 0.5), "{}", op.row().name);
    }
}
