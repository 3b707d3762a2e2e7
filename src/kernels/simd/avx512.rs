//! Eight doubles in AVX-512 registers, multiply-adds fused.

use core::arch::x86_64::*;
use core::ops::Neg;

use super::{BLOCK, Lanes, MAX_WIDTH, apart, operators};
use crate::Real;
use crate::kernels::trigonometry::{Quarters, sin_cos};

/// The lanes. Never made outside functions compiled for the instructions.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(super) struct Avx512(__m512d);

// SAFETY, for every intrinsic of this file: its instructions are there, since only `super::run_batch` makes these lanes,
// after it has asked the processor.

operators!(Avx512:
    Add add |a, b| unsafe { _mm512_add_pd(a, b) },
    Sub sub |a, b| unsafe { _mm512_sub_pd(a, b) },
    Mul mul |a, b| unsafe { _mm512_mul_pd(a, b) },
    Div div |a, b| unsafe { _mm512_div_pd(a, b) });

impl Neg for Avx512 {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        unsafe { Self(_mm512_xor_pd(self.0, _mm512_set1_pd(-0.0))) }
    }
}

impl Real for Avx512 {
    apart!("avx512f,avx512dq");

    #[inline(always)]
    fn of(value: f64) -> Self {
        unsafe { Self(_mm512_set1_pd(value)) }
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        unsafe { Self(_mm512_fmadd_pd(self.0, factor.0, summand.0)) }
    }

    #[inline(always)]
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
        unsafe { Self(_mm512_fmsub_pd(self.0, factor.0, subtrahend.0)) }
    }

    #[inline(always)]
    fn neg_mul_add(self, factor: Self, minuend: Self) -> Self {
        unsafe { Self(_mm512_fnmadd_pd(self.0, factor.0, minuend.0)) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        unsafe { Self(_mm512_sqrt_pd(self.0)) }
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        sin_cos(self)
    }
}

impl Quarters for Avx512 {
    #[inline(always)]
    fn turn(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
        unsafe {
            let count = _mm512_castpd_si512(quarters.0);
            let odd = _mm512_test_epi64_mask(count, _mm512_set1_epi64(1));
            let (a, b) = (
                _mm512_mask_blend_pd(odd, sin.0, cos.0),
                _mm512_mask_blend_pd(odd, cos.0, sin.0),
            );
            let sign = _mm512_castpd_si512(_mm512_set1_pd(-0.0));
            let next = _mm512_add_epi64(count, _mm512_set1_epi64(1));
            let flip_sin = _mm512_and_si512(_mm512_slli_epi64::<62>(count), sign);
            let flip_cos = _mm512_and_si512(_mm512_slli_epi64::<62>(next), sign);
            (
                Self(_mm512_xor_pd(a, _mm512_castsi512_pd(flip_sin))),
                Self(_mm512_xor_pd(b, _mm512_castsi512_pd(flip_cos))),
            )
        }
    }
}

impl Lanes for Avx512 {
    const WIDTH: usize = 8;

    #[inline(always)]
    fn load(numbers: &[f64; MAX_WIDTH]) -> Self {
        unsafe { Self(_mm512_loadu_pd(numbers.as_ptr())) }
    }

    #[inline(always)]
    fn store(self) -> [f64; MAX_WIDTH] {
        let mut numbers = [0.0; MAX_WIDTH];
        unsafe { _mm512_storeu_pd(numbers.as_mut_ptr(), self.0) };
        numbers
    }

    #[inline(always)]
    fn transpose(block: &[Self; BLOCK]) -> [[f64; BLOCK]; MAX_WIDTH] {
        let [a, b, c, d, e, f, g, h] = block;
        unsafe {
            // Pairs of numbers first, then quarters of registers.
            let even = [
                _mm512_unpacklo_pd(a.0, b.0),
                _mm512_unpacklo_pd(c.0, d.0),
                _mm512_unpacklo_pd(e.0, f.0),
                _mm512_unpacklo_pd(g.0, h.0),
            ];
            let odd = [
                _mm512_unpackhi_pd(a.0, b.0),
                _mm512_unpackhi_pd(c.0, d.0),
                _mm512_unpackhi_pd(e.0, f.0),
                _mm512_unpackhi_pd(g.0, h.0),
            ];
            let ([r0, r2, r4, r6], [r1, r3, r5, r7]) = (quarters(even), quarters(odd));
            let mut rows = [[0.0; BLOCK]; MAX_WIDTH];
            for (row, lanes) in rows.iter_mut().zip([r0, r1, r2, r3, r4, r5, r6, r7]) {
                _mm512_storeu_pd(row.as_mut_ptr(), lanes);
            }
            rows
        }
    }
}

/// A 4×4 block of quarter registers, transposed.
#[inline(always)]
fn quarters([a, b, c, d]: [__m512d; 4]) -> [__m512d; 4] {
    unsafe {
        let (ab_low, ab_high) = (
            _mm512_shuffle_f64x2::<0b01_00_01_00>(a, b),
            _mm512_shuffle_f64x2::<0b11_10_11_10>(a, b),
        );
        let (cd_low, cd_high) = (
            _mm512_shuffle_f64x2::<0b01_00_01_00>(c, d),
            _mm512_shuffle_f64x2::<0b11_10_11_10>(c, d),
        );
        [
            _mm512_shuffle_f64x2::<0b10_00_10_00>(ab_low, cd_low),
            _mm512_shuffle_f64x2::<0b11_01_11_01>(ab_low, cd_low),
            _mm512_shuffle_f64x2::<0b10_00_10_00>(ab_high, cd_high),
            _mm512_shuffle_f64x2::<0b11_01_11_01>(ab_high, cd_high),
        ]
    }
}
