//! Programs as Rust: the only place that knows the language's syntax.

mod base_parameters;
mod chain;
mod documentation;
mod expression;
mod kernel;
mod latency;
mod layout;
mod literal;
mod names;
mod parts;
mod payload;

use std::fmt::Write as _;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use ulna::{Method, MethodSet};
use ulna_table::Model;

pub use expression::fused_summands;
pub use latency::Summand;

use crate::accuracy::{ALLOWANCE, Conditioned, LEAST_VOLUME, rounded_up};
use crate::cost::Counts;
use crate::op::Op;
use crate::{Compiled, Stage};

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
            header: header(model, source, &compiled, &counts),
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

/// Methods in lines of a few.
fn listed(methods: MethodSet, written: impl Fn(Method) -> String) -> Vec<String> {
    let names: Vec<String> = methods.iter().map(written).collect();
    let last = names.chunks(4).len().saturating_sub(1);
    let lines = names.chunks(4).enumerate();
    lines
        .map(|(i, names)| format!(" {}{}", names.join(", "), if i < last { "," } else { "." }))
        .collect()
}

/// An arm without anything of its own.
fn unit(name: &Ident) -> TokenStream {
    quote! {
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct #name;
    }
}

/// `text` as it can stand in a comment: a file's name may have a line break in it, and what follows would be code.
/// The characters that turn the direction of writing go too: the compiler refuses them.
fn on_one_line(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '\'' | '"' => c.to_string(),
            c => c.escape_debug().to_string(),
        })
        .collect()
}

fn header(model: &Model, source: &str, compiled: &Compiled, counts: &[(Method, Counts)]) -> String {
    let mut text = format!(
        "// @generated by ulna {version} from {source}: do not edit, generate again.\n\
         // SHA-256 of the table: {hash}\n//\n// Operations",
        version = env!("CARGO_PKG_VERSION"),
        source = on_one_line(source),
        hash = model.table_hash(),
    );
    let names = Op::ALL.iter().map(|op| op.row().name);
    let mut line = |name: &str, cells: &[String]| {
        let cells: String = cells.iter().map(|cell| format!("{cell:>8}")).collect();
        // Writing to a String does not fail.
        let _ = write!(
            text,
            "{name:<width$}{cells}\n//   ",
            width = if name.is_empty() { 24 } else { 32 }
        );
    };
    let titles: Vec<String> = names
        .map(ToString::to_string)
        .chain(["total".into(), "sin_cos".into(), "error".into()])
        .collect();
    line("", &titles);
    for ((name, counts), method) in counts.iter().zip(&compiled.methods) {
        let operations = counts.operations.iter().map(|(_, count)| count.to_string());
        let cells: Vec<String> = operations
            .chain([counts.total.to_string(), counts.sin_cos.to_string()])
            .chain([rounded_up(method.error)])
            .collect();
        line(name.name(), &cells);
    }
    text.truncate(text.trim_end_matches("//   ").len());
    let absent = compiled.generated().rest();
    if !absent.is_empty() {
        text.push_str("//\n// Not generated, but computed by the textbook formulas on CHAIN:\n");
        for line in listed(absent, |method| method.to_string()) {
            // Writing to a String does not fail.
            let _ = writeln!(text, "//  {line}");
        }
    }
    let [random, near_singular] = compiled.states;
    // Writing to a String does not fail.
    let _ = write!(
        text,
        "//\n// error: of the worst entry, relative to the largest, in double precision. {ALLOWANCE} times what was measured at\n\
         // {random} random states and {near_singular} near singular poses, where J's rows span {LEAST_VOLUME:e} of the product of their lengths.\n"
    );
    if let Some(Conditioned {
        factor,
        median,
        largest,
    }) = &compiled.conditioned
    {
        let _ = write!(
            text,
            "// w_D and its gradient: at most {factor:.0} times 2.2e-16 times the condition number of w_D (ulna::proof::condition),\n\
             // which was {median:.0e} at the median of those states, and {largest:.0e} at most.\n"
        );
    }
    text
}
