//! What rows depend on beside the numbers that go in: how this machine rounds.

use ulna::Instructions;

/// Products and sums are rounded once where they are fused, and twice where they are not; and a few elementary functions are
/// the system's. So rows of one kind of machine are the same to the byte, and those of another may have other last digits.
pub(crate) fn arithmetic() -> String {
    // As kernels decide it, compiled ones and those made at run time.
    let compiled = cfg!(any(target_feature = "fma", target_arch = "aarch64"));
    let fused = compiled || Instructions::in_use() >= Instructions::Avx2;
    format!(
        "{} multiply-adds, {} {}",
        if fused { "fused" } else { "plain" },
        std::env::consts::ARCH,
        std::env::consts::OS
    )
}
