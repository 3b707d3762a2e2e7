//! A long program in parts that pass on what they share in an array.

use std::collections::HashMap;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::super::plan::{Argument, Item, Parts, Plan, items};
use super::expression::tokens;
use super::kernel::{NAMES_PER_SCOPE, array_of};

/// Named values in a part. Shorter parts share more values, longer ones compile more slowly.
const LENGTH: usize = 1024;

/// So many parts are worth it.
const LEAST_PARTS: usize = 4;

/// Whether a program of so many named values is emitted in parts.
pub(super) fn is_long(named: usize) -> bool {
    named > LEAST_PARTS * LENGTH
}

/// The body of a kernel after its sines and cosines: the state, the parts, the result.
pub(super) fn parts(plan: &Plan<'_>) -> TokenStream {
    let names: Vec<&'static str> = plan
        .arguments
        .iter()
        .map(|argument| argument.name)
        .collect();
    let divided = Parts::new(plan, divide(plan), &names);
    let slots: HashMap<&str, Literal> = divided
        .shared
        .iter()
        .enumerate()
        .map(|(slot, name)| (name.as_str(), Literal::usize_unsuffixed(slot)))
        .collect();
    let is_read = |argument: &&Argument| {
        let mut parts = divided.parts.iter();
        parts.any(|part| part.arguments.contains(&argument.name))
    };
    let read = plan.arguments.iter().filter(is_read);
    let (arguments, lengths): (Vec<Ident>, Vec<Literal>) = read
        .map(|argument| {
            let length = Literal::usize_unsuffixed(argument.length);
            (format_ident!("{}", argument.name), length)
        })
        .unzip();

    let shared = Literal::usize_unsuffixed(slots.len());
    let outputs = &plan.outputs;
    let fields: Vec<Ident> = outputs
        .iter()
        .map(|o| format_ident!("{}", o.name))
        .collect();
    let types = outputs.iter().map(|o| array_of(&quote!(R), &o.shape));
    let zeros = outputs
        .iter()
        .map(|o| array_of(&quote!(R::of(0.0)), &o.shape));
    let kinds: Vec<Ident> = (1..=divided.parts.len())
        .map(|i| format_ident!("Part{i}"))
        .collect();
    let bodies = divided.parts.iter().map(|part| {
        let known = part.shared.chunks(NAMES_PER_SCOPE).map(|names| {
            let slots = names.iter().map(|name| &slots[name.as_str()]);
            let names = identifiers(names);
            quote!(let (#(#names,)*) = (#(state.shared[#slots],)*);)
        });
        let own: Vec<String> = part.own(plan).collect();
        let own = own.chunks(NAMES_PER_SCOPE).map(|names| {
            let names = identifiers(names);
            quote!(let (#(#names,)*);)
        });
        let arguments = part.arguments.iter().map(|name| format_ident!("{name}"));
        let assignments = part
            .items
            .iter()
            .map(|item| assignment(plan, *item, &slots));
        quote!(#(let #arguments = &state.#arguments;)* #(#known)* #(#own)* #(#assignments)*)
    });
    let angles = plan.angles.iter();
    let angles = angles.flat_map(|angle| [angle.sine.as_deref(), angle.cosine.as_deref()]);
    let angles = angles.flatten().filter_map(|name| share(&slots, name));
    quote! {
        struct State<R> {
            #(#arguments: [R; #lengths],)*
            shared: [R; #shared],
            #(#fields: #types,)*
        }
        #(
            struct #kinds;
            impl<R: ::ulna::Real> ::ulna::internal::Part<State<R>> for #kinds {
                #[inline(always)]
                fn run(state: &mut State<R>) {
                    #bodies
                }
            }
        )*
        let mut state = State {
            #(#arguments: *#arguments,)*
            shared: [R::of(0.0); #shared],
            #(#fields: #zeros,)*
        };
        #(#angles)*
        #(R::apart::<#kinds, _>(&mut state);)*
        (#(state.#fields),*)
    }
}

/// Parts of equal numbers of named values, at most [`LENGTH`], each with the results that are ready then.
fn divide(plan: &Plan<'_>) -> Vec<Vec<Item>> {
    let named = plan.values.len();
    let length = named.div_ceil(named.div_ceil(LENGTH));
    let mut parts: Vec<Vec<Item>> = Vec::new();
    for item in items(plan) {
        match (item, parts.last_mut()) {
            (Item::Value(index), _) if index % length == 0 => parts.push(vec![item]),
            (_, Some(part)) => part.push(item),
            (_, None) => parts.push(vec![item]),
        }
    }
    parts
}

fn identifiers(names: &[String]) -> impl Iterator<Item = Ident> {
    names.iter().map(|name| format_ident!("{name}"))
}

/// The assignment to a name, to the shared array, or to an output.
fn assignment(plan: &Plan<'_>, item: Item, slots: &HashMap<&str, Literal>) -> TokenStream {
    match item {
        Item::Value(index) => {
            let value = &plan.values[index];
            let (name, expression) = (format_ident!("{}", value.name), tokens(&value.expression));
            let shared = share(slots, &value.name);
            quote!(#name = #expression; #shared)
        }
        Item::Element(part, index) => {
            let output = &plan.outputs[part];
            let field = format_ident!("{}", output.name);
            let indices = output.places(index).into_iter();
            let indices = indices.map(Literal::usize_unsuffixed);
            let value = tokens(&output.elements[index].expression);
            quote!(state.#field #([#indices])* = #value;)
        }
        // Coordinates and angles are not among the items of this language.
        Item::Coordinate(_) | Item::Sine(_) | Item::Cosine(_) => quote!(),
    }
}

/// The assignment of a value to its place among the shared ones, if it has one.
fn share(slots: &HashMap<&str, Literal>, name: &str) -> Option<TokenStream> {
    let slot = slots.get(name)?;
    let name = format_ident!("{name}");
    Some(quote!(state.shared[#slot] = #name;))
}
