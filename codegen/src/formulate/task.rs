//! What is computed of the task's rows of J: w_D with its gradient, and what tells how exact they are.

use ulna::{TaskRow, TaskRows};

use super::chain::Chain;
use super::kinematics::{jacobian_in_group, jacobian_in_world};
use super::manipulability::{self, Manipulability};
use super::mass_matrix::mass_matrix;
use super::{Choices, Outputs, articulated};
use crate::graph::Expr;
use crate::schedule::{Output, Size};

/// w_D, ∇w_D, and det(JJᵀ) over the task's rows.
pub(super) fn manipulability_and_gradient<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let found = find(chain, choices);
    let gradient = Output::new("gradient", &[chain.joint_count()], found.gradient);
    vec![
        number("value", found.value),
        gradient.relative_to(Size::LargestOrBefore),
        number("volume", found.volume_squared).relative_to(Size::Any),
    ]
}

/// w_D, and det(JJᵀ) over the task's rows.
pub(super) fn manipulability_alone<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let found = find(chain, choices);
    vec![
        number("value", found.value),
        number("volume", found.volume_squared).relative_to(Size::Any),
    ]
}

fn find<'g>(chain: &Chain<'g>, choices: Choices) -> Manipulability<'g> {
    let rows = || task_rows(chain, choices);
    if choices.singular {
        Manipulability::zero(chain.graph.constant(0.0), chain.joint_count())
    } else if choices.articulated {
        let factors = articulated::factors(chain);
        manipulability::manipulability_by_factors(&rows(), &factors, choices.passes)
    } else {
        manipulability::manipulability(&rows(), &mass_matrix(chain), choices.passes)
    }
}

pub(super) fn number<'g>(name: &'static str, value: Expr<'g>) -> Output<Expr<'g>> {
    Output::new(name, &[], vec![value])
}

/// w_D does not change when all of a triplet of J's rows is turned; a task of whole triplets may be taken in any axes.
fn is_of_whole_triplets(task: TaskRows) -> bool {
    [
        TaskRows::POSITION,
        TaskRows::POSE,
        TaskRows::new(&TaskRow::ALL[3..]),
    ]
    .contains(&task)
}

/// The task's rows of J in world axes, in the order that is chosen, each with its place in J.
pub(super) fn task_rows_in_world<'g>(
    chain: &Chain<'g>,
    choices: Choices,
) -> Vec<(usize, Vec<Expr<'g>>)> {
    let columns = jacobian_in_world(chain, choices.world);
    let row = |row: TaskRow| {
        let components = columns.iter().map(|twist| twist.components()[row.index()]);
        (row.index(), components.collect())
    };
    let rows: Vec<_> = chain.task.iter().map(row).collect();
    let order = choices.order.iter().filter_map(|place| rows.get(*place));
    order.cloned().collect()
}

/// The task's rows of J, in whatever axes are chosen.
pub(super) fn task_rows<'g>(chain: &Chain<'g>, choices: Choices) -> Vec<Vec<Expr<'g>>> {
    let columns = if is_of_whole_triplets(chain.task) {
        jacobian_in_group(chain, choices.task)
    } else {
        jacobian_in_world(chain, choices.task)
    };
    let row = |row: TaskRow| {
        let components = columns.iter().map(|twist| twist.components()[row.index()]);
        components.collect()
    };
    let rows: Vec<_> = chain.task.iter().map(row).collect();
    let order = choices.order.iter().filter_map(|place| rows.get(*place));
    order.cloned().collect()
}

/// det(JJᵀ) over the task's rows, and the product of the rows' squared lengths: how near to singular the task is.
pub(crate) fn relative_volume<'g>(chain: &Chain<'g>) -> Outputs<'g> {
    let rows = task_rows(chain, Choices::default());
    let lengths = rows.iter().map(|row| {
        let zero = chain.graph.constant(0.0);
        row.iter().fold(zero, |sum, x| sum + *x * *x)
    });
    let lengths = lengths.fold(chain.graph.constant(1.0), |product, x| product * x);
    vec![
        number("volume", manipulability::volume_squared(&rows)),
        number("lengths", lengths),
    ]
}

/// The squared lengths of H's rows, in the order that is chosen.
pub(crate) fn squared_lengths<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let lengths = manipulability::squared_lengths(&task_rows(chain, choices), &mass_matrix(chain));
    vec![Output::new("lengths", &[lengths.len()], lengths)]
}

/// How ln w_D depends on the entries of J's rows, as the table names them, and on M's.
pub(crate) fn sensitivity<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let found = manipulability::sensitivity(
        &task_rows(chain, choices),
        &mass_matrix(chain),
        choices.passes,
    );
    let matrix = |name, rows: Vec<Vec<Expr<'g>>>| {
        Output::new(name, &[rows.len(), chain.joint_count()], rows.concat())
    };
    vec![
        matrix("by_jacobian", found.by_jacobian),
        matrix("by_mass", found.by_mass),
    ]
}
