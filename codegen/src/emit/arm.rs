//! `impl Arm`: each method hands its arguments to its kernel, and the kernel's arrays back as matrices.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use ulna::{JointKind, Model};

use super::kernel::kernel_name;
use crate::Method;

/// The implementation of `Arm` for the type `name`.
pub(super) fn implementation(name: &Ident, model: &Model, methods: &[Method]) -> TokenStream {
    let n = Literal::usize_unsuffixed(model.joints.len());
    let methods = methods.iter().map(|method| wrapper(method, &n));
    quote! {
        impl ::ulna::Arm<#n> for #name {
            fn task(&self) -> ::ulna::TaskRows {
                Self::CHAIN.task
            }

            fn rated_torque(&self) -> ::ulna::nalgebra::SVector<f64, #n> {
                ::ulna::Arm::rated_torque(&Self::CHAIN)
            }

            #(#methods)*
        }
    }
}

/// The coordinates as kernels read them: finite results for every finite coordinate.
pub(super) fn coordinates(model: &Model) -> TokenStream {
    let n = Literal::usize_unsuffixed(model.joints.len());
    let each = model.joints.iter().enumerate().map(|(i, joint)| {
        let i = Literal::usize_unsuffixed(i);
        match joint.kind {
            JointKind::Revolute => quote!(::ulna::kernel::revolute_angle(q[#i])),
            JointKind::Prismatic => quote!(::ulna::kernel::prismatic_offset(q[#i])),
        }
    });
    quote! {
        /// The joint coordinates as the kernels read them.
        #[inline]
        pub fn coordinates(q: &::ulna::nalgebra::SVector<f64, #n>) -> [f64; #n] {
            [#(#each),*]
        }
    }
}

fn wrapper(method: &Method, n: &Literal) -> TokenStream {
    let (name, kernel) = (format_ident!("{}", method.name), kernel_name(method.name));
    let arguments: Vec<Ident> = method
        .arguments
        .iter()
        .map(|a| format_ident!("{a}"))
        .collect();
    let passed = arguments.iter().map(|argument| {
        if argument == "q" {
            quote!(&Self::coordinates(q))
        } else {
            quote!(&#argument.data.0[0])
        }
    });
    let call = quote!(Self::#kernel(#(#passed),*));
    let (result, body) = conversion(method.name, n, &call);
    quote! {
        fn #name(&self, #(#arguments: &::ulna::nalgebra::SVector<f64, #n>),*) -> #result {
            #body
        }
    }
}

/// A method's return type, and its body around the call of its kernel.
fn conversion(method: &str, n: &Literal, call: &TokenStream) -> (TokenStream, TokenStream) {
    let vector = quote!(::ulna::nalgebra::SVector<f64, #n>);
    let jacobian = quote!(::ulna::nalgebra::SMatrix<f64, 6, #n>);
    let square = quote!(::ulna::nalgebra::SMatrix<f64, #n, #n>);
    let settled = quote!(::ulna::kernel::settled_gradient(
        value, gradient, &pivots, &diagonal
    ));
    match method {
        "forward_kinematics" => (
            quote!(::ulna::nalgebra::IsometryMatrix3<f64>),
            quote! {
                let (rotation, translation) = #call;
                ::ulna::kernel::pose(rotation, translation)
            },
        ),
        "geometric_jacobian" => (jacobian, quote!(#call.into())),
        "jacobian_derivatives" => (quote!([#jacobian; #n]), quote!(#call.map(Into::into))),
        "mass_matrix" => (square, quote!(#call.into())),
        "mass_matrix_derivatives" => (quote!([#square; #n]), quote!(#call.map(Into::into))),
        "mass_matrix_and_derivatives" => (
            quote!((#square, [#square; #n])),
            quote! {
                let (mass, derivatives) = #call;
                (mass.into(), derivatives.map(Into::into))
            },
        ),
        "dynamic_manipulability" => (
            quote!(f64),
            quote! {
                let (value, pivots, diagonal) = #call;
                ::ulna::kernel::settled_value(value, &pivots, &diagonal)
            },
        ),
        "dynamic_manipulability_gradient" => (
            quote!((f64, #vector)),
            quote! {
                let (value, gradient, pivots, diagonal) = #call;
                #settled
            },
        ),
        "jacobian_and_gradient" => (
            quote!((#jacobian, f64, #vector)),
            quote! {
                let (jacobian, value, gradient, pivots, diagonal) = #call;
                let (value, gradient) = #settled;
                (jacobian.into(), value, gradient)
            },
        ),
        _ => (vector, quote!(#call.into())),
    }
}
