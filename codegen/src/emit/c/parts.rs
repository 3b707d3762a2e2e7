//! A long method in parts: static functions that are called one after another, and hand on what they share in a structure.

use std::collections::HashSet;

use super::super::plan::{Item, Part, Parts, RESULT, VOLUME};
use super::function::{Function, signature};
use super::lines::statement;

/// What the functions of all parts read of the caller's.
const STATE: &str = "state";

/// The structure and the functions of the parts, and the statements that call them.
pub(super) fn parts(function: &Function<'_, '_>, items: &[Item]) -> (String, String) {
    let (plan, target) = (function.plan, function.target);
    let longest = target.options.function_length;
    let length = items.len().div_ceil(items.len().div_ceil(longest));
    let chunks = items.chunks(length).map(<[Item]>::to_vec).collect();
    let arguments: Vec<&'static str> = plan
        .arguments
        .iter()
        .map(|argument| argument.name)
        .collect();
    let divided = Parts::new(plan, chunks, &arguments);
    let shared: HashSet<&str> = divided.shared.iter().map(String::as_str).collect();

    let has_volume = items.iter().any(|item| is_volume(function, *item));
    let mut members = divided.shared.clone();
    members.extend(has_volume.then(|| VOLUME.to_owned()));
    let real = target.real();
    let name = function.name();
    let mut text = String::new();
    if !members.is_empty() {
        let members = members.iter().map(|name| format!("    {real} {name};\n"));
        let members: String = members.collect();
        text += &format!(
            "/* What the parts of {name} share. */\ntypedef struct\n{{\n{members}}} {name}_state;\n\n"
        );
    }
    let mut calls = String::new();
    if !members.is_empty() {
        calls += &format!("    {name}_state {STATE};\n");
    }
    calls += &function.cleared();
    for (number, part) in (1..).zip(&divided.parts) {
        let part = PartFunction {
            function,
            part,
            shared: &shared,
            name: format!("{name}_part_{number}"),
        };
        text += &part.definition();
        calls += &part.call();
    }
    calls += &function.settled(&format!("{STATE}.{VOLUME}"));
    (text, calls)
}

/// Whether an item is det(JJᵀ), which is no result.
fn is_volume(function: &Function<'_, '_>, item: Item) -> bool {
    matches!(item, Item::Element(..)) && function.place(item).is_none()
}

/// The function of a part.
struct PartFunction<'a> {
    function: &'a Function<'a, 'a>,
    part: &'a Part,
    shared: &'a HashSet<&'a str>,
    name: String,
}

impl PartFunction<'_> {
    fn is_shared(&self, item: Item) -> bool {
        let name = item.name(self.function.plan);
        name.is_some_and(|name| self.shared.contains(name.as_str()))
            || is_volume(self.function, item)
    }

    /// Whether it hands something on.
    fn shares(&self) -> bool {
        self.part.items.iter().any(|item| self.is_shared(*item))
    }

    fn reads_state(&self) -> bool {
        !self.part.shared.is_empty()
    }

    fn has_results(&self) -> bool {
        let mut items = self.part.items.iter();
        items.any(|item| self.function.place(*item).is_some())
    }

    /// It has its shared values in the structure, and all others to itself.
    fn definition(&self) -> String {
        let real = self.function.target.real();
        let mut parameters = Vec::new();
        if self.shares() || self.reads_state() {
            let constant = if self.shares() { "" } else { "const " };
            let state = format!("{}_state", self.function.name());
            parameters.push(format!("{constant}{state} *{STATE}"));
        }
        let arguments = self.function.plan.arguments.iter();
        let read = arguments.filter(|argument| self.part.arguments.contains(&argument.name));
        parameters.extend(
            read.map(|argument| format!("const {real} {}[{}]", argument.name, argument.length)),
        );
        if self.has_results() {
            parameters.push(format!("{real} {RESULT}[{}]", self.function.results.length));
        }
        let member = |name: &str| {
            if self.shared.contains(name) {
                format!("{STATE}->{name}")
            } else {
                name.to_owned()
            }
        };
        let statements = self.part.items.iter().map(|item| {
            let value = self.function.value(*item, &member);
            let place = self.function.place(*item);
            statement(&match (item.name(self.function.plan), place) {
                (_, Some(place)) => format!("{RESULT}[{place}] = {value};"),
                (None, None) => format!("{STATE}->{VOLUME} = {value};"),
                (Some(name), _) if self.is_shared(*item) => format!("{} = {value};", member(&name)),
                (Some(name), _) => format!("const {real} {name} = {value};"),
            })
        });
        let statements: String = statements.collect();
        let signature = signature(&self.name, &parameters);
        format!("static {signature}\n{{\n{statements}}}\n\n")
    }

    fn call(&self) -> String {
        let mut values = Vec::new();
        if self.shares() || self.reads_state() {
            values.push(format!("&{STATE}"));
        }
        let arguments = self.function.plan.arguments.iter();
        let read = arguments.filter(|argument| self.part.arguments.contains(&argument.name));
        values.extend(read.map(|argument| argument.name.to_owned()));
        if self.has_results() {
            values.push(RESULT.to_owned());
        }
        format!("    {}({});\n", self.name, values.join(", "))
    }
}
