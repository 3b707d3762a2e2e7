//! What is written beside an arm's two files, for an [interface](Abi) that is asked for.

use super::casadi;
use super::options::Abi;
use super::target::Target;
use crate::Compiled;

/// A file's name and its text.
pub(super) type File = (String, String);

/// The files of the interface that the options ask for; `about` says where they come from.
pub(super) fn further(target: &Target<'_>, compiled: &Compiled, about: &[String]) -> Vec<File> {
    match target.options.abi {
        None => Vec::new(),
        Some(Abi::Casadi) => casadi::further(target, compiled, about),
    }
}

/// A header that may be included twice, and from C++: `above` are comments, `guard` is in lower case, `content` what it declares.
pub(super) fn guarded(guard: &str, above: &str, content: &str) -> String {
    let guard = guard.to_uppercase();
    format!(
        "{above}#ifndef {guard}
#define {guard}

#ifdef __cplusplus
extern \"C\" {{
#endif
{content}
#ifdef __cplusplus
}}
#endif

#endif
"
    )
}
