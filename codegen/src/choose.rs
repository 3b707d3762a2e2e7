//! Among the ways to write an arm's formulas down: the cheapest that is exact enough.

use ulna::Model;

use crate::accuracy::{Conditioned, Yardstick};
use crate::formulate::chain::Chain;
use crate::formulate::{self, Choices, IN_ORDER, QUANTITIES};
use crate::graph::Graph;
use crate::schedule::{Program, schedule};
use crate::{Method, compile_quantity};

const GRADIENT: &str = "dynamic_manipulability_gradient";

/// The largest relative error that a program may have to be chosen for its few operations.
const EXACT: f64 = 1e-10;

/// Tries the Jacobian in every frame, for J itself and for w_D, and for w_D its rows in two orders.
pub(super) fn choose(model: &Model, yardstick: &Yardstick) -> Choices {
    let none = Choices {
        singular: yardstick.singular_everywhere,
        ..Choices::default()
    };
    let groups = Chain::new(&Graph::new(), model).groups.len();
    let best = |method: &str, choices: &dyn Fn(usize) -> Vec<Choices>| {
        let quantity = QUANTITIES.iter().find(|quantity| quantity.method == method);
        let mut all: Vec<Choices> = (0..=groups).flat_map(choices).collect();
        all.dedup();
        let program = |choices: Choices| Some(compile_quantity(model, quantity?, choices));
        let candidates = all
            .into_iter()
            .filter_map(|choices| Some((choices, program(choices)?)));
        cheapest_that_is_exact(candidates.collect(), yardstick).unwrap_or(none)
    };
    let world = best("geometric_jacobian", &|world| {
        vec![Choices { world, ..none }]
    })
    .world;
    let task = best(GRADIENT, &|task| {
        let as_listed = Choices {
            world: task,
            task,
            ..none
        };
        let longest_first = Choices {
            order: longest_first(model, as_listed, yardstick),
            ..as_listed
        };
        let by_articulated_bodies = [as_listed, longest_first].map(|choices| Choices {
            articulated: true,
            ..choices
        });
        [[as_listed, longest_first], by_articulated_bodies].concat()
    });
    Choices { world, ..task }
}

/// The order of the task's rows in which H's are longest first.
fn longest_first(model: &Model, choices: Choices, yardstick: &Yardstick) -> [usize; 6] {
    if choices.singular || model.task.len() == 1 {
        return choices.order;
    }
    let graph = Graph::new();
    let lengths = formulate::squared_lengths(&Chain::new(&graph, model), choices);
    yardstick.longest_first(&schedule(&graph, &lengths))
}

/// How exact w_D and ∇w_D are.
pub(super) fn conditioned(
    model: &Model,
    methods: &[Method],
    choices: Choices,
    yardstick: &Yardstick,
) -> Option<Conditioned> {
    let gradient = methods.iter().find(|method| method.name == GRADIENT)?;
    if choices.singular {
        return None;
    }
    // W's rows are asked for in world axes, as the table names them.
    let as_listed = Choices {
        task: 0,
        order: IN_ORDER,
        ..choices
    };
    let graph = Graph::new();
    let outputs = formulate::sensitivity(&Chain::new(&graph, model), as_listed);
    let sensitivity = schedule(&graph, &outputs);
    yardstick.conditioned(model, &gradient.program, &sensitivity)
}

/// The choices of the shortest program among those whose error is small enough; of the most exact one, if none is.
fn cheapest_that_is_exact(
    mut candidates: Vec<(Choices, Program)>,
    yardstick: &Yardstick,
) -> Option<Choices> {
    // A stable sort: of programs of one length the first is kept.
    candidates.sort_by_key(|(_, program)| program.steps.len());
    let mut most_exact: Option<(f64, Choices)> = None;
    for (choices, program) in &candidates {
        let error = yardstick.error(program);
        if error <= EXACT {
            return Some(*choices);
        }
        if most_exact.is_none_or(|(least, _)| error < least) {
            most_exact = Some((error, *choices));
        }
    }
    most_exact.map(|(_, choices)| choices)
}
