//! Four doubles in AVX2 registers, multiply-adds fused.

use core::arch::x86_64::*;
use core::ops::Neg;

use super::{BLOCK, Lanes, MAX_WIDTH, apart, operators};
use crate::Real;
use crate::kernels::trigonometry::{Quarters, sin_cos};

/// The lanes. Never made outside functions compiled for the instructions.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(super) struct Avx2(__m256d);

// SAFETY, for every intrinsic of this file: its instructions are there, since only `super::run_batch` makes these lanes,
// after it has asked the processor.

operators!(Avx2:
    Add add |a, b| unsafe { _mm256_add_pd(a, b) },
    Sub sub |a, b| unsafe { _mm256_sub_pd(a, b) },
    Mul mul |a, b| unsafe { _mm256_mul_pd(a, b) },
    Div div |a, b| unsafe { _mm256_div_pd(a, b) });

impl Neg for Avx2 {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        unsafe { Self(_mm256_xor_pd(self.0, _mm256_set1_pd(-0.0))) }
    }
}

impl Real for Avx2 {
    apart!("avx2,fma");

    #[inline(always)]
    fn of(value: f64) -> Self {
        unsafe { Self(_mm256_set1_pd(value)) }
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        unsafe { Self(_mm256_fmadd_pd(self.0, factor.0, summand.0)) }
    }

    #[inline(always)]
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
        unsafe { Self(_mm256_fmsub_pd(self.0, factor.0, subtrahend.0)) }
    }

    #[inline(always)]
    fn neg_mul_add(self, factor: Self, minuend: Self) -> Self {
        unsafe { Self(_mm256_fnmadd_pd(self.0, factor.0, minuend.0)) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        unsafe { Self(_mm256_sqrt_pd(self.0)) }
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        sin_cos(self)
    }
}

impl Quarters for Avx2 {
    #[inline(always)]
    fn turn(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
        unsafe {
            let count = _mm256_castpd_si256(quarters.0);
            let odd = _mm256_castsi256_pd(_mm256_slli_epi64::<63>(count));
            let (a, b) = (
                _mm256_blendv_pd(sin.0, cos.0, odd),
                _mm256_blendv_pd(cos.0, sin.0, odd),
            );
            let sign = _mm256_castpd_si256(_mm256_set1_pd(-0.0));
            let next = _mm256_add_epi64(count, _mm256_set1_epi64x(1));
            let flip_sin = _mm256_and_si256(_mm256_slli_epi64::<62>(count), sign);
            let flip_cos = _mm256_and_si256(_mm256_slli_epi64::<62>(next), sign);
            (
                Self(_mm256_xor_pd(a, _mm256_castsi256_pd(flip_sin))),
                Self(_mm256_xor_pd(b, _mm256_castsi256_pd(flip_cos))),
            )
        }
    }
}

impl From<[f64; 4]> for Avx2 {
    #[inline(always)]
    fn from([a, b, c, d]: [f64; 4]) -> Self {
        unsafe { Self(_mm256_setr_pd(a, b, c, d)) }
    }
}

impl From<Avx2> for [f64; 4] {
    #[inline(always)]
    fn from(lanes: Avx2) -> Self {
        let mut numbers = [0.0; 4];
        unsafe { _mm256_storeu_pd(numbers.as_mut_ptr(), lanes.0) };
        numbers
    }
}

impl Lanes for Avx2 {
    const WIDTH: usize = 4;

    #[inline(always)]
    fn load(numbers: &[f64; MAX_WIDTH]) -> Self {
        unsafe { Self(_mm256_loadu_pd(numbers.as_ptr())) }
    }

    #[inline(always)]
    fn store(self) -> [f64; MAX_WIDTH] {
        let mut numbers = [0.0; MAX_WIDTH];
        unsafe { _mm256_storeu_pd(numbers.as_mut_ptr(), self.0) };
        numbers
    }

    /// By pairs of numbers: nothing crosses the halves of a register but the stores.
    #[inline(always)]
    fn transpose(block: &[Self; BLOCK]) -> [[f64; BLOCK]; MAX_WIDTH] {
        let mut rows = [[0.0; BLOCK]; MAX_WIDTH];
        for start in [0, 2, 4, 6] {
            let (a, b) = (block[start].0, block[start + 1].0);
            unsafe {
                let (even, odd) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
                let halves = [
                    _mm256_castpd256_pd128(even),
                    _mm256_castpd256_pd128(odd),
                    _mm256_extractf128_pd::<1>(even),
                    _mm256_extractf128_pd::<1>(odd),
                ];
                for lane in 0..4 {
                    _mm_storeu_pd(rows[lane][start..][..2].as_mut_ptr(), halves[lane]);
                }
            }
        }
        rows
    }
}
