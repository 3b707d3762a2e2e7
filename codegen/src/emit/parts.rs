//! A long program in parts, each a function of its own.
//!
//! What LLVM does to a function takes more than linear time in its length; in a debug build, each value has its own place
//! on the stack. Parts pass on what they share in an array.

use std::collections::{HashMap, HashSet};

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use ulna::Payload;

use super::expression::Writer;
use super::kernel::{NAMES_PER_SCOPE, array_of};
use crate::MethodProgram;
use crate::double_double::DoubleDouble;
use crate::schedule::{Operand, Output};

/// Named values in a part. Shorter parts share more values, longer ones compile more slowly.
const LENGTH: usize = 1024;

/// So many parts are worth it.
const LEAST_PARTS: usize = 4;

/// Whether a program of so many named values is emitted in parts.
pub(super) fn is_long(named: usize) -> bool {
    named > LEAST_PARTS * LENGTH
}

/// A function in the making.
#[derive(Default)]
struct Part {
    /// The kernel's arguments that it reads.
    arguments: Vec<Ident>,
    /// Names from parts before it, in the order in which they are needed.
    shared: Vec<Ident>,
    /// Names that it gives values to.
    own: Vec<Ident>,
    /// Assignments to its names, the shared array and the outputs.
    assignments: Vec<TokenStream>,
}

/// An element of an output.
struct Element {
    place: TokenStream,
    operand: Operand,
}

/// The body of a kernel after its sines and cosines: the state, the parts, the result.
pub(super) fn parts(
    writer: &Writer<'_>,
    compiled: &MethodProgram,
    named: &[(Ident, TokenStream)],
    joints: usize,
) -> TokenStream {
    let outputs = &compiled.program.outputs;
    let elements = elements_by_last_name(writer, outputs, named);
    let arguments = compiled.method.arguments().iter();
    let (arguments, lengths): (Vec<Ident>, Vec<usize>) = arguments
        .map(|argument| (argument.name(), argument.length(joints)))
        .chain([("payload", Payload::PARAMETERS)])
        .map(|(name, length)| (format_ident!("{name}"), length))
        .unzip();
    let (parts, slots) = divide(writer, &arguments, named, &elements, LENGTH);
    let read = arguments.into_iter().zip(lengths);
    let (arguments, lengths): (Vec<Ident>, Vec<Literal>) = read
        .filter(|(argument, _)| parts.iter().any(|part| part.arguments.contains(argument)))
        .map(|(argument, length)| (argument, Literal::usize_unsuffixed(length)))
        .unzip();

    let shared = Literal::usize_unsuffixed(slots.len());
    let fields: Vec<Ident> = outputs
        .iter()
        .map(|o| format_ident!("{}", o.name))
        .collect();
    let types = outputs.iter().map(|o| array_of(&quote!(R), &o.shape));
    let zeros = outputs
        .iter()
        .map(|o| array_of(&quote!(R::of(0.0)), &o.shape));
    let kinds: Vec<Ident> = (1..=parts.len())
        .map(|i| format_ident!("Part{i}"))
        .collect();
    let bodies = parts.iter().map(|part| body(part, &slots));
    let angles = (0..compiled.program.angles.len()).flat_map(|angle| {
        let (sine, cosine) = writer.angle(angle);
        [sine, cosine].into_iter().flatten()
    });
    let angles = angles.filter_map(|name| share(&slots, &name));
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

/// The elements of the outputs, each with the position of the last named value that it needs. Zeros are there from the start.
fn elements_by_last_name(
    writer: &Writer<'_>,
    outputs: &[Output<Operand>],
    named: &[(Ident, TokenStream)],
) -> HashMap<usize, Vec<Element>> {
    let positions: HashMap<&Ident, usize> = named
        .iter()
        .enumerate()
        .map(|(i, (name, _))| (name, i))
        .collect();
    let mut elements: HashMap<usize, Vec<Element>> = HashMap::new();
    for output in outputs {
        let field = format_ident!("{}", output.name);
        for (index, operand) in output.elements.iter().enumerate() {
            if *operand == Operand::Constant(DoubleDouble::default()) {
                continue;
            }
            let mut names = Vec::new();
            writer.names_in(*operand, &mut names);
            let last = names.iter().filter_map(|name| positions.get(name)).max();
            let places = output.places(index).into_iter();
            let indices = places.map(Literal::usize_unsuffixed);
            elements
                .entry(last.copied().unwrap_or(0))
                .or_default()
                .push(Element {
                    place: quote!(state.#field #([#indices])*),
                    operand: *operand,
                });
        }
    }
    elements
}

/// Parts of equal length, at most `longest`, and the places of the values that they share.
fn divide(
    writer: &Writer<'_>,
    arguments: &[Ident],
    named: &[(Ident, TokenStream)],
    elements: &HashMap<usize, Vec<Element>>,
    longest: usize,
) -> (Vec<Part>, HashMap<Ident, usize>) {
    let length = named.len().div_ceil(named.len().div_ceil(longest));
    let mut parts: Vec<Part> = named
        .chunks(length)
        .map(|own| Part {
            own: own.iter().map(|(name, _)| name.clone()).collect(),
            ..Part::default()
        })
        .collect();
    let elements = |position| elements.get(&position).into_iter().flatten();

    let steps = writer.named_steps();
    let mut slots: HashMap<Ident, usize> = HashMap::new();
    for (index, (part, steps)) in parts.iter_mut().zip(steps.chunks(length)).enumerate() {
        let mut names = Vec::new();
        for (offset, step) in steps.iter().enumerate() {
            writer.names_in_step(step, &mut names);
            for element in elements(index * length + offset) {
                writer.names_in(element.operand, &mut names);
            }
        }
        let mut known: HashSet<Ident> = part.own.iter().cloned().collect();
        names.retain(|name| known.insert(name.clone()));
        (part.arguments, part.shared) =
            names.into_iter().partition(|name| arguments.contains(name));
        for name in &part.shared {
            let next = slots.len();
            slots.entry(name.clone()).or_insert(next);
        }
    }
    for (position, (name, value)) in named.iter().enumerate() {
        let assignments = &mut parts[position / length].assignments;
        assignments.push(quote!(#name = #value;));
        assignments.extend(share(&slots, name));
        assignments.extend(elements(position).map(|Element { place, operand }| {
            let value = writer.value(*operand);
            quote!(#place = #value;)
        }));
    }
    (parts, slots)
}

/// The assignment of a value to its place among the shared ones, if it has one.
fn share(slots: &HashMap<Ident, usize>, name: &Ident) -> Option<TokenStream> {
    let slot = Literal::usize_unsuffixed(*slots.get(name)?);
    Some(quote!(state.shared[#slot] = #name;))
}

fn body(part: &Part, slots: &HashMap<Ident, usize>) -> TokenStream {
    let shared = part.shared.chunks(NAMES_PER_SCOPE).map(|names| {
        let slots = names
            .iter()
            .map(|name| Literal::usize_unsuffixed(slots[name]));
        quote!(let (#(#names,)*) = (#(state.shared[#slots],)*);)
    });
    let own = part.own.chunks(NAMES_PER_SCOPE);
    let own = own.map(|names| quote!(let (#(#names,)*);));
    let (arguments, assignments) = (&part.arguments, &part.assignments);
    quote!(#(let #arguments = &state.#arguments;)* #(#shared)* #(#own)* #(#assignments)*)
}

#[cfg(test)]
mod tests {
    use ulna::Argument;
    use ulna_table::Model;

    use super::*;

    /// Every part reads what it gave a value to before, or what an earlier part has shared; the outputs are complete.
    #[test]
    fn what_a_part_reads_is_there() {
        let model = Model::load("../arms/oblique_6.toml").unwrap();
        for method in crate::compile(&model).methods {
            let writer = Writer::new(&method.program);
            let (named, steps) = (writer.named(), writer.named_steps());
            // What the arm has none of takes no steps, and is not divided.
            if named.is_empty() {
                continue;
            }
            let elements = elements_by_last_name(&writer, &method.program.outputs, &named);
            let arguments = Argument::ALL.map(|argument| format_ident!("{}", argument.name()));
            let (parts, slots) = divide(&writer, &arguments, &named, &elements, 20);
            assert!(parts.len() >= named.len() / 20);

            let mut shared: HashSet<Ident> = slots.keys().cloned().collect();
            shared.retain(|name| !named.iter().any(|(own, _)| own == name));
            let (mut position, mut written) = (0, 0);
            for part in &parts {
                assert!(
                    part.shared.iter().all(|name| shared.contains(name)),
                    "{}",
                    method.method
                );
                let mut known: HashSet<&Ident> =
                    part.shared.iter().chain(&part.arguments).collect();
                for name in &part.own {
                    let mut names = Vec::new();
                    writer.names_in_step(&steps[position], &mut names);
                    assert!(
                        names.iter().all(|name| known.contains(name)),
                        "{}: {name}",
                        method.method
                    );
                    known.insert(name);
                    let mut names = Vec::new();
                    for element in elements.get(&position).into_iter().flatten() {
                        writer.names_in(element.operand, &mut names);
                        written += 1;
                    }
                    assert!(
                        names.iter().all(|name| known.contains(name)),
                        "{}: {name}",
                        method.method
                    );
                    position += 1;
                }
                shared.extend(
                    part.own
                        .iter()
                        .filter(|name| slots.contains_key(name))
                        .cloned(),
                );
            }
            let operands = method
                .program
                .outputs
                .iter()
                .flat_map(|output| &output.elements);
            let zeros = operands
                .clone()
                .filter(|o| **o == Operand::Constant(DoubleDouble::default()))
                .count();
            assert_eq!(written, operands.count() - zeros, "{}", method.method);
        }
    }
}
