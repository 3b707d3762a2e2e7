//! [`arm!`]: an arm's table as unrolled Rust, without a build script.

use std::path::Path;

use proc_macro::TokenStream;
use proc_macro2::Span;
use quote::{quote, quote_spanned};
use syn::{LitStr, parse_macro_input};

/// Expands to the code of the arm whose table stands at the given path.
///
/// The path is relative to the folder of the crate's `Cargo.toml`. The crate is rebuilt when the table changes.
///
/// ```
/// use ulna::{Arm, nalgebra::Vector2};
///
/// ulna_macros::arm!("../arms/planar_2r.toml"); // pub struct Planar2r, which implements Arm<2>
///
/// assert!(Planar2r.dynamic_manipulability(&Vector2::new(0.3, 1.2)) > 0.0);
/// ```
///
/// Every error of the table is reported at the path, with its line in the table.
///
/// What is allowed in a table but rarely meant is a warning there.
#[proc_macro]
pub fn arm(path: TokenStream) -> TokenStream {
    let literal = parse_macro_input!(path as LitStr);
    expand(&literal)
        .unwrap_or_else(|message| syn::Error::new(literal.span(), message).into_compile_error())
        .into()
}

fn expand(literal: &LitStr) -> Result<proc_macro2::TokenStream, String> {
    let path = literal.value();
    let root = std::env::var("CARGO_MANIFEST_DIR")
        .map_err(|error| format!("CARGO_MANIFEST_DIR: {error}; build with cargo"))?;
    let (model, found) =
        ulna_table::Model::lint_in(&root, &path).map_err(|errors| format!("{errors:?}"))?;
    let generated = ulna_codegen::generate(&model, &path);
    let found = (!found.is_empty()).then(|| found.to_string());
    let said = generated
        .warnings()
        .iter()
        .map(|said| format!("{path}: {said}"));
    let warnings = found.into_iter().chain(said);
    let warnings = warnings.map(|text| warning(literal.span(), &text));
    let code = generated.tokens();
    let absolute = Path::new(&root).join(&path).display().to_string();
    // The constant makes the table one of the files that cargo watches.
    Ok(quote! {
        #code
        #(#warnings)*
        const _: &[u8] = ::core::include_bytes!(#absolute);
    })
}

/// A warning at the literal: a macro has no other way to say one than the use of something deprecated.
fn warning(span: Span, text: &str) -> proc_macro2::TokenStream {
    quote_spanned! {span=>
        const _: () = {
            #[deprecated(note = #text)]
            const fn table() {}
            table()
        };
    }
}
