//! A link's inertia tensor: one that a rigid body can have, or one that is accepted knowingly.

use nalgebra::Matrix3;

use super::convention::rows;
use super::validate::{all, all_within};
use crate::diagnostics::{Diagnostic, Sink};
use crate::format;
use crate::table::{InertiaTable, LinkTable};
use crate::toml_reader::Located;
use ulna::internal::bounds::{MOMENT_ROUNDING, TRIANGLE_TOLERANCE};

/// Smallest principal moment, kg·m²: a body of a milligram and a millimetre.
const LEAST_MOMENT: f64 = 1e-12;

/// The tensor, if a rigid body can have it or the table accepts it all the same.
pub(super) fn inertia(link: &LinkTable, sink: &Sink) -> Option<[[f64; 3]; 3]> {
    let row = link.inertia.as_ref()?;
    let tensor = tensor(&row.value, sink)?;
    let accepted = link.accept_inertia.as_ref().filter(|accept| accept.value);
    match (impossible_inertia(&rows(tensor)), accepted) {
        (None, None) => {}
        (None, Some(accept)) => sink.push(
            Diagnostic::warning(
                accept.span.clone(),
                format!("{} is not needed: a rigid body can have {}", accept.name, row.name),
            )
            .help("leave the key out, so that it cannot hide a later mistake"),
        ),
        (Some(fault), None) => {
            sink.push(fault.at(row, Diagnostic::error).help(
                "give the tensor about the centroid in the link's axes, \
                 products with the tensor's sign: xy is -sum(m x y); \
                 if it is known and meant as it is, write `accept_inertia = true` beside it",
            ));
            return None;
        }
        (Some(fault), Some(_)) => sink.push(fault.at(row, Diagnostic::warning).help(
            "it is taken over as `accept_inertia` says: torques follow from it, but no rigid body moves so",
        )),
    }
    Some(rows(tensor))
}

fn tensor(row: &InertiaTable, sink: &Sink) -> Option<Matrix3<f64>> {
    let moments = all_within(&row.moments, &format::XX, sink);
    let products = row.products.each_ref();
    let products = products.map(|product| match product {
        Some(product) => format::XY.admit(product, sink),
        None => Some(0.0),
    });
    let [xx, yy, zz] = moments?;
    let [xy, xz, yz] = all(products)?;
    Some(Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz))
}

/// Why no rigid body can have an inertia tensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpossibleInertia {
    /// The principal moments, the least first, kg·m².
    pub principal: [f64; 3],
}

/// What is wrong with a symmetric inertia tensor about a centroid, kg·m², if no rigid body can have it: it is not positive
/// definite, or one of its principal moments exceeds the sum of the other two (by more than what three printed digits explain).
pub fn impossible_inertia(tensor: &[[f64; 3]; 3]) -> Option<ImpossibleInertia> {
    let tensor = Matrix3::from_fn(|i, j| tensor[i][j]);
    let mut principal = tensor.symmetric_eigenvalues();
    principal.as_mut_slice().sort_by(f64::total_cmp);
    let found = ImpossibleInertia {
        principal: principal.into(),
    };
    (found.is_indefinite() || found.excess() > TRIANGLE_TOLERANCE).then_some(found)
}

impl ImpossibleInertia {
    fn is_indefinite(&self) -> bool {
        let [least, _, largest] = self.principal;
        least <= largest * MOMENT_ROUNDING || least < LEAST_MOMENT
    }

    /// By how much the largest principal moment exceeds the sum of the others, as a share of it.
    pub fn excess(&self) -> f64 {
        let [least, middle, largest] = self.principal;
        (largest - least - middle) / largest
    }

    /// What rule it breaks, as the end of a sentence about the tensor.
    pub fn rule(&self) -> &'static str {
        if self.is_indefinite() {
            "is not that of a rigid body: it must be positive definite"
        } else {
            "is not that of a rigid body: no principal moment may exceed the sum of the other two"
        }
    }

    /// The principal moments, and by how much they miss the rule.
    pub fn numbers(&self) -> String {
        let [least, middle, largest] = self.principal;
        let moments = format!("principal moments {least:.4e}, {middle:.4e}, {largest:.4e}");
        if self.is_indefinite() {
            return moments;
        }
        let percent = 100.0 * (largest / (least + middle) - 1.0);
        format!("{moments}: beyond the sum by {percent:.1} %")
    }

    fn at(
        &self,
        row: &Located<InertiaTable>,
        make: fn(std::ops::Range<usize>, String) -> Diagnostic,
    ) -> Diagnostic {
        make(row.span.clone(), format!("{} {}", row.name, self.rule())).label(self.numbers())
    }
}
