//! A method as a function: coordinates, sines and cosines first, then one named value after another, then the results.

use ulna::Payload;

use super::super::plan::{
    Element, Expression, Item, PAYLOAD, Plan, RESULT, VOLUME, coordinate_name, items,
};
use super::lines::{comment, statement};
use super::target::Target;
use super::{documentation, expression, parts};
use crate::schedule::Output;

/// So many zeros among the results are written one by one; of more, all results are set to 0 first.
const ZEROS: usize = 12;

/// The numbers that a function returns.
#[derive(Clone, Copy)]
pub(super) struct Results {
    /// How many parts of the kernel's result they are; a last one that is left over is det(JJᵀ).
    pub(super) parts: usize,
    /// How many there are.
    pub(super) length: usize,
    /// From which on they are 0 where the task is singular.
    pub(super) zero_from: Option<usize>,
}

impl Results {
    pub(super) fn of(plan: &Plan<'_>) -> Self {
        let zero = plan.compiled.method.zero_where_singular();
        let parts = plan.outputs.len() - usize::from(zero.is_some());
        let lengths = || plan.outputs.iter().map(|output| output.elements.len());
        Self {
            parts,
            length: lengths().take(parts).sum(),
            zero_from: zero.map(|part| lengths().take(part).sum()),
        }
    }

    /// Its parts, each with the place of its first number.
    pub(super) fn outputs<'a, 'p>(
        self,
        plan: &'a Plan<'p>,
    ) -> impl Iterator<Item = (&'a Output<Element<'p>>, usize)> {
        let outputs = plan.outputs.iter().take(self.parts);
        outputs.scan(0, |next, output| {
            let first = *next;
            *next += output.elements.len();
            Some((output, first))
        })
    }
}

/// A method on its way to C.
pub(super) struct Function<'a, 'p> {
    pub(super) target: &'a Target<'a>,
    pub(super) plan: &'a Plan<'p>,
    pub(super) results: Results,
}

impl<'a, 'p> Function<'a, 'p> {
    pub(super) fn new(target: &'a Target<'a>, plan: &'a Plan<'p>) -> Self {
        Self {
            target,
            plan,
            results: Results::of(plan),
        }
    }

    pub(super) fn name(&self) -> String {
        self.target.own(self.plan.compiled.method.name())
    }

    /// Its declaration, without a semicolon.
    pub(super) fn signature(&self) -> String {
        let real = self.target.real();
        let arguments = self.plan.arguments.iter();
        let arguments = arguments.filter(|argument| argument.name != PAYLOAD);
        let mut parameters: Vec<String> = arguments
            .map(|argument| format!("const {real} {}[{}]", argument.name, argument.length))
            .collect();
        if self.target.model.has_payload() {
            parameters.push(format!("const {real} {PAYLOAD}[{}]", Payload::PARAMETERS));
        }
        parameters.push(format!("{real} {RESULT}[{}]", self.results.length));
        signature(&self.name(), &parameters)
    }

    /// The prototype with its docs.
    pub(super) fn prototype(&self) -> String {
        let model = self.target.model;
        let payload = model.has_payload().then(|| self.target.own(PAYLOAD));
        let docs = documentation::prototype(self.plan, payload.as_deref());
        format!("{}{};\n", comment(&docs), self.signature())
    }

    /// The function, and the parts that it is made of.
    pub(super) fn definition(&self) -> String {
        let items = self.items();
        let docs = comment(&documentation::definition(self.plan));
        if items.len() > self.target.options.function_length {
            let (parts, body) = parts::parts(self, &items);
            return format!(
                "{docs}{parts}\n{}\n{{\n{}{body}}}\n",
                self.signature(),
                self.unread()
            );
        }
        let mut body = self.unread();
        let real = self.target.real();
        let is_result = |item: &Item| matches!(item, Item::Element(..));
        let (mut results, values): (Vec<Item>, Vec<Item>) = items.into_iter().partition(is_result);
        results.sort_by_key(|item| self.place(*item));
        // Results last: what is read has been read then.
        let first = results.first().copied();
        for item in values.into_iter().chain(results) {
            if Some(item) == first {
                body += &self.cleared();
            }
            let value = self.value(item, &str::to_owned);
            let text = match (item.name(self.plan), self.place(item)) {
                (_, Some(place)) => format!("{RESULT}[{place}] = {value};"),
                (Some(name), _) => format!("const {real} {name} = {value};"),
                (None, None) => format!("const {real} {VOLUME} = {value};"),
            };
            body += &statement(&text);
        }
        body += &self.settled(VOLUME);
        format!("{docs}{}\n{{\n{body}}}\n", self.signature())
    }

    /// What it does, a statement each.
    fn items(&self) -> Vec<Item> {
        let coordinates = self.plan.coordinates.iter();
        let coordinates = coordinates.map(|joint| Item::Coordinate(*joint));
        let angles = self.plan.angles.iter().enumerate();
        let angles = angles.flat_map(|(index, angle)| {
            let sine = angle.sine.is_some().then_some(Item::Sine(index));
            let cosine = angle.cosine.is_some().then_some(Item::Cosine(index));
            [sine, cosine].into_iter().flatten()
        });
        let mut all: Vec<Item> = coordinates.chain(angles).chain(items(self.plan)).collect();
        if !self.clears() {
            all.extend(self.zeros());
        }
        all
    }

    /// The statements that set what is not read, and what is 0 whatever the state.
    fn unread(&self) -> String {
        let arguments = self.plan.arguments.iter();
        let mut unread: Vec<&str> = arguments
            .filter(|argument| !argument.is_read)
            .map(|argument| argument.name)
            .collect();
        if self.results.zero_from.is_some() {
            unread.retain(|name| *name != "q");
        }
        if self.target.model.has_payload() && !self.plan.reads_payload() {
            unread.push(PAYLOAD);
        }
        unread
            .iter()
            .map(|name| format!("    (void){name};\n"))
            .collect()
    }

    /// The results that are 0 whatever the state.
    fn zeros(&self) -> impl Iterator<Item = Item> {
        let outputs = self.plan.outputs.iter().take(self.results.parts);
        outputs.enumerate().flat_map(|(part, output)| {
            let elements = output.elements.iter().enumerate();
            let zeros = elements.filter(|(_, element)| element.is_zero());
            zeros.map(move |(index, _)| Item::Element(part, index))
        })
    }

    /// Whether all results are set to 0 first.
    fn clears(&self) -> bool {
        self.zeros().count() > ZEROS
    }

    pub(super) fn cleared(&self) -> String {
        if self.clears() {
            format!(
                "    {}({RESULT}, {}U);\n",
                self.target.own("clear"),
                self.results.length
            )
        } else {
            String::new()
        }
    }

    /// Where the task is singular, zeros; `volume` is where det(JJᵀ) stands.
    pub(super) fn settled(&self, volume: &str) -> String {
        let Some(first) = self.results.zero_from else {
            return String::new();
        };
        let has_volume = self
            .plan
            .outputs
            .last()
            .is_some_and(|output| output.elements.iter().any(|element| !element.is_zero()));
        let zero = self.target.number(0.0);
        format!(
            "    if ({singular}(q, {volume}))\n    {{\n        {clear}(&{RESULT}[{first}], {count}U);\n    }}\n",
            singular = self.target.own("is_singular"),
            clear = self.target.own("clear"),
            volume = if has_volume { volume } else { &zero },
            count = self.results.length - first,
        )
    }

    /// What an item computes.
    pub(super) fn value(&self, item: Item, name: &dyn Fn(&str) -> String) -> String {
        let write = |expression: &Expression| expression::text(self.target, expression, name);
        let angle = |function: &str, index: usize| {
            let angle = &self.plan.angles[index];
            let mut terms: Vec<String> = angle
                .joints
                .iter()
                .map(|joint| name(&coordinate_name(*joint)))
                .collect();
            if angle.offset != 0.0 {
                terms.push(self.target.number(angle.offset));
            }
            format!("{}({})", self.target.math(function), terms.join(" + "))
        };
        match item {
            Item::Coordinate(joint) => {
                let read = if self.target.is_prismatic(joint) {
                    "offset"
                } else {
                    "angle"
                };
                format!("{}(q[{joint}])", self.target.own(read))
            }
            Item::Sine(index) => angle("sin", index),
            Item::Cosine(index) => angle("cos", index),
            Item::Value(index) => write(&self.plan.values[index].expression),
            Item::Element(part, index) => {
                write(&self.plan.outputs[part].elements[index].expression)
            }
        }
    }

    /// The place of an element among the results; none for det(JJᵀ).
    pub(super) fn place(&self, item: Item) -> Option<usize> {
        let Item::Element(part, index) = item else {
            return None;
        };
        let (_, first) = self.results.outputs(self.plan).nth(part)?;
        Some(first + index)
    }
}

/// A function's declaration, on one line if it fits there.
pub(super) fn signature(name: &str, parameters: &[String]) -> String {
    let one = format!("void {name}({})", parameters.join(", "));
    if one.len() <= 100 {
        one
    } else {
        format!("void {name}(\n    {})", parameters.join(",\n    "))
    }
}
