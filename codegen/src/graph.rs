//! The expression graph: hash-consed, so that equal expressions are one node, and folded while it is built.
//!
//! After this point: no expression stands twice, no constant is left to compute, no sum or product has a neutral
//! or absorbing operand, and signs have moved outwards as far as sums, where they are free.

use std::cell::RefCell;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fmt;

use rustc_hash::FxHashMap;
use ulna::Real;

use crate::double_double::DoubleDouble;
use crate::label::{Label, subscripts};
use crate::op::Op;

/// A node's place in the graph. Arguments always stand before the nodes that use them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(u32);

impl Id {
    /// The place as an index.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number, by the bits of its two doubles.
    Constant([u64; 2]),
    /// An argument of the function to be generated.
    Input(Input),
    /// An operator over earlier nodes; a unary one repeats its argument.
    Apply(Op, Id, Id),
}

/// An argument of a generated function. Joints and angles count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Input {
    /// Coordinate of a prismatic joint.
    Q(usize),
    /// Sine of an angle of the graph.
    Sin(usize),
    /// Cosine of an angle of the graph.
    Cos(usize),
    /// Velocity of a joint.
    Qd(usize),
    /// Acceleration of a joint.
    Qdd(usize),
    /// Torque of a joint.
    Tau(usize),
    /// Component of the wrench on the tool, linear first.
    Wrench(usize),
    /// Inertial parameter of the payload about the origin of the last link's frame, in the order of
    /// [`ulna::Payload::parameters`].
    Payload(usize),
}

/// The sum of the coordinates of some revolute joints, plus a constant that is no quarter turn.
///
/// Joints about parallel axes turn what hangs on them by their sum; one sine and cosine of the sum
/// replace the products that the angles one by one would need.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AngleSum {
    /// The joints, ascending.
    pub joints: Vec<usize>,
    /// The constant, rad.
    pub offset: DoubleDouble,
}

impl AngleSum {
    /// The angle at the joints' coordinates `q`, rad.
    pub fn at<R: Real>(&self, q: impl Fn(usize) -> R, of: impl Fn(DoubleDouble) -> R) -> R {
        let joints = self.joints.iter().map(|i| q(*i));
        joints
            .reduce(|sum, x| sum + x)
            .map_or_else(|| of(self.offset), |sum| sum + of(self.offset))
    }
}

/// The graph. Expressions borrow it, so that formulas can be written with operators.
#[derive(Default)]
pub struct Graph {
    nodes: RefCell<Vec<Node>>,
    /// Looked up for every expression that is formed, and never iterated: by a quick hash.
    places: RefCell<FxHashMap<Node, Id>>,
    angles: RefCell<Vec<AngleSum>>,
    labels: RefCell<HashMap<Id, Label>>,
    /// Whether names are kept.
    has_labels: bool,
}

impl fmt::Debug for Graph {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Graph of {} nodes", self.len())
    }
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self {
            has_labels: true,
            ..Self::default()
        }
    }

    /// An empty graph whose expressions have no names: for programs that are compared, and not read.
    pub(crate) fn without_labels() -> Self {
        Self::default()
    }

    /// Whether expressions keep names.
    pub(crate) fn has_labels(&self) -> bool {
        self.has_labels
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.nodes.borrow().len()
    }

    /// Whether there is no node.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The node at a place of this graph.
    pub fn node(&self, id: Id) -> Node {
        self.nodes.borrow()[id.index()]
    }

    /// The expression at a place of this graph.
    pub fn expr(&self, id: Id) -> Expr<'_> {
        Expr { graph: self, id }
    }

    /// A number.
    pub fn constant(&self, value: impl Into<DoubleDouble>) -> Expr<'_> {
        self.intern(Node::Constant(value.into().to_bits()))
    }

    /// An argument of the generated function.
    pub fn input(&self, input: Input) -> Expr<'_> {
        self.intern(Node::Input(input))
    }

    /// Sine and cosine of a sum of joint angles.
    pub fn sin_cos(&self, angle: &AngleSum) -> (Expr<'_>, Expr<'_>) {
        let known = self.angles.borrow().iter().position(|a| a == angle);
        let index = known.unwrap_or_else(|| {
            self.angles.borrow_mut().push(angle.clone());
            self.angles.borrow().len() - 1
        });
        (self.input(Input::Sin(index)), self.input(Input::Cos(index)))
    }

    /// The angle behind [`Input::Sin`] and [`Input::Cos`].
    pub fn angle(&self, index: usize) -> AngleSum {
        self.angles.borrow()[index].clone()
    }

    /// What the value at a place is called, if it has a name.
    pub fn label(&self, id: Id) -> Option<Label> {
        self.labels.borrow().get(&id).cloned()
    }

    pub(crate) fn intern(&self, node: Node) -> Expr<'_> {
        let id = *self.places.borrow_mut().entry(node).or_insert_with(|| {
            let mut nodes = self.nodes.borrow_mut();
            nodes.push(node);
            Id(u32::try_from(nodes.len() - 1).expect("a graph of fewer than 2^32 nodes"))
        });
        self.expr(id)
    }

    pub(crate) fn find(&self, node: Node) -> Option<Expr<'_>> {
        self.places.borrow().get(&node).map(|id| self.expr(*id))
    }
}

/// An expression of a graph.
#[derive(Clone, Copy)]
pub struct Expr<'g> {
    graph: &'g Graph,
    id: Id,
}

impl PartialEq for Expr<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl fmt::Debug for Expr<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.graph.node(self.id))
    }
}

impl<'g> Expr<'g> {
    /// The expression's place.
    pub fn id(self) -> Id {
        self.id
    }

    /// The graph that the expression belongs to.
    pub fn graph(self) -> &'g Graph {
        self.graph
    }

    /// A number of the same graph.
    pub fn of(self, value: impl Into<DoubleDouble>) -> Self {
        self.graph.constant(value)
    }

    /// The value, if it is a number.
    pub fn value(self) -> Option<DoubleDouble> {
        match self.graph.node(self.id) {
            Node::Constant(bits) => Some(DoubleDouble::from_bits(bits)),
            _ => None,
        }
    }

    /// Whether the expression is the number 0.
    pub fn is_zero(self) -> bool {
        self.value().is_some_and(|value| value == 0.0)
    }

    /// The same expression, called `family` and the indices in the generated code, counted from 1 there: `m_2_3`;
    /// where it is minus something, that is called the same with `_neg`.
    ///
    /// A name changes nothing else. The first one stays; numbers and arguments have none.
    pub fn named(self, family: &'static str, indices: &[usize]) -> Self {
        self.labelled(family, || format!("{family}{}", subscripts(indices)))
    }

    /// As [`named`](Self::named), by any name: an identifier in ASCII.
    pub fn labelled(self, family: &'static str, text: impl FnOnce() -> String) -> Self {
        if !self.graph.has_labels || !matches!(self.graph.node(self.id), Node::Apply(..)) {
            return self;
        }
        let mut labels = self.graph.labels.borrow_mut();
        if let Entry::Vacant(vacant) = labels.entry(self.id) {
            let text = text();
            let label = |text| Label { family, text };
            // What stands behind a sign is as good a value.
            if let Some(positive) = self.negated() {
                vacant.insert(label(text.clone()));
                let text = format!("{text}_neg");
                labels.entry(positive.id).or_insert(label(text));
            } else {
                vacant.insert(label(text));
            }
        }
        self
    }

    /// The square root.
    pub fn sqrt(self) -> Self {
        match self.value() {
            Some(value) => self.of(value.sqrt()),
            None => self.node(Op::Sqrt, self),
        }
    }

    pub(crate) fn node(self, op: Op, other: Self) -> Self {
        self.graph.intern(Node::Apply(op, self.id, other.id))
    }

    pub(crate) fn sorted(self, other: Self) -> (Self, Self) {
        if self.id <= other.id {
            (self, other)
        } else {
            (other, self)
        }
    }

    /// The arguments, if the expression is `op` over them.
    pub fn arguments(self, op: Op) -> Option<(Self, Self)> {
        match self.graph.node(self.id) {
            Node::Apply(own, a, b) if own == op => Some((self.graph.expr(a), self.graph.expr(b))),
            _ => None,
        }
    }

    /// `x` of `-x`.
    pub(crate) fn negated(self) -> Option<Self> {
        self.arguments(Op::Neg).map(|(x, _)| x)
    }

    /// `c` and `x` of `c + x`, `x - c` or `c - x`, where `c` is a number; and of the number itself.
    pub(crate) fn raised(self) -> Option<(DoubleDouble, Self)> {
        if let Some(c) = self.value() {
            return Some((c, self.of(0.0)));
        }
        if let Some((a, b)) = self.arguments(Op::Add) {
            return a.value().map(|c| (c, b)).or(b.value().map(|c| (c, a)));
        }
        let (a, b) = self.arguments(Op::Sub)?;
        a.value().map(|c| (c, -b)).or(b.value().map(|c| (-c, a)))
    }

    /// `c` and `x` of `c * x`, where `c` is a number.
    pub(crate) fn scaled(self) -> Option<(DoubleDouble, Self)> {
        let (a, b) = self.arguments(Op::Mul)?;
        a.value().map(|c| (c, b)).or(b.value().map(|c| (c, a)))
    }
}
