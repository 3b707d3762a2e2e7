//! Among the ways to write an arm's formulas down: the cheapest that is exact enough.

use std::borrow::Cow;
use std::cell::LazyCell;

use ulna::{Method, MethodSet};
use ulna_table::Model;

use crate::accuracy::{Conditioned, TestStates};
use crate::formulate::chain::Chain;
use crate::formulate::{Choices, Chosen, IN_ORDER, depends_on, task};
use crate::graph::Graph;
use crate::schedule::{Program, schedule};
use crate::{MethodProgram, compile_on};

const GRADIENT: Method = Method::DynamicManipulabilityGradient;

/// The largest relative error that a program may have to be chosen for its few operations.
const EXACT: f64 = 1e-10;

/// Ways to w_D, each longer than those before: whether M's factors come from articulated bodies, and how often
/// H's rows are made orthogonal.
const WAYS: [(bool, usize); 4] = [(false, 2), (false, 3), (true, 2), (true, 3)];

/// Tries the Jacobian in every frame, for J itself and for w_D, and for w_D its rows in two orders;
/// what none of `methods` depends on is left as it is, and the states are not made if nothing is judged.
pub(super) fn choose(
    model: &Model,
    states: &LazyCell<TestStates, impl FnOnce() -> TestStates>,
    methods: MethodSet,
) -> Choices {
    let is_needed = |chosen| {
        methods
            .iter()
            .any(|method| depends_on(method).contains(&chosen))
    };
    let none = Choices {
        singular: is_needed(Chosen::Task) && states.singular_everywhere,
        ..Choices::default()
    };
    let world = is_needed(Chosen::World).then(|| of_jacobian(model, states, none));
    let task = is_needed(Chosen::Task).then(|| of_task(model, states, none));
    let meeting = is_needed(Chosen::Meeting).then(|| fewest_operations_at(model));
    let choices = Choices {
        meeting: meeting.unwrap_or(none.meeting),
        world: world.unwrap_or(none).world,
        ..task.unwrap_or(none)
    };
    let accelerations =
        is_needed(Chosen::Accelerations).then(|| of_accelerations(model, states, choices));
    accelerations.unwrap_or(choices)
}

/// The frames that J may be built in.
fn frames(model: &Model) -> impl Iterator<Item = usize> + Clone {
    0..=Chain::new(&Graph::without_labels(), model).groups.len()
}

fn of_jacobian(model: &Model, states: &TestStates, none: Choices) -> Choices {
    let worlds = frames(model).map(|world| Choices { world, ..none });
    let worlds = [worlds.collect()].into_iter();
    cheapest_that_is_exact(model, Method::GeometricJacobian, worlds, states).unwrap_or(none)
}

fn of_task(model: &Model, states: &TestStates, none: Choices) -> Choices {
    let frames = frames(model);
    let ways = WAYS.into_iter().map(|(articulated, passes)| {
        let in_frame = |task: usize| {
            let as_listed = Choices {
                world: task,
                task,
                articulated,
                passes,
                ..none
            };
            let order = longest_first(model, as_listed, states);
            [as_listed, Choices { order, ..as_listed }]
        };
        let mut all: Vec<Choices> = frames.clone().flat_map(in_frame).collect();
        all.dedup();
        all
    });
    cheapest_that_is_exact(model, GRADIENT, ways, states).unwrap_or(none)
}

/// Whether ∂q̈ should take what velocities do to τ from ∂τ/∂q̇.
fn of_accelerations(model: &Model, states: &TestStates, choices: Choices) -> Choices {
    let ways = [false, true].map(|by_slopes| Choices {
        by_slopes,
        ..choices
    });
    let ways = [ways.to_vec()].into_iter();
    cheapest_that_is_exact(model, Method::ForwardDynamicsDerivatives, ways, states)
        .unwrap_or(choices)
}

/// The joint at which twists and wrenches should meet in ∂τ: one of the outer half.
fn fewest_operations_at(model: &Model) -> usize {
    let joints = model.joints().len();
    let operations = |meeting: &usize| {
        let choices = Choices {
            meeting: *meeting,
            ..Choices::default()
        };
        let program = compile_on(
            &Graph::without_labels(),
            model,
            Method::InverseDynamicsDerivatives,
            choices,
        );
        program.steps.len()
    };
    (joints / 2..joints).min_by_key(operations).unwrap_or(0)
}

/// The order of the task's rows in which H's are longest first.
fn longest_first(model: &Model, choices: Choices, states: &TestStates) -> [usize; 6] {
    if choices.singular || model.task().len() == 1 {
        return choices.order;
    }
    let graph = Graph::without_labels();
    let lengths = task::squared_lengths(&Chain::new(&graph, model), choices);
    states.longest_first(&schedule(&graph, &lengths))
}

/// How exact w_D and ∇w_D are.
pub(super) fn conditioned(
    model: &Model,
    methods: &[MethodProgram],
    choices: Choices,
    states: &TestStates,
) -> Option<Conditioned> {
    let has_manipulability = |method: &MethodProgram| method.method.zero_where_singular().is_some();
    if choices.singular || !methods.iter().any(has_manipulability) {
        return None;
    }
    let gradient = match MethodProgram::of(methods, GRADIENT) {
        Some(found) => Cow::Borrowed(&found.program),
        None => Cow::Owned(compile_on(
            &Graph::without_labels(),
            model,
            GRADIENT,
            choices,
        )),
    };
    // W's rows are asked for in world axes, as the table names them.
    let as_listed = Choices {
        task: 0,
        order: IN_ORDER,
        ..choices
    };
    let graph = Graph::without_labels();
    let outputs = task::sensitivity(&Chain::new(&graph, model), as_listed);
    let sensitivity = schedule(&graph, &outputs);
    states.conditioned(model, &gradient, &sensitivity)
}

/// Of the first of `ways` in which a program's error is small enough, the choices of the shortest such program;
/// of all of them, those of the most exact program, if none is.
fn cheapest_that_is_exact(
    model: &Model,
    method: Method,
    ways: impl Iterator<Item = Vec<Choices>>,
    states: &TestStates,
) -> Option<Choices> {
    let mut most_exact: Option<(f64, Choices)> = None;
    for way in ways {
        let compiled = way.into_iter().map(|choices| {
            (
                choices,
                compile_on(&Graph::without_labels(), model, method, choices),
            )
        });
        let mut candidates: Vec<(Choices, Program)> = compiled.collect();
        // A stable sort: of programs of one length the first is kept.
        candidates.sort_by_key(|(_, program)| program.steps.len());
        for (choices, program) in &candidates {
            let error = states.error(program);
            if error <= EXACT {
                return Some(*choices);
            }
            if most_exact.is_none_or(|(least, _)| error < least) {
                most_exact = Some((error, *choices));
            }
        }
    }
    most_exact.map(|(_, choices)| choices)
}
