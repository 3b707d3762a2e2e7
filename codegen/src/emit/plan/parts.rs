//! A long program in parts, each a function of its own: what each computes, reads, and shares with those after it.
//!
//! What compilers do to a function takes more than linear time in its length; in a debug build, each value has its own place
//! on the stack.

use std::collections::{HashMap, HashSet};

use super::{Plan, coordinate_name};

/// Something that a part does, one statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::emit) enum Item {
    /// Reads the coordinate of a joint.
    Coordinate(usize),
    /// Takes the sine of an angle.
    Sine(usize),
    /// Takes the cosine of an angle.
    Cosine(usize),
    /// Computes a named value.
    Value(usize),
    /// Computes an element of a result: the number of the part, and its place there.
    Element(usize, usize),
}

/// A function in the making.
pub(in crate::emit) struct Part {
    /// What it does, in order.
    pub(in crate::emit) items: Vec<Item>,
    /// The method's arguments that it reads.
    pub(in crate::emit) arguments: Vec<&'static str>,
    /// Names from parts before it, in the order in which they are needed.
    pub(in crate::emit) shared: Vec<String>,
}

/// A method in parts.
pub(in crate::emit) struct Parts {
    pub(in crate::emit) parts: Vec<Part>,
    /// All names that parts share, in the order in which they are needed.
    pub(in crate::emit) shared: Vec<String>,
}

impl Part {
    /// The names that it gives values to, in order.
    pub(in crate::emit) fn own<'a>(
        &'a self,
        plan: &'a Plan<'_>,
    ) -> impl Iterator<Item = String> + 'a {
        self.items.iter().filter_map(|item| item.name(plan))
    }
}

impl Item {
    /// The name that it gives a value to.
    pub(in crate::emit) fn name(self, plan: &Plan<'_>) -> Option<String> {
        match self {
            Self::Coordinate(joint) => Some(coordinate_name(joint)),
            Self::Sine(angle) => plan.angles[angle].sine.clone(),
            Self::Cosine(angle) => plan.angles[angle].cosine.clone(),
            Self::Value(index) => Some(plan.values[index].name.clone()),
            Self::Element(..) => None,
        }
    }

    /// Hands the names of what it reads to `take`, in order.
    fn each_read(self, plan: &Plan<'_>, take: &mut impl FnMut(&str)) {
        match self {
            Self::Coordinate(_) => take("q"),
            Self::Sine(angle) | Self::Cosine(angle) => {
                let joints = plan.angles[angle].joints.iter();
                joints.for_each(|joint| take(&coordinate_name(*joint)));
            }
            Self::Value(index) => plan.values[index].expression.each_read(take),
            Self::Element(part, index) => {
                plan.outputs[part].elements[index]
                    .expression
                    .each_read(take);
            }
        }
    }
}

/// The named values in order, and after each those elements of the results, but for zeros, of which it is the last that they need.
pub(in crate::emit) fn items(plan: &Plan<'_>) -> Vec<Item> {
    let positions: HashMap<&str, usize> = plan
        .values
        .iter()
        .enumerate()
        .map(|(i, value)| (value.name.as_str(), i))
        .collect();
    let mut elements: HashMap<usize, Vec<Item>> = HashMap::new();
    for (part, output) in plan.outputs.iter().enumerate() {
        for (index, element) in output.elements.iter().enumerate() {
            if element.is_zero() {
                continue;
            }
            let mut last = 0;
            element.expression.each_read(&mut |name| {
                last = last.max(positions.get(name).copied().unwrap_or(0));
            });
            let ready = elements.entry(last).or_default();
            ready.push(Item::Element(part, index));
        }
    }
    let mut items = Vec::new();
    for index in 0..plan.values.len().max(1) {
        items.extend((index < plan.values.len()).then_some(Item::Value(index)));
        items.extend(elements.remove(&index).into_iter().flatten());
    }
    items
}

impl Parts {
    /// A part for each of the lists of `items`; `arguments` are those that a part may read.
    pub(in crate::emit) fn new(
        plan: &Plan<'_>,
        items: Vec<Vec<Item>>,
        arguments: &[&'static str],
    ) -> Self {
        let (mut shared, mut known): (Vec<String>, HashSet<String>) = Default::default();
        let parts = items.into_iter().map(|items| {
            let part = Part::new(plan, items, arguments);
            let new = part.shared.iter();
            shared.extend(new.filter(|name| known.insert((*name).clone())).cloned());
            part
        });
        Self {
            parts: parts.collect(),
            shared,
        }
    }
}

impl Part {
    fn new(plan: &Plan<'_>, items: Vec<Item>, arguments: &[&'static str]) -> Self {
        let mut part = Self {
            items,
            arguments: Vec::new(),
            shared: Vec::new(),
        };
        let mut known: HashSet<String> = part.own(plan).collect();
        let mut foreign = Vec::new();
        for item in &part.items {
            item.each_read(plan, &mut |name| {
                if !known.contains(name) {
                    known.insert(name.to_owned());
                    foreign.push(name.to_owned());
                }
            });
        }
        for name in foreign {
            match arguments.iter().find(|argument| **argument == name) {
                Some(argument) => part.arguments.push(argument),
                None => part.shared.push(name),
            }
        }
        part
    }
}

#[cfg(test)]
mod tests {
    use ulna_table::Model;

    use super::super::{Coordinates, PAYLOAD};
    use super::*;

    /// Every part reads what it gave a value to before, or what an earlier part has shared; the outputs are complete.
    #[test]
    fn what_a_part_reads_is_there() {
        let model = Model::load("../arms/oblique_6.toml").unwrap();
        for method in crate::compile(&model).methods {
            let plan = Plan::new(&method, 6, Coordinates::Named);
            let coordinates = plan
                .coordinates
                .iter()
                .map(|joint| Item::Coordinate(*joint));
            let angles = 0..plan.angles.len();
            let angles = angles.flat_map(|angle| [Item::Sine(angle), Item::Cosine(angle)]);
            let all: Vec<Item> = coordinates.chain(angles).chain(items(&plan)).collect();
            let chunks = all.chunks(20).map(<[Item]>::to_vec).collect();
            let arguments = ["q", "qd", "qdd", "tau", "wrench", PAYLOAD];
            let Parts { parts, shared } = Parts::new(&plan, chunks, &arguments);

            let mut known: HashSet<String> = HashSet::new();
            let mut written = HashSet::new();
            for part in &parts {
                assert!(part.shared.iter().all(|name| shared.contains(name)));
                let mut here: HashSet<String> = part.shared.iter().cloned().collect();
                assert!(here.is_subset(&known), "{}", method.method);
                for item in &part.items {
                    item.each_read(&plan, &mut |name| {
                        let is_argument = part.arguments.contains(&name);
                        assert!(
                            is_argument || here.contains(name),
                            "{}: {name}",
                            method.method
                        );
                    });
                    here.extend(item.name(&plan));
                    if let Item::Element(..) = item {
                        assert!(written.insert(format!("{item:?}")));
                    }
                }
                known.extend(part.own(&plan));
            }
            let elements = plan.outputs.iter().flat_map(|output| &output.elements);
            let others = elements.filter(|element| !element.is_zero()).count();
            assert_eq!(written.len(), others, "{}", method.method);
        }
    }
}
