//! The model as a constant of the generated type, for the generic path beside the generated one.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use ulna::{Joint, JointKind, Link, Placement};
use ulna_table::Model;

use super::literal::literal;

/// `pub const CHAIN: SerialChain<N>`.
pub(super) fn chain(model: &Model) -> TokenStream {
    let n = Literal::usize_unsuffixed(model.joints().len());
    let joints = model.joints().iter().map(joint);
    let (base, tool) = (placement(model.base()), placement(model.tool()));
    let gravity = array(&model.gravity());
    let rows = model.task().iter().map(|row| {
        let row = format_ident!("{row:?}");
        quote!(::ulna::TaskRow::#row)
    });
    quote! {
        /// The arm as data, for the generic path beside the generated one: modified Denavit–Hartenberg rows, SI units.
        pub const CHAIN: ::ulna::SerialChain<#n> = ::ulna::SerialChain {
            joints: [#(#joints),*],
            base: #base,
            tool: #tool,
            gravity: #gravity,
            task: ::ulna::TaskRows::new(&[#(#rows),*]),
        };
    }
}

fn joint(joint: &Joint) -> TokenStream {
    let kind = match joint.kind {
        JointKind::Revolute => quote!(Revolute),
        JointKind::Prismatic => quote!(Prismatic),
    };
    let [alpha, a, theta, d] =
        [joint.alpha.radians, joint.a, joint.theta.radians, joint.d].map(literal);
    let rated_torque = match joint.rated_torque.map(literal) {
        Some(torque) => quote!(Some(#torque)),
        None => quote!(None),
    };
    let Link { mass, com, inertia } = &joint.link;
    let (mass, com) = (literal(*mass), array(com));
    let inertia = inertia.iter().map(array);
    quote! {
        ::ulna::Joint {
            kind: ::ulna::JointKind::#kind,
            alpha: ::ulna::Angle::from_radians(#alpha),
            a: #a,
            theta: ::ulna::Angle::from_radians(#theta),
            d: #d,
            rated_torque: #rated_torque,
            link: ::ulna::Link { mass: #mass, com: #com, inertia: [#(#inertia),*] },
        }
    }
}

fn placement(placement: &Placement) -> TokenStream {
    if *placement == Placement::IDENTITY {
        return quote!(::ulna::Placement::IDENTITY);
    }
    let rotation = placement.rotation.iter().map(array);
    let translation = array(&placement.translation);
    quote!(::ulna::Placement { rotation: [#(#rotation),*], translation: #translation })
}

fn array(values: &[f64; 3]) -> TokenStream {
    let values = values.iter().map(|value| literal(*value));
    quote!([#(#values),*])
}
