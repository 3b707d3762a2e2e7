//! [`Elements`]: children, attributes and numbers of elements; what is missing or wrong is reported, and nothing stops the reading.

use std::cell::RefCell;

use roxmltree::{Attribute, Node};
use ulna_table::diagnostics::{Diagnostic, Sink};

use crate::robot::{Number, Span};
use crate::xml::{is_plain, tag, unexpanded};

/// The elements of one text. A value that is wrong has been reported by the time it is `None`.
pub(crate) struct Elements<'s> {
    text: &'s str,
    sink: &'s Sink,
    /// Where xacro's expressions stand in the place of values.
    unexpanded: RefCell<Vec<Span>>,
}

impl<'s> Elements<'s> {
    pub(crate) fn new(text: &'s str, sink: &'s Sink) -> Self {
        Self {
            text,
            sink,
            unexpanded: RefCell::default(),
        }
    }

    pub(crate) fn push(&self, diagnostic: Diagnostic) {
        self.sink.push(diagnostic);
    }

    /// The name of the element's start tag.
    pub(crate) fn tag(&self, node: Node) -> Span {
        tag(self.text, node)
    }

    /// Notes an element of xacro, or an expression of it.
    pub(crate) fn unexpanded(&self, span: Span) {
        self.unexpanded.borrow_mut().push(span);
    }

    /// The error for what xacro has left, if it has left anything.
    pub(crate) fn xacro(&self) -> Option<Diagnostic> {
        let places = self.unexpanded.borrow();
        let first = places.iter().min_by_key(|span| span.start)?;
        Some(unexpanded(first.clone(), places.len()))
    }

    /// The children `name` of `node`; those with a prefix are not meant.
    pub(crate) fn all<'a, 'i>(
        &self,
        node: Node<'a, 'i>,
        name: &'static str,
    ) -> impl Iterator<Item = Node<'a, 'i>> + use<'a, 'i, 's> {
        let text = self.text;
        node.children()
            .filter(move |child| is_plain(text, *child) && child.tag_name().name() == name)
    }

    /// The child `name` of `node`, which `owner` calls in words; a second one is reported.
    pub(crate) fn only<'a, 'i>(
        &self,
        node: Node<'a, 'i>,
        name: &'static str,
        owner: &str,
    ) -> Option<Node<'a, 'i>> {
        let mut found = self.all(node, name);
        let first = found.next()?;
        if let Some(second) = found.next() {
            self.sink.push(
                Diagnostic::error(self.tag(second), format!("{owner} has a second <{name}>"))
                    .help("which of them counts is not said anywhere: leave one"),
            );
        }
        Some(first)
    }

    /// [`Elements::only`], whose absence is reported.
    pub(crate) fn required<'a, 'i>(
        &self,
        node: Node<'a, 'i>,
        name: &'static str,
        owner: &str,
        example: &str,
    ) -> Option<Node<'a, 'i>> {
        let found = self.only(node, name, owner);
        if found.is_none() {
            self.sink.push(
                Diagnostic::error(self.tag(node), format!("{owner} has no <{name}>"))
                    .help(format!("write {example}")),
            );
        }
        found
    }

    /// The attribute's text, if there is one and nothing is left of xacro in it.
    pub(crate) fn word<'a>(
        &self,
        node: Node<'a, '_>,
        name: &'static str,
        owner: &str,
    ) -> Option<(&'a str, Span)> {
        let Some(attribute) = node.attribute_node(name) else {
            let element = node.tag_name().name();
            let of = match element {
                "robot" | "link" | "joint" => owner.to_owned(),
                _ => format!("<{element}> of {owner}"),
            };
            let message = format!("{of} has no attribute `{name}`");
            self.sink.push(
                Diagnostic::error(self.tag(node), message)
                    .help(format!("write <{element} {name}=\"...\">")),
            );
            return None;
        };
        let span = attribute.range();
        let value = self.expanded(attribute)?;
        Some((value, span))
    }

    /// The attribute's text, unless an expression of xacro stands there.
    fn expanded<'a>(&self, attribute: Attribute<'a, '_>) -> Option<&'a str> {
        let value = attribute.value();
        if value.contains("${") || value.contains("$(") {
            self.unexpanded(attribute.range());
            return None;
        }
        Some(value.trim())
    }

    /// The attribute's number. `Ok(None)` if there is no such attribute, `Err` if it has been reported.
    pub(crate) fn number(
        &self,
        node: Node,
        name: &'static str,
        owner: &str,
    ) -> Result<Option<Number>, Reported> {
        let Some(attribute) = node.attribute_node(name) else {
            return Ok(None);
        };
        let text = self.expanded(attribute).ok_or(Reported)?;
        let value = self.parsed(text, attribute, node, owner).ok_or(Reported)?;
        Ok(Some(Number {
            value,
            span: attribute.range(),
        }))
    }

    /// [`Elements::number`], whose absence is reported.
    pub(crate) fn required_number(
        &self,
        node: Node,
        name: &'static str,
        owner: &str,
    ) -> Option<Number> {
        self.word(node, name, owner)?;
        self.number(node, name, owner).ok().flatten()
    }

    /// Three numbers with spaces between them.
    pub(crate) fn vector(
        &self,
        node: Node,
        name: &'static str,
        owner: &str,
    ) -> Result<Option<[f64; 3]>, Reported> {
        let Some(attribute) = node.attribute_node(name) else {
            return Ok(None);
        };
        let text = self.expanded(attribute).ok_or(Reported)?;
        let parts: Vec<&str> = text.split_whitespace().collect();
        let (element, commas) = (node.tag_name().name(), text.contains(','));
        let Some(parts) = <[&str; 3]>::try_from(parts.as_slice())
            .ok()
            .filter(|_| !commas)
        else {
            let (message, help) = if commas {
                (
                    format!("`{name}` of <{element}> of {owner} has commas in it"),
                    "write three numbers with spaces between them and points in them: \"1.0 0.5 0\"",
                )
            } else {
                (
                    format!(
                        "`{name}` of <{element}> of {owner} must be three numbers, not {}",
                        parts.len()
                    ),
                    "write three numbers with spaces between them, such as \"0 0 1\"",
                )
            };
            self.sink
                .push(Diagnostic::error(attribute.range(), message).help(help));
            return Err(Reported);
        };
        let numbers = parts.map(|part| self.parsed(part, attribute, node, owner));
        match numbers {
            [Some(x), Some(y), Some(z)] => Ok(Some([x, y, z])),
            _ => Err(Reported),
        }
    }

    /// The number that `text` is, a part of `attribute`.
    fn parsed(&self, text: &str, attribute: Attribute, node: Node, owner: &str) -> Option<f64> {
        /// More than any robot has, and little enough that its cubes are doubles; limits may be as large as they like.
        const MOST: f64 = 1e30;
        let number = text.parse::<f64>().ok();
        let (name, element) = (attribute.name(), node.tag_name().name());
        let most = if element == "limit" { f64::MAX } else { MOST };
        if let Some(number) = number.filter(|number| number.abs() <= most) {
            return Some(number);
        }
        let help = if number.is_some_and(f64::is_nan) {
            "write the number; \"nan\" is none"
        } else if number.is_some() {
            "write a number of this world; leave the attribute out where there is no limit"
        } else if text.contains(',') {
            "write a point, not a comma: \"0.5\""
        } else if text.is_empty() {
            "write the number, or leave the attribute out"
        } else {
            "write a decimal number without a unit, such as 0.5 or 1e-3"
        };
        let message = format!("`{name}` of <{element}> of {owner} is no number that can be meant");
        self.sink.push(
            Diagnostic::error(attribute.range(), message)
                .label(format!("`{text}`"))
                .help(help),
        );
        None
    }
}

/// Something is wrong and has been reported.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reported;
