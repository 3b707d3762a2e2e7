//! The model as a constant of the generated type, for the generic path beside the generated one.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use ulna::{Friction, Joint, JointKind, Limits, Link, Motor, Placement};
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
    let (limits, motor, friction) = drive(joint);
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
            limits: #limits,
            motor: #motor,
            friction: #friction,
            link: ::ulna::Link { mass: #mass, com: #com, inertia: [#(#inertia),*] },
        }
    }
}

/// Its limits, motor and friction.
fn drive(joint: &Joint) -> (TokenStream, TokenStream, TokenStream) {
    let limits = if joint.limits == Limits::NONE {
        quote!(::ulna::Limits::NONE)
    } else {
        let Limits {
            lower,
            upper,
            velocity,
        } = joint.limits;
        let [lower, upper, velocity] = [lower, upper, velocity].map(literal);
        quote!(::ulna::Limits { lower: #lower, upper: #upper, velocity: #velocity })
    };
    let motor = if joint.motor == Motor::NONE {
        quote!(::ulna::Motor::NONE)
    } else {
        let [inertia, ratio] = [joint.motor.inertia, joint.motor.ratio].map(literal);
        quote!(::ulna::Motor { inertia: #inertia, ratio: #ratio })
    };
    let friction = if joint.friction == Friction::NONE {
        quote!(::ulna::Friction::NONE)
    } else {
        let Friction {
            viscous,
            coulomb,
            smoothing,
        } = joint.friction;
        let [viscous, coulomb, smoothing] = [viscous, coulomb, smoothing].map(literal);
        quote!(::ulna::Friction { viscous: #viscous, coulomb: #coulomb, smoothing: #smoothing })
    };
    (limits, motor, friction)
}

/// `pub const JOINT_NAMES: [&str; N]`.
pub(super) fn joint_names(model: &Model) -> TokenStream {
    let n = Literal::usize_unsuffixed(model.joints().len());
    let names = model.joint_names();
    quote! {
        /// What the joints are called, base first.
        pub const JOINT_NAMES: [&'static str; #n] = [#(#names),*];
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
