//! Kinematic manipulability w = √det(JJᵀ) and its gradient (Yoshikawa 1985), by the adjoint:
//! ∂w/∂q_i = w ⟨W, ∂J/∂q_i⟩, where W = (JJᵀ)⁻¹J is the dual basis of J's rows. One reverse sweep through J, seeded with W.

use super::chain::Chain;
use super::manipulability::{OF_J, orthogonalise, product};
use super::task::{number, task_rows};
use super::{Choices, Outputs};
use crate::differentiate::reverse;
use crate::schedule::{Output, Size};

/// How often J's rows are made orthogonal. Twice, as H's are: near a singular pose once loses W.
const PASSES: usize = 2;

/// w, ∇w, and det(JJᵀ) over the task's rows.
pub(super) fn outputs<'g>(chain: &Chain<'g>, choices: Choices) -> Outputs<'g> {
    let joints = chain.joint_count();
    let zero = chain.graph.constant(0.0);
    let (mut value, mut gradient, mut volume) = (zero, vec![zero; joints], zero);
    if !choices.singular {
        let rows = task_rows(chain, choices);
        let basis = orthogonalise(&rows, PASSES, &OF_J);
        let duals = basis.duals().into_iter().flatten();
        let seeded: Vec<_> = rows.into_iter().flatten().zip(duals).collect();
        volume = product(&basis.pivots).labelled("volume", || "det_jjt".into());
        value = volume.sqrt().labelled("w_k", || "w".into());
        let logarithmic = reverse(chain.graph, &seeded, joints);
        let by_joint = logarithmic.into_iter().zip(1..).map(|(x, i)| {
            x.labelled("dlnw_k", || format!("dlnw_{i}"));
            (value * x).labelled("dw_k", || format!("dw_{i}"))
        });
        gradient = by_joint.collect();
    }
    vec![
        number("value", value),
        Output::new("gradient", &[joints], gradient).relative_to(Size::LargestOrBefore),
        number("volume", volume).relative_to(Size::Any),
    ]
}
