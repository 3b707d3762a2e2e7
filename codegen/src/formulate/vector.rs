//! Three-vectors and symmetric tensors of expressions, and the two turns that a Denavit–Hartenberg row is made of.

use std::ops::{Add, Neg, Sub};

use ulna::{Angle, Real};

use crate::double_double::DoubleDouble;
use crate::graph::{Expr, Graph};
use crate::label::subscripts;

/// A three-vector.
#[derive(Clone, Copy, Debug)]
pub struct Vec3<'g>(pub [Expr<'g>; 3]);

/// A symmetric tensor: xx, yy, zz, xy, xz, yz.
#[derive(Clone, Copy, Debug)]
pub struct Sym3<'g>(pub [Expr<'g>; 6]);

/// Sine and cosine of an angle.
#[derive(Clone, Copy, Debug)]
pub struct Turn<'g> {
    /// Sine.
    pub sin: Expr<'g>,
    /// Cosine.
    pub cos: Expr<'g>,
}

/// The whole number of quarter turns nearest to the angle, and what is left, rad; exactly 0 where [`Angle`] says so.
pub(crate) fn quarter_turns(angle: Angle) -> (i64, DoubleDouble) {
    let (quarters, rest) = angle.quarter_turns();
    let turned = DoubleDouble::HALF_PI * DoubleDouble::of(quarters as f64);
    let rest = if rest == 0.0 {
        DoubleDouble::default()
    } else {
        DoubleDouble::of(angle.radians) - turned
    };
    (quarters, rest)
}

impl<'g> Turn<'g> {
    /// A turn by a fixed angle; exact at quarter turns.
    pub fn by_angle(graph: &'g Graph, angle: Angle) -> Self {
        let (quarters, rest) = quarter_turns(angle);
        Self::by_number(graph, rest).and_quarters(quarters)
    }

    /// A turn by a number, rad.
    pub fn by_number(graph: &'g Graph, angle: DoubleDouble) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self {
            sin: graph.constant(sin),
            cos: graph.constant(cos),
        }
    }

    /// The turn and so many quarter turns more.
    #[must_use]
    pub fn and_quarters(self, quarters: i64) -> Self {
        let Self { sin, cos } = self;
        let (sin, cos) = match quarters.rem_euclid(4) {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        };
        Self { sin, cos }
    }

    /// The turn the other way.
    pub fn inverse(self) -> Self {
        Self {
            sin: -self.sin,
            ..self
        }
    }
}

impl<'g> Vec3<'g> {
    /// A vector of numbers.
    pub fn constant(graph: &'g Graph, v: [f64; 3]) -> Self {
        Self(v.map(|x| graph.constant(x)))
    }

    /// `self × other`.
    pub fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    /// `self · other`.
    pub fn dot(self, other: Self) -> Expr<'g> {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    /// The same vector, its components called `family`, x, y or z, and the indices ([`Expr::named`]): `wx_3`.
    pub fn named(self, family: &'static str, indices: &[usize]) -> Self {
        self.labelled(family, |axis| {
            format!("{family}{axis}{}", subscripts(indices))
        })
    }

    /// The same vector, each component called what `text` makes of x, y or z.
    pub fn labelled(self, family: &'static str, text: impl Fn(&str) -> String) -> Self {
        for (x, axis) in self.0.into_iter().zip(["x", "y", "z"]) {
            x.labelled(family, || text(axis));
        }
        self
    }

    /// Every component times `factor`.
    pub fn scale(self, factor: Expr<'g>) -> Self {
        Self(self.0.map(|x| x * factor))
    }

    /// Rx(turn) times the vector.
    pub fn turn_x(self, Turn { sin, cos }: Turn<'g>) -> Self {
        let [x, y, z] = self.0;
        Self([x, cos * y - sin * z, sin * y + cos * z])
    }

    /// Rz(turn) times the vector.
    pub fn turn_z(self, Turn { sin, cos }: Turn<'g>) -> Self {
        let [x, y, z] = self.0;
        Self([cos * x - sin * y, sin * x + cos * y, z])
    }

    /// A fixed rotation matrix, by rows, times the vector.
    pub fn rotate(self, rows: [[f64; 3]; 3]) -> Self {
        Self(rows.map(|row| Self(row.map(|x| self.0[0].of(x))).dot(self)))
    }
}

impl Add for Vec3<'_> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a + x, b + y, c + z])
    }
}

impl Sub for Vec3<'_> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a - x, b - y, c - z])
    }
}

impl Neg for Vec3<'_> {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

impl<'g> Sym3<'g> {
    /// A tensor of numbers, from the matrix.
    pub fn constant(graph: &'g Graph, m: &[[f64; 3]; 3]) -> Self {
        Self([m[0][0], m[1][1], m[2][2], m[0][1], m[0][2], m[1][2]].map(|x| graph.constant(x)))
    }

    /// The same tensor, each component called what `text` makes of xx, yy, zz, xy, xz or yz.
    pub fn labelled(self, family: &'static str, text: impl Fn(&str) -> String) -> Self {
        for (x, axes) in self.0.into_iter().zip(["xx", "yy", "zz", "xy", "xz", "yz"]) {
            x.labelled(family, || text(axes));
        }
        self
    }

    /// The tensor times a vector.
    pub fn times(self, v: Vec3<'g>) -> Vec3<'g> {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        Vec3([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(|row| Vec3(row).dot(v)))
    }

    /// Rz(turn) I Rz(turn)ᵀ.
    pub fn turn_z(self, turn: Turn<'g>) -> Self {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        let [xx, yy, xy] = turn_plane([xx, yy, xy], turn);
        let Vec3([xz, yz, _]) = Vec3([xz, yz, zz]).turn_z(turn);
        Self([xx, yy, zz, xy, xz, yz])
    }

    /// Rx(turn) I Rx(turn)ᵀ.
    pub fn turn_x(self, turn: Turn<'g>) -> Self {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        let [yy, zz, yz] = turn_plane([yy, zz, yz], turn);
        let Vec3([_, xy, xz]) = Vec3([xx, xy, xz]).turn_x(turn);
        Self([xx, yy, zz, xy, xz, yz])
    }
}

/// The part of a symmetric tensor in the plane of a turn: with `u = c (a − b) − 2 s m`,
/// it becomes `b + c u`, `a − c u` and, mixed, `m + s u`.
fn turn_plane<'g>([a, b, mixed]: [Expr<'g>; 3], Turn { sin, cos }: Turn<'g>) -> [Expr<'g>; 3] {
    // That rests on s² + c² = 1, which the graph knows of numbers only; a quarter turn it would not fold.
    if cos.is_zero() {
        return [b, a, -mixed];
    }
    let u = cos * (a - b) - sin * (a.of(2.0) * mixed);
    [b + cos * u, a - cos * u, mixed + sin * u]
}

impl Add for Sym3<'_> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let mut sum = self.0;
        for (x, y) in sum.iter_mut().zip(other.0) {
            *x = *x + y;
        }
        Self(sum)
    }
}
