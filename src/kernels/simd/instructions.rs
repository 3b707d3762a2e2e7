//! [`Instructions`]: which instructions kernels run on, asked of the processor once.

/// Sets of instructions, each with those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Instructions {
    /// Those that the program was compiled for.
    Compiled,
    /// AVX2 and fused multiply-adds.
    Avx2,
    /// AVX-512, as far as kernels need it.
    Avx512,
}

impl Instructions {
    /// The largest set of the machine.
    pub fn of_machine() -> Self {
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        if std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma") {
            let wide = std::is_x86_feature_detected!("avx512f")
                && std::is_x86_feature_detected!("avx512dq");
            return if wide { Self::Avx512 } else { Self::Avx2 };
        }
        Self::Compiled
    }
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod choice {
    use core::sync::atomic::{AtomicU8, Ordering};

    use super::Instructions;

    /// The set in use as a number from 1 on; 0 while nobody has asked.
    static IN_USE: AtomicU8 = AtomicU8::new(0);

    impl Instructions {
        /// The set that kernels run on: the machine's largest, unless [`Instructions::limit`] was called.
        #[inline]
        pub fn in_use() -> Self {
            match IN_USE.load(Ordering::Relaxed) {
                0 => Self::ask(),
                1 => Self::Compiled,
                2 => Self::Avx2,
                _ => Self::Avx512,
            }
        }

        /// Keeps the whole program to `self`, or to what the machine has of it: to measure and to test one set after another
        /// on one machine. Results differ in the last digits between sets with fused multiply-adds and those without.
        pub fn limit(self) {
            let set = self.min(Self::of_machine());
            IN_USE.store(set as u8 + 1, Ordering::Relaxed);
        }

        #[cold]
        #[inline(never)]
        fn ask() -> Self {
            let set = Self::of_machine();
            IN_USE.store(set as u8 + 1, Ordering::Relaxed);
            set
        }
    }
}

#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
impl Instructions {
    /// The set that kernels run on.
    #[inline]
    pub fn in_use() -> Self {
        Self::Compiled
    }

    /// Does nothing: there is one set.
    pub fn limit(self) {}
}
