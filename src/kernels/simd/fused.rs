//! A double whose multiply-adds are fused: quick only in code compiled for a processor that has the instruction.

use core::ops::Neg;

use bytemuck::{Pod, Zeroable, cast};

use super::avx2::Avx2;
use super::{Double, apart, operators};
use crate::Real;
use crate::kernels::trigonometry::{Quarters, sin_cos};

/// The double.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(super) struct Fused(pub(super) f64);

// SAFETY: a transparent f64.
unsafe impl Zeroable for Fused {}
// SAFETY: a transparent f64.
unsafe impl Pod for Fused {}

impl Double for Fused {}

operators!(Fused:
    Add add |a, b| a + b,
    Sub sub |a, b| a - b,
    Mul mul |a, b| a * b,
    Div div |a, b| a / b);

impl Neg for Fused {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Real for Fused {
    apart!("avx2,fma");

    #[inline(always)]
    fn of(value: f64) -> Self {
        Self(value)
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        Self(self.0.mul_add(factor.0, summand.0))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        sin_cos(self)
    }

    /// Four at a time, since the processor has the lanes, too; a single one by itself.
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Self; K]) -> ([Self; K], [Self; K]) {
        let (mut sines, mut cosines) = (angles, angles);
        let mut start = 0;
        while start + 1 < K {
            let mut four = [angles[start].0; 4];
            for lane in 1..4 {
                if start + lane < K {
                    four[lane] = angles[start + lane].0;
                }
            }
            let (sin, cos) = Avx2::from(four).sin_cos();
            let (sin, cos) = (<[f64; 4]>::from(sin), <[f64; 4]>::from(cos));
            for lane in 0..4 {
                if start + lane < K {
                    sines[start + lane] = Self(sin[lane]);
                    cosines[start + lane] = Self(cos[lane]);
                }
            }
            start += 4;
        }
        if start < K {
            (sines[start], cosines[start]) = angles[start].sin_cos();
        }
        (sines, cosines)
    }
}

impl Quarters for Fused {
    #[inline(always)]
    fn turn(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
        let (sin, cos) = f64::turn(cast(quarters), cast(sin), cast(cos));
        (Self(sin), Self(cos))
    }
}
