//! Sines and cosines of any number of angles, in lanes: for code that is not compiled with the program.

use core::ops::Range;

use super::simd::{self, BatchCall, Call, Double, Lanes, MAX_WIDTH};

/// Sines and cosines of the angles, each within ±2²⁶ rad: to the bit what generated kernels have for theirs.
///
/// Quickest for multiples of four. What is longer than the shortest of the three is left alone.
pub fn sin_cos_all(angles: &[f64], sines: &mut [f64], cosines: &mut [f64]) {
    let count = angles.len().min(sines.len()).min(cosines.len());
    let mut run = Run {
        angles: &angles[..count],
        sines: &mut sines[..count],
        cosines: &mut cosines[..count],
    };
    simd::run_batch(&mut run, count);
}

struct Run<'a> {
    angles: &'a [f64],
    sines: &'a mut [f64],
    cosines: &'a mut [f64],
}

impl BatchCall for Run<'_> {
    const LEAST_WIDTH: usize = 2;

    #[inline(always)]
    fn in_lanes<R: Lanes>(&mut self, angles: Range<usize>) {
        for start in angles.clone().step_by(R::WIDTH) {
            let start = start.min(angles.end - R::WIDTH);
            let mut numbers = [0.0; MAX_WIDTH];
            numbers[..R::WIDTH].copy_from_slice(&self.angles[start..][..R::WIDTH]);
            let (sin, cos) = R::load(&numbers).sin_cos();
            self.sines[start..][..R::WIDTH].copy_from_slice(&sin.store()[..R::WIDTH]);
            self.cosines[start..][..R::WIDTH].copy_from_slice(&cos.store()[..R::WIDTH]);
        }
    }

    fn one_by_one(&mut self, angles: Range<usize>) {
        for index in angles {
            (self.sines[index], self.cosines[index]) = simd::run(One(self.angles[index]));
        }
    }
}

struct One(f64);

impl Call for One {
    type Output = (f64, f64);

    #[inline(always)]
    fn run<R: Double>(self) -> (f64, f64) {
        let ([sin], [cos]) = R::sin_cos_all([bytemuck::cast(self.0)]);
        (bytemuck::cast(sin), bytemuck::cast(cos))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Real as _;

    #[test]
    fn every_number_of_angles_is_that_of_one_by_one() {
        let angles: [f64; 23] = core::array::from_fn(|i| (i as f64 - 11.0) * 1.37);
        for count in 0..=angles.len() {
            let (mut sines, mut cosines) = ([0.0; 23], [0.0; 23]);
            sin_cos_all(&angles[..count], &mut sines[..count], &mut cosines[..count]);
            for (index, angle) in angles.iter().enumerate() {
                let one = if index < count {
                    simd::run(One(*angle))
                } else {
                    (0.0, 0.0)
                };
                assert_eq!((sines[index], cosines[index]), one);
            }
        }
        let (sin, cos) = 1.37_f64.sin_cos();
        let (mut sines, mut cosines) = ([0.0], [0.0]);
        sin_cos_all(&[1.37], &mut sines, &mut cosines);
        assert!((sines[0] - sin).abs() < 1e-15 && (cosines[0] - cos).abs() < 1e-15);
    }
}
