//! [`Robot`]: what a description says of links and joints, every number read, every element with its place.

use std::ops::Range;

use nalgebra::Vector3;

use crate::body::Body;
use crate::frame::Frame;

/// A place in the text, in bytes.
pub(crate) type Span = Range<usize>;

/// A robot description.
pub(crate) struct Robot {
    /// The robot's name, if it has one.
    pub(crate) name: Option<String>,
    pub(crate) links: Vec<LinkElement>,
    pub(crate) joints: Vec<JointElement>,
}

/// A `<link>`.
pub(crate) struct LinkElement {
    pub(crate) name: String,
    pub(crate) span: Span,
    pub(crate) inertial: Option<Inertial>,
}

/// An `<inertial>`.
pub(crate) struct Inertial {
    /// The body, in the link's frame.
    pub(crate) body: Body,
    pub(crate) span: Span,
    pub(crate) mass_span: Span,
    pub(crate) inertia_span: Span,
}

/// A `<joint>`.
pub(crate) struct JointElement {
    pub(crate) name: String,
    pub(crate) span: Span,
    pub(crate) motion: Motion,
    pub(crate) parent: Reference,
    pub(crate) child: Reference,
    /// Where the child link's frame stands in the parent link's, at q = 0.
    pub(crate) origin: Origin,
    pub(crate) axis: Axis,
    pub(crate) limit: Option<LimitElement>,
    pub(crate) damping: Option<Number>,
    pub(crate) friction: Option<Number>,
    pub(crate) mimic: Option<Mimic>,
}

/// The name of a link or joint, where something refers to it.
pub(crate) struct Reference {
    pub(crate) name: String,
    pub(crate) span: Span,
}

/// A number and where it stands.
#[derive(Clone)]
pub(crate) struct Number {
    pub(crate) value: f64,
    pub(crate) span: Span,
}

/// The `type` of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Motion {
    Fixed,
    Revolute,
    Continuous,
    Prismatic,
    Planar,
    Floating,
}

impl Motion {
    /// Every type, as it is written.
    pub(crate) const WORDS: [(&'static str, Self); 6] = [
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("fixed", Self::Fixed),
        ("floating", Self::Floating),
        ("planar", Self::Planar),
    ];

    /// Whether the child link can move at all.
    pub(crate) fn moves(self) -> bool {
        self != Self::Fixed
    }

    pub(crate) fn word(self) -> &'static str {
        let found = Self::WORDS.iter().find(|(_, motion)| *motion == self);
        found.map_or("fixed", |(word, _)| word)
    }
}

/// An `<origin>`.
pub(crate) struct Origin {
    pub(crate) frame: Frame,
    pub(crate) span: Span,
    /// As written, rad.
    pub(crate) rpy: [f64; 3],
}

/// An `<axis>`.
pub(crate) struct Axis {
    /// Of length 1, in the joint's frame.
    pub(crate) unit: Vector3<f64>,
    /// As written.
    pub(crate) length: f64,
    pub(crate) span: Span,
}

/// A `<limit>`.
pub(crate) struct LimitElement {
    pub(crate) span: Span,
    pub(crate) lower: Option<Number>,
    pub(crate) upper: Option<Number>,
    pub(crate) effort: Option<Number>,
    pub(crate) velocity: Option<Number>,
}

/// A `<mimic>`: q = multiplier · q of another joint + offset.
pub(crate) struct Mimic {
    pub(crate) joint: Reference,
    pub(crate) multiplier: f64,
    pub(crate) offset: f64,
}

/// A joint's or link's name in a message.
pub(crate) fn quoted(name: &str) -> String {
    format!("`{name}`")
}
