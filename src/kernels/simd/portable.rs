//! Lanes of the crate `wide`, for every machine; which instructions they are is settled when the program is compiled.

use bytemuck::cast;
use wide::{f64x2, f64x4};

use super::{BLOCK, Lanes, MAX_WIDTH};
use crate::Real;
use crate::kernels::trigonometry::{self, Quarters};

impl Real for f64x4 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self::splat(value)
    }

    /// Fused where one double's are, and nowhere else: the results are the same to the bit.
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        #[cfg(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")))]
        return self.mul_add(factor, summand);
        #[cfg(not(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64"))))]
        return self * factor + summand;
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        trigonometry::sin_cos(self)
    }
}

impl Lanes for f64x4 {
    const WIDTH: usize = 4;

    #[inline(always)]
    fn load(numbers: &[f64; MAX_WIDTH]) -> Self {
        let [a, b, c, d, ..] = *numbers;
        Self::from([a, b, c, d])
    }

    #[inline(always)]
    fn store(self) -> [f64; MAX_WIDTH] {
        let mut numbers = [0.0; MAX_WIDTH];
        numbers[..4].copy_from_slice(&self.to_array());
        numbers
    }

    /// By pairs of numbers and pairs of lanes, which are registers on most machines.
    #[inline(always)]
    fn transpose(block: &[Self; BLOCK]) -> [[f64; BLOCK]; MAX_WIDTH] {
        let mut rows = [[0.0; BLOCK]; MAX_WIDTH];
        for start in [0, 2, 4, 6] {
            let (a, b): ([f64x2; 2], [f64x2; 2]) = (cast(block[start]), cast(block[start + 1]));
            for half in 0..2 {
                let pair = f64x2::transpose([a[half], b[half]]);
                for lane in 0..2 {
                    rows[2 * half + lane][start..][..2].copy_from_slice(&pair[lane].to_array());
                }
            }
        }
        rows
    }
}

/// Lane by lane, as one double does it: the results are the same to the bit.
impl Quarters for f64x4 {
    #[inline(always)]
    fn turn(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
        let (quarters, mut sin, mut cos) = (quarters.to_array(), sin.to_array(), cos.to_array());
        for (i, quarters) in quarters.into_iter().enumerate() {
            (sin[i], cos[i]) = f64::turn(quarters, sin[i], cos[i]);
        }
        (Self::from(sin), Self::from(cos))
    }
}
