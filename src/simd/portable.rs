//! Lanes of the crate `wide`, for every machine; which instructions they are is settled when the program is compiled.

use wide::{f32x4, f32x8, f64x2, f64x4, f64x8};

use super::Lanes;
use crate::Real;
use crate::trigonometry::{self, Quarters};

macro_rules! wide {
    ($lanes:ident, $scalar:ident, $width:literal, $sin_cos:path) => {
        impl Real for $lanes {
            #[inline(always)]
            fn of(value: f64) -> Self {
                Self::splat(value as $scalar)
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, summand: Self) -> Self {
                self.mul_add(factor, summand)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }
        }

        impl Lanes for $lanes {
            const WIDTH: usize = $width;

            #[inline(always)]
            fn gather(number: impl Fn(usize) -> f64) -> Self {
                let numbers: [$scalar; $width] = core::array::from_fn(|i| number(i) as $scalar);
                Self::from(numbers)
            }

            #[inline(always)]
            fn scatter(self, mut take: impl FnMut(usize, f64)) {
                for (lane, number) in self.to_array().into_iter().enumerate() {
                    take(lane, f64::from(number));
                }
            }
        }
    };
}

wide!(f64x2, f64, 2, trigonometry::sin_cos);
wide!(f64x4, f64, 4, trigonometry::sin_cos);
wide!(f64x8, f64, 8, trigonometry::sin_cos);
wide!(f32x4, f32, 4, f32x4::sin_cos);
wide!(f32x8, f32, 8, f32x8::sin_cos);

/// Lane by lane, as one double does it: the results are the same to the bit.
macro_rules! quarters {
    ($($lanes:ident),+) => {
        $(
            impl Quarters for $lanes {
                #[inline(always)]
                fn turn(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
                    let (quarters, sin, cos) = (quarters.to_array(), sin.to_array(), cos.to_array());
                    let turned = |i: usize| f64::turn(quarters[i], sin[i], cos[i]);
                    (
                        Self::from(core::array::from_fn(|i| turned(i).0)),
                        Self::from(core::array::from_fn(|i| turned(i).1)),
                    )
                }
            }
        )+
    };
}

quarters!(f64x2, f64x4, f64x8);
