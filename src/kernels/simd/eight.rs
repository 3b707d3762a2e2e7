//! Sines and cosines of eight angles: what code that is made at run time calls.
//!
//! The angles come in registers. In memory, the caller would write them one by one and the lanes read four at once, which
//! waits until all is written.

use super::Instructions;
use crate::Real;

/// Writes the sines of eight angles, each within ±2²⁶ rad, and then their cosines.
///
/// # Safety
/// There is room for them.
pub type EightSines = unsafe extern "C" fn(*mut [f64; 16], f64, f64, f64, f64, f64, f64, f64, f64);

/// The quickest one on the instructions [in use](Instructions::in_use): to the bit what generated kernels have for their angles.
pub fn eight_sines() -> EightSines {
    match Instructions::in_use() {
        Instructions::Compiled => plain,
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        _ => fused,
        #[cfg(not(all(feature = "std", target_arch = "x86_64")))]
        _ => plain,
    }
}

macro_rules! eight {
    ($(#[$attribute:meta])* $name:ident, $scalar:path, |$number:ident| $value:expr) => {
        $(#[$attribute])*
        #[allow(clippy::too_many_arguments, clippy::many_single_char_names)]
        unsafe extern "C" fn $name(
            to: *mut [f64; 16],
            a: f64, b: f64, c: f64, d: f64, e: f64, f: f64, g: f64, h: f64,
        ) {
            let (sines, cosines) = Real::sin_cos_all([a, b, c, d, e, f, g, h].map($scalar));
            let mut all = [0.0; 16];
            for i in 0..8 {
                let $number = sines[i];
                all[i] = $value;
                let $number = cosines[i];
                all[8 + i] = $value;
            }
            // SAFETY: so says the caller.
            unsafe { to.write(all) }
        }
    };
}

eight!(plain, core::convert::identity, |number| number);
#[cfg(all(feature = "std", target_arch = "x86_64"))]
eight!(
    /// # Safety
    /// The processor has the instructions, too.
    #[target_feature(enable = "avx2,fma")]
    fused, super::fused::Fused, |number| number.0
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn are_those_of_the_standard_library() {
        let angles: [f64; 8] = core::array::from_fn(|i| (i as f64 - 3.3) * 2.37);
        let [a, b, c, d, e, f, g, h] = angles;
        for function in [plain, eight_sines()] {
            let mut found = [0.0; 16];
            // SAFETY: there is room, and the processor has been asked.
            unsafe { function(&mut found, a, b, c, d, e, f, g, h) };
            for (i, angle) in angles.iter().enumerate() {
                let (sin, cos) = angle.sin_cos();
                assert!((found[i] - sin).abs() < 4e-16, "{angle}");
                assert!((found[8 + i] - cos).abs() < 4e-16, "{angle}");
            }
        }
    }
}
