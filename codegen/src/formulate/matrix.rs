//! Three-by-three matrices of expressions that need not be symmetric.

use super::vector::{Turn, Vec3};
use crate::graph::Expr;

/// A matrix, by rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mat3<'g>(pub(super) [Vec3<'g>; 3]);

impl<'g> Mat3<'g> {
    /// From its columns.
    pub(super) fn of_columns([a, b, c]: [Vec3<'g>; 3]) -> Self {
        Self([0, 1, 2].map(|i| Vec3([a.0[i], b.0[i], c.0[i]])))
    }

    /// `a·b 1 − a bᵀ`.
    pub(super) fn trace_less_outer(a: Vec3<'g>, b: Vec3<'g>) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (a.0, b.0);
        let (x, y, z) = (ax * bx, ay * by, az * bz);
        Self([
            Vec3([y + z, -(ax * by), -(ax * bz)]),
            Vec3([-(ay * bx), x + z, -(ay * bz)]),
            Vec3([-(az * bx), -(az * by), x + y]),
        ])
    }

    /// Entry by entry.
    pub(super) fn plus(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a + x, b + y, c + z])
    }

    /// Rz(turn) M Rz(turn)ᵀ.
    pub(super) fn turn_z(self, turn: Turn<'g>) -> Self {
        let [Vec3([xx, xy, xz]), Vec3([yx, yy, yz]), Vec3([zx, zy, zz])] = self.0;
        let [xx, xy, yx, yy] = turn_plane([xx, xy, yx, yy], turn);
        let Vec3([xz, yz, _]) = Vec3([xz, yz, zz]).turn_z(turn);
        let Vec3([zx, zy, _]) = Vec3([zx, zy, zz]).turn_z(turn);
        Self([Vec3([xx, xy, xz]), Vec3([yx, yy, yz]), Vec3([zx, zy, zz])])
    }

    /// Rx(turn) M Rx(turn)ᵀ.
    pub(super) fn turn_x(self, turn: Turn<'g>) -> Self {
        let [Vec3([xx, xy, xz]), Vec3([yx, yy, yz]), Vec3([zx, zy, zz])] = self.0;
        let [yy, yz, zy, zz] = turn_plane([yy, yz, zy, zz], turn);
        let Vec3([_, xy, xz]) = Vec3([xx, xy, xz]).turn_x(turn);
        let Vec3([_, yx, zx]) = Vec3([xx, yx, zx]).turn_x(turn);
        Self([Vec3([xx, xy, xz]), Vec3([yx, yy, yz]), Vec3([zx, zy, zz])])
    }
}

/// The part `[[a, b], [c, d]]` of a matrix in the plane of a turn: with `u = cos (a − d) − sin (b + c)`
/// it becomes `[[d + cos u, b + sin u], [c + sin u, a − cos u]]`.
fn turn_plane<'g>([a, b, c, d]: [Expr<'g>; 4], Turn { sin, cos }: Turn<'g>) -> [Expr<'g>; 4] {
    // That rests on s² + c² = 1, which the graph knows of numbers only; a quarter turn it would not fold.
    if cos.is_zero() {
        return [d, -c, -b, a];
    }
    let u = cos * (a - d) - sin * (b + c);
    [d + cos * u, b + sin * u, c + sin * u, a - cos * u]
}
