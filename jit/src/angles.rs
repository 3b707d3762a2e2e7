//! The angles of a program, and their sines and cosines.

use ulna::internal::sin_cos_all;
use ulna_codegen::AngleSum;

/// Sums of joint coordinates.
#[derive(Debug)]
pub(crate) struct Angles {
    /// The joints of all sums, one sum after another.
    joints: Vec<usize>,
    /// For each sum, how many joints it has, and the constant that is added, rad.
    sums: Vec<(usize, f64)>,
}

impl Angles {
    pub(crate) fn new(angles: &[AngleSum]) -> Self {
        let joints = angles.iter().flat_map(|angle| angle.joints.iter().copied());
        let sums = angles
            .iter()
            .map(|angle| (angle.joints.len(), angle.offset.to_f64()));
        Self {
            joints: joints.collect(),
            sums: sums.collect(),
        }
    }

    /// Hands to `take` a slice that has the sines of all angles, and after [`stride`] numbers their cosines.
    #[inline]
    pub(crate) fn with_sines<T>(&self, q: &[f64], take: impl FnOnce(&[f64]) -> T) -> T {
        match self.sums.len() {
            0 => take(&[]),
            1..=8 => self.on_stack::<16, T>(q, take),
            9..=16 => self.on_stack::<32, T>(q, take),
            17..=64 => self.on_stack::<128, T>(q, take),
            count => take(self.fill(q, &mut vec![0.0; 2 * stride(count)])),
        }
    }

    #[inline]
    fn on_stack<const L: usize, T>(&self, q: &[f64], take: impl FnOnce(&[f64]) -> T) -> T {
        let mut numbers = [0.0; L];
        take(self.fill(q, &mut numbers[..2 * stride(self.sums.len())]))
    }

    #[inline]
    fn fill<'a>(&self, q: &[f64], numbers: &'a mut [f64]) -> &'a [f64] {
        let (sines, cosines) = numbers.split_at_mut(stride(self.sums.len()));
        let mut joints = self.joints.iter();
        let mut sums = [0.0; 8];
        let blocks = sines.chunks_mut(8).zip(cosines.chunks_mut(8));
        for (own, (sines, cosines)) in self.sums.chunks(8).zip(blocks) {
            for (sum, (count, offset)) in sums.iter_mut().zip(own) {
                let mut angle = joints.next().map_or(0.0, |joint| q[*joint]);
                for joint in joints.by_ref().take(count.saturating_sub(1)) {
                    angle += q[*joint];
                }
                *sum = angle + offset;
            }
            sin_cos_all(&sums[..sines.len()], sines, cosines);
        }
        numbers
    }
}

/// How many numbers after the sine of an angle its cosine stands, in a program of so many angles: whole lanes.
pub(crate) fn stride(angles: usize) -> usize {
    angles.next_multiple_of(4)
}
