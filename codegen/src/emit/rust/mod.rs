//! Programs as Rust: the only place that knows the language's syntax.
//!
//! [`Generated`] is a type that implements [`ulna::Arm`], and a test that proves it.

mod base_parameters;
mod chain;
mod documentation;
mod expression;
mod kernel;
mod layout;
mod literal;
mod parts;
mod payload;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use ulna::{Method, MethodSet};
use ulna_table::Model;

use super::plan::{header, listed};
use crate::cost::Counts;
use crate::{Compiled, Stage};

/// Above the methods that are not generated.
const ABSENT: &str = "Not generated, but computed by the textbook formulas on CHAIN:";

/// The code of an arm.
#[derive(Debug)]
pub struct Generated {
    tokens: TokenStream,
    header: String,
    counts: Vec<(Method, Counts)>,
    warnings: Vec<String>,
}

impl Generated {
    /// Emits the methods of `model`'s arm. `source` names the table; `watch` is told of every method before it is printed.
    pub(crate) fn new(
        model: &Model,
        source: &str,
        compiled: Compiled,
        watch: &dyn Fn(Stage),
    ) -> Self {
        let counts: Vec<_> = compiled
            .methods
            .iter()
            .map(|method| (method.method, Counts::of(&method.program)))
            .collect();
        Self {
            tokens: tokens(model, &compiled, watch),
            header: comment(&header(model, source, &compiled, &counts, ABSENT)),
            counts,
            warnings: compiled.warnings,
        }
    }

    /// The code, for a macro.
    pub fn tokens(&self) -> &TokenStream {
        &self.tokens
    }

    /// The code as a formatted file with a header that says where it comes from.
    pub fn source(&self) -> String {
        match syn::parse2(self.tokens.clone()) {
            Ok(file) => {
                let code = layout::laid_out(&prettyplease::unparse(&file));
                format!("{}\n{code}", self.header)
            }
            // What the emitter wrote would then not compile either; the compiler's message is the better one.
            Err(_) => format!("{}\n{}\n", self.header, self.tokens),
        }
    }

    /// What the user should know of the arm; a sentence each.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The operations of each method of [`ulna::Arm`].
    pub fn counts(&self) -> &[(Method, Counts)] {
        &self.counts
    }
}

fn tokens(model: &Model, compiled: &Compiled, watch: &dyn Fn(Stage)) -> TokenStream {
    let name = format_ident!("{}", model.type_name());
    let joints = model.joints().len();
    let summary = format!(" The arm `{}`: {joints} joints, unrolled.", model.name());
    let chain = chain::chain(model);
    let joint_names = chain::joint_names(model);
    let base_parameters = base_parameters::base_parameters(&compiled.base_parameters);
    let n = Literal::usize_unsuffixed(joints);
    let kernels = compiled.methods.iter().map(|method| {
        watch(Stage::Printing(method.method));
        kernel::kernel(method, joints)
    });
    let proof = format_ident!("{}_proof", model.name());
    let (structure, methods, with_payload) = if model.has_payload() {
        (
            payload::structure(&name),
            payload::methods(),
            payload::chain(&n),
        )
    } else {
        (unit(&name), quote!(), quote!())
    };
    let mut optional = vec![
        format_ident!("JOINT_NAMES"),
        format_ident!("BASE_PARAMETERS"),
    ];
    optional.extend(model.has_payload().then(|| format_ident!("set_payload")));
    let arms = if model.has_payload() {
        payload::examples(&name).to_vec()
    } else {
        vec![quote!(super::#name)]
    };
    let generated = compiled.generated();
    let absent = absent(generated);
    let generated = generated.iter().map(|method| format_ident!("{method:?}"));
    quote! {
        #[doc = #summary]
        #(#[doc = #absent])*
        #structure

        #[rustfmt::skip]
        impl #name {
            #chain
            #joint_names
            #methods

            #base_parameters
        }

        #[rustfmt::skip]
        impl ::ulna::Unrolled<#n> for #name {
            const CHAIN: ::ulna::SerialChain<#n> = Self::CHAIN;
            const GENERATED: ::ulna::MethodSet = ::ulna::MethodSet::of(&[#(::ulna::Method::#generated),*]);
            #with_payload
            #(#kernels)*
        }

        ::ulna::implement_arm!(#name, #n);

        // A program that includes this file need not use them.
        const _: () = {
            #(let _ = #name::#optional;)*
        };

        #[cfg(test)]
        #[rustfmt::skip]
        mod #proof {
            /// Every method against the textbook formulas, at random states.
            #[test]
            fn generated_code_agrees_with_the_textbook() {
                #(
                    let arm = #arms;
                    let chain = ::ulna::Unrolled::chain(&arm);
                    let states = ::ulna::proof::states(&chain).take(20);
                    let report = ::ulna::proof::compare(&arm, &chain, states);
                    assert!(report.passes(), "{report}");
                )*
            }
        }
    }
}

/// What the docs of a type say of the methods that are not generated; nothing if all are.
fn absent(generated: MethodSet) -> Vec<String> {
    let rest = generated.rest();
    if rest.is_empty() {
        return Vec::new();
    }
    let mut lines = vec![
        String::new(),
        " Not generated, but computed by the textbook formulas on `CHAIN` (the same numbers but for rounding, slower):".to_owned(),
    ];
    lines.extend(listed(rest, |method| format!("`{method}`")));
    lines
}

/// An arm without anything of its own.
fn unit(name: &Ident) -> TokenStream {
    quote! {
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct #name;
    }
}

/// Lines as comments.
fn comment(lines: &[String]) -> String {
    let lines = lines.iter().map(|line| match line.as_str() {
        "" => "//\n".to_owned(),
        line => format!("// {line}\n"),
    });
    lines.collect()
}
