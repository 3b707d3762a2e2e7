//! A program as a generic function: sines and cosines first, then one named value after another.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::super::plan::{Angle, Coordinates, Plan};
use super::expression::{nested, tokens};
use super::literal::literal;
use super::{documentation, parts};
use crate::MethodProgram;

/// Names that are declared together. Each `let` opens a scope within which all that follows is nested, and the
/// compiler recurses over scopes; one declaration for many names keeps the nesting shallow however long the program.
pub(super) const NAMES_PER_SCOPE: usize = 128;

/// The function of `Unrolled` that runs a method's program on any `R: Real`.
pub(super) fn kernel(compiled: &MethodProgram, joints: usize) -> TokenStream {
    let method = compiled.method;
    let name = format_ident!("{}", method.kernel());
    let plan = Plan::new(compiled, joints, Coordinates::InPlace);
    let of_method = plan.arguments.iter().take(method.arguments().len());
    let arguments = of_method.map(|argument| {
        let length = Literal::usize_unsuffixed(argument.length);
        let used = if argument.is_read { "" } else { "_" };
        let argument = format_ident!("{used}{}", argument.name);
        quote!(#argument: &[R; #length])
    });
    let payload = plan
        .reads_payload()
        .then(|| quote!(let payload = &self.payload.parameters::<R>();));
    let types = plan.outputs.iter().map(|o| array_of(&quote!(R), &o.shape));
    let types: Vec<TokenStream> = types.collect();
    let values = plan.outputs.iter().map(|output| {
        nested(output, |element| match &element.name {
            Some(name) => format_ident!("{name}").into_token_stream(),
            None => tokens(&element.expression),
        })
    });
    let values: Vec<TokenStream> = values.collect();
    let (result, value) = match (types.as_slice(), values.as_slice()) {
        ([result], [value]) => (quote!(#result), quote!(#value)),
        (types, values) => (quote!((#(#types),*)), quote!((#(#values),*))),
    };
    let angles = angles(&plan.angles);
    let in_parts = parts::is_long(plan.values.len());
    let doc = documentation::lines(&plan, !in_parts);
    let (body, value) = if in_parts {
        (parts::parts(&plan), quote!())
    } else {
        let named = plan.values.iter();
        let named = named.map(|value| (value.name.as_str(), &value.expression));
        let mut named: Vec<(Ident, TokenStream)> = named
            .chain(plan.named_results())
            .map(|(name, value)| (format_ident!("{name}"), tokens(value)))
            .collect();
        // A result that is a number, and the last to get a name, needs none.
        let last = named.pop_if(|(name, _)| *name == value.to_string());
        let value = last.map_or(value, |(_, expression)| expression);
        (statements(&named), value)
    };
    quote! {
        #(#[doc = #doc])*
        #[inline(always)]
        fn #name<R: ::ulna::Real>(&self, #(#arguments),*) -> #result {
            #payload
            #angles
            #body
            #value
        }
    }
}

/// The type, or the value, of nested arrays of one element.
pub(super) fn array_of(element: &TokenStream, shape: &[usize]) -> TokenStream {
    shape.iter().rev().fold(element.clone(), |inner, length| {
        let length = Literal::usize_unsuffixed(*length);
        quote!([#inner; #length])
    })
}

/// Sines and cosines of all angles, in one call.
fn angles(angles: &[Angle]) -> TokenStream {
    if angles.is_empty() {
        return quote!();
    }
    let or_underscore = |name: &Option<String>| match name {
        Some(name) => format_ident!("{name}").into_token_stream(),
        None => quote!(_),
    };
    let sines = angles.iter().map(|angle| or_underscore(&angle.sine));
    let cosines = angles.iter().map(|angle| or_underscore(&angle.cosine));
    let sums = angles.iter().map(|angle| {
        let joints = angle.joints.iter().map(|i| Literal::usize_unsuffixed(*i));
        let sum = quote!(#(q[#joints])+*);
        if angle.offset == 0.0 {
            sum
        } else {
            let offset = literal(angle.offset);
            quote!(#sum + R::of(#offset))
        }
    });
    quote!(let ([#(#sines),*], [#(#cosines),*]) = R::sin_cos_all([#(#sums),*]);)
}

fn statements(named: &[(Ident, TokenStream)]) -> TokenStream {
    let blocks = named.chunks(NAMES_PER_SCOPE).map(|block| {
        let names = block.iter().map(|(name, _)| name);
        let declaration = match block {
            // A short program is read top to bottom.
            _ if named.len() <= NAMES_PER_SCOPE => {
                let lets = block
                    .iter()
                    .map(|(name, value)| quote!(let #name = #value;));
                return quote!(#(#lets)*);
            }
            [(only, value)] => return quote!(let #only = #value;),
            _ => quote!(let (#(#names),*);),
        };
        let assignments = block.iter().map(|(name, value)| quote!(#name = #value;));
        quote!(#declaration #(#assignments)*)
    });
    quote!(#(#blocks)*)
}
