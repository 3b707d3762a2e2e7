//! [`Part`]: what results look like as arrays, from the types in the table of methods.

use std::sync::LazyLock;

use pyo3::prelude::*;
use ulna::Method;
use ulna::nalgebra::{IsometryMatrix3, SMatrix};

/// Stands for the number of joints in the types of the table: no arm has so many, and nothing else is so long.
const JOINTS: usize = 97;

/// How long an axis of an array is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Length {
    /// A number for each joint.
    Joints,
    /// Always so many.
    Fixed(usize),
}

impl Length {
    const fn of(length: usize) -> Self {
        match length {
            JOINTS => Self::Joints,
            length => Self::Fixed(length),
        }
    }

    pub(crate) const fn at(self, joints: usize) -> usize {
        match self {
            Self::Joints => joints,
            Self::Fixed(length) => length,
        }
    }

    fn symbol(self) -> String {
        match self {
            Self::Joints => "n".to_owned(),
            Self::Fixed(length) => length.to_string(),
        }
    }
}

/// What stands in a part, once or in a list.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Number,
    Vector(Length),
    /// Rows and columns.
    Matrix(Length, Length),
    /// The first three rows of a homogeneous matrix as it is computed, by columns; 4×4 as an array.
    Pose,
}

/// A part of a result: an array of its own.
#[derive(Clone, Copy)]
pub(crate) struct Part {
    /// How many there are of it, if it is a list.
    list: Option<Length>,
    pub(crate) kind: Kind,
}

/// Numbers of a pose as it is computed, and in an array.
pub(crate) const POSE: [usize; 2] = [12, 16];

impl Part {
    fn of(kind: Kind) -> Self {
        Self { list: None, kind }
    }

    fn axes(&self) -> Vec<Length> {
        let kind = match self.kind {
            Kind::Number => Vec::new(),
            Kind::Vector(length) => vec![length],
            Kind::Matrix(rows, columns) => vec![rows, columns],
            Kind::Pose => vec![Length::Fixed(4); 2],
        };
        self.list.into_iter().chain(kind).collect()
    }

    /// The shape of a state's array.
    pub(crate) fn shape(&self, joints: usize) -> Vec<usize> {
        self.axes().iter().map(|axis| axis.at(joints)).collect()
    }

    /// How many numbers are computed for it.
    pub(crate) fn computed(&self, joints: usize) -> usize {
        let count = self.in_array(joints);
        match self.kind {
            Kind::Pose => count / POSE[1] * POSE[0],
            _ => count,
        }
    }

    /// How many numbers its array has.
    pub(crate) fn in_array(&self, joints: usize) -> usize {
        self.shape(joints).iter().product()
    }

    /// Whether its last two axes are a matrix's, which is computed by columns.
    pub(crate) fn is_matrix(&self) -> bool {
        matches!(self.kind, Kind::Matrix(..))
    }
}

/// A type of the table of methods, in its parts.
trait Parts {
    fn parts() -> Vec<Part>;
}

impl Parts for f64 {
    fn parts() -> Vec<Part> {
        vec![Part::of(Kind::Number)]
    }
}

impl<const R: usize, const C: usize> Parts for SMatrix<f64, R, C> {
    fn parts() -> Vec<Part> {
        vec![Part::of(match C {
            1 => Kind::Vector(Length::of(R)),
            _ => Kind::Matrix(Length::of(R), Length::of(C)),
        })]
    }
}

impl Parts for IsometryMatrix3<f64> {
    fn parts() -> Vec<Part> {
        vec![Part::of(Kind::Pose)]
    }
}

impl<T: Parts, const K: usize> Parts for [T; K] {
    fn parts() -> Vec<Part> {
        let listed = |part| Part {
            list: Some(Length::of(K)),
            ..part
        };
        T::parts().into_iter().map(listed).collect()
    }
}

impl<A: Parts, B: Parts> Parts for (A, B) {
    fn parts() -> Vec<Part> {
        [A::parts(), B::parts()].concat()
    }
}

impl<A: Parts, B: Parts, C: Parts> Parts for (A, B, C) {
    fn parts() -> Vec<Part> {
        [A::parts(), B::parts(), C::parts()].concat()
    }
}

macro_rules! define_parts {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident $arguments:tt -> $output:ty
        $({ $($rest:tt)* })*
    )+) => {
        /// Of every method, in the order of the table.
        static PARTS: LazyLock<Vec<Vec<Part>>> =
            LazyLock::new(|| vec![$(<$output as Parts>::parts()),+]);
    };
}

ulna::methods! { [97] define_parts {} }

/// The parts of a method's result.
pub(crate) fn parts(method: Method) -> &'static [Part] {
    &PARTS[method as usize]
}

/// A method as Python tells of it: name, arguments with their meaning, documentation, and the axes of each part.
type Row = (
    &'static str,
    Vec<(&'static str, &'static str)>,
    &'static [&'static str],
    Vec<Vec<String>>,
);

/// The table of methods: of each its name, its arguments with their meaning, its documentation in lines, and the shapes of its
/// parts, `n` standing for the number of joints.
#[pyfunction]
pub(crate) fn methods() -> Vec<Row> {
    let symbols = |part: &Part| part.axes().iter().map(|axis| axis.symbol()).collect();
    let row = |method: &Method| {
        let arguments = method.arguments().iter();
        (
            method.name(),
            arguments.map(|it| (it.name(), it.meaning())).collect(),
            method.documentation(),
            parts(*method).iter().map(symbols).collect(),
        )
    };
    Method::ALL.iter().map(row).collect()
}
