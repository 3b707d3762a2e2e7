//! What is compared with what, and how far apart they may be. The only file that knows.

use nalgebra::{DMatrix, SVector};
use ulna::arm::singular::least_volume_squared;
use ulna::proof::{State, compare_with, condition, differences};
use ulna::{Arm as _, SerialChain, TaskRow};
use ulna_codegen::Interpreter;

const ABOUT_W: [&str; 6] = [
    "dynamic_manipulability",
    "dynamic_manipulability_gradient",
    "jacobian_and_gradient",
    "task_space_inertia",
    "dynamically_consistent_inverse",
    "manipulability_gradient",
];

/// How far one method of the generated programs is from the reference at a state.
#[derive(Clone, Debug)]
pub(crate) struct Judgement {
    pub(crate) method: String,
    /// The relative error.
    pub(crate) error: f64,
    /// What rounding may leave of it.
    pub(crate) allowed: f64,
}

impl Judgement {
    /// Whether the error is allowed; a NaN is not.
    pub(crate) fn passes(&self) -> bool {
        self.error <= self.allowed
    }

    /// The error, in what is allowed; infinite for what is no number.
    pub(crate) fn excess(&self) -> f64 {
        if self.passes() && self.allowed == 0.0 {
            0.0
        } else if self.error.is_nan() {
            f64::INFINITY
        } else {
            self.error / self.allowed
        }
    }
}

/// Every method of the programs and of the textbook, beside the programs run with twice as many digits, at one state.
/// Where some take w_D for 0 and others do not, that is all there is to say about w_D.
pub(crate) fn judge<const N: usize>(
    programs: &Interpreter<N>,
    chain: &SerialChain<N>,
    exact: &Interpreter<N>,
    state: State<N>,
) -> Vec<Judgement> {
    let of_programs = compare_with(programs, exact, chain, [state]);
    let of_textbook = compare_with(chain, exact, chain, [state]);
    let reports = [("", of_programs), ("textbook: ", of_textbook)];
    let judgements = reports.iter().flat_map(|(whose, report)| {
        report.deviations().iter().map(move |deviation| Judgement {
            method: format!("{whose}{}", deviation.method),
            error: deviation.error,
            allowed: deviation.tolerance,
        })
    });
    let mut judgements: Vec<_> = judgements.collect();
    let by_differences = differences::compare(programs, chain, [state]);
    judgements.extend(
        by_differences
            .deviations()
            .iter()
            .map(|deviation| Judgement {
                method: format!("differences: {}", deviation.method),
                error: deviation.error,
                allowed: deviation.tolerance,
            }),
    );
    judgements.extend(as_the_file_states(programs, chain, exact, &state));
    let w = [
        programs.dynamic_manipulability(&state.q),
        chain.dynamic_manipulability(&state.q),
        exact.dynamic_manipulability(&state.q),
    ];
    let zeros = w.iter().filter(|w| **w == 0.0).count();
    if [0, w.len()].contains(&zeros) {
        return judgements;
    }
    judgements.retain(|judgement| {
        !ABOUT_W
            .iter()
            .any(|method| judgement.method.ends_with(method))
    });
    if !is_on_the_threshold(chain, &state) {
        judgements.push(Judgement {
            method: "w_D is 0 for some, and not for others".to_owned(),
            error: 1.0,
            allowed: 0.0,
        });
    }
    judgements
}

/// w_D and ∇w_D beside what the generated file states of their errors.
fn as_the_file_states<const N: usize>(
    programs: &Interpreter<N>,
    chain: &SerialChain<N>,
    exact: &Interpreter<N>,
    state: &State<N>,
) -> Option<Judgement> {
    let (w, gradient) = programs.dynamic_manipulability_gradient(&state.q);
    let (exact_w, exact_gradient) = exact.dynamic_manipulability_gradient(&state.q);
    let slopes = (gradient - exact_gradient).amax() / exact_gradient.amax().max(exact_w);
    let error = slopes.max((w - exact_w).abs() / exact_w);
    let bound =
        programs.compiled().conditioned?.factor * f64::EPSILON * condition(exact, chain, &state.q);
    (exact_w > 0.0 && bound < 1e-2).then(|| Judgement {
        method: "what the file states of w_D".to_owned(),
        error,
        allowed: bound,
    })
}

fn task_rows<const N: usize>(chain: &SerialChain<N>, q: &SVector<f64, N>) -> DMatrix<f64> {
    let jacobian = chain.geometric_jacobian(q);
    let rows: Vec<_> = chain.task.iter().map(TaskRow::index).collect();
    DMatrix::from_fn(rows.len(), N, |r, c| jacobian[(rows[r], c)])
}

fn volume(rows: &DMatrix<f64>) -> f64 {
    rows.singular_values().iter().product()
}

/// Whether the volume of J's rows is so near the least that rounding decides whether w_D counts as 0.
fn is_on_the_threshold<const N: usize>(chain: &SerialChain<N>, state: &State<N>) -> bool {
    const NEAR: f64 = 16.0;
    let volume = volume(&task_rows(chain, &state.q));
    let q = state.q.data.0[0];
    let least = least_volume_squared(&chain.joints, &chain.tool, chain.task, &q).sqrt();
    volume > least / NEAR && volume < least * NEAR
}
