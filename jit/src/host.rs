//! The machine that the program runs on, as the code generator sees it.

use cranelift_codegen::isa::{OwnedTargetIsa, TargetIsa};
use cranelift_codegen::settings::{self, Configurable, Flags};
use ulna::Instructions;

use crate::Error;

/// Programs of more steps than this get registers in one pass. The careful way takes more than linear time: of ∇w_D of 15 joints
/// 2.8 s. Code of one pass is some 1.4 times slower (∇w_D, M and the inverse dynamics of ssrms).
const LONG: usize = 4096;

/// What code is made for.
pub(crate) struct Host {
    careful: OwnedTargetIsa,
    in_one_pass: OwnedTargetIsa,
    /// Whether multiply-adds are fused: where generated code would fuse them, so that results are the same to the bit.
    pub(crate) fuses: bool,
}

/// Settings of the code generator, each of which differs from what it does by itself.
const SETTINGS: &[(&str, &str)] = &[
    // Programs come without common subexpressions, dead code and foldable constants, in an order that is meant.
    ("opt_level", "none"),
    // Nothing unwinds through straight lines of arithmetic.
    ("unwind_info", "false"),
    // A long program's frame may be longer than the page that guards a stack.
    ("enable_probestack", "true"),
    ("probestack_strategy", "inline"),
    // Programs are checked while they are translated.
    ("enable_verifier", "false"),
];

impl Host {
    pub(crate) fn new() -> Result<Self, Error> {
        let fuses = if cfg!(target_arch = "x86_64") {
            Instructions::in_use() >= Instructions::Avx2
        } else {
            cfg!(target_arch = "aarch64")
        };
        Ok(Self {
            careful: isa("backtracking")?,
            in_one_pass: isa("single_pass")?,
            fuses,
        })
    }

    /// The code generator for a program of so many steps.
    pub(crate) fn isa_for(&self, steps: usize) -> &dyn TargetIsa {
        if steps > LONG {
            &*self.in_one_pass
        } else {
            &*self.careful
        }
    }
}

/// The code generator for this machine, with one of its ways to give registers.
fn isa(registers: &str) -> Result<OwnedTargetIsa, Error> {
    let failed = |error: &dyn std::fmt::Display| Error::Host(error.to_string());
    let mut flags = settings::builder();
    for (name, value) in SETTINGS.iter().chain(&[("regalloc_algorithm", registers)]) {
        flags.set(name, value).map_err(|error| failed(&error))?;
    }
    let isa = cranelift_native::builder().map_err(|error| failed(&error))?;
    isa.finish(Flags::new(flags))
        .map_err(|error| failed(&error))
}
