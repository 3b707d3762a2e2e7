//! A program as a generic function: sines and cosines first, then one named value after another.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::expression::Writer;
use super::literal::literal;
use super::{documentation, parts};
use crate::MethodProgram;
use crate::graph::AngleSum;

/// Names that are declared together. Each `let` opens a scope within which all that follows is nested, and the
/// compiler recurses over scopes; one declaration for many names keeps the nesting shallow however long the program.
pub(super) const NAMES_PER_SCOPE: usize = 128;

/// The function of `Unrolled` that runs a method's program on any `R: Real`.
pub(super) fn kernel(compiled: &MethodProgram, joints: usize) -> TokenStream {
    let MethodProgram {
        method, program, ..
    } = compiled;
    let name = format_ident!("{}", method.kernel());
    let writer = Writer::new(program);
    let arguments = method.arguments().iter().map(|argument| {
        let length = Literal::usize_unsuffixed(argument.length(joints));
        let argument = argument.name();
        let used = if writer.uses_argument(argument) {
            ""
        } else {
            "_"
        };
        let argument = format_ident!("{used}{argument}");
        quote!(#argument: &[R; #length])
    });
    let has_payload = writer.uses_argument("payload");
    let payload = has_payload.then(|| quote!(let payload = &self.payload.parameters::<R>();));
    let types: Vec<TokenStream> = program
        .outputs
        .iter()
        .map(|o| array_of(&quote!(R), &o.shape))
        .collect();
    let outputs: Vec<TokenStream> = program.outputs.iter().map(|o| writer.output(o)).collect();
    let (result, value) = match (types.as_slice(), outputs.as_slice()) {
        ([result], [value]) => (quote!(#result), quote!(#value)),
        (types, values) => (quote!((#(#types),*)), quote!((#(#values),*))),
    };
    let angles = angles(&writer, &program.angles);
    let mut named = writer.named();
    let in_parts = parts::is_long(named.len());
    let names = named.iter().map(|(name, _)| name.to_string());
    let doc = documentation::lines(compiled, has_payload, names, writer.labels(!in_parts));
    let (body, value) = if in_parts {
        (parts::parts(&writer, compiled, &named, joints), quote!())
    } else {
        named.extend(writer.named_results());
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
fn angles(writer: &Writer<'_>, angles: &[AngleSum]) -> TokenStream {
    if angles.is_empty() {
        return quote!();
    }
    let or_underscore = |name: Option<Ident>| name.map_or(quote!(_), |name| quote!(#name));
    let names = (0..angles.len()).map(|index| writer.angle(index));
    let (sines, cosines): (Vec<TokenStream>, Vec<TokenStream>) = names
        .map(|(sine, cosine)| (or_underscore(sine), or_underscore(cosine)))
        .unzip();
    let sums = angles.iter().map(|AngleSum { joints, offset }| {
        let joints = joints.iter().map(|i| Literal::usize_unsuffixed(*i));
        let sum = quote!(#(q[#joints])+*);
        if *offset == 0.0 {
            sum
        } else {
            let offset = literal(offset.to_f64());
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
