//! [`arm!`]: an arm's table as unrolled Rust, without a build script.

use std::path::Path;

use proc_macro::TokenStream;
use proc_macro2::Span;
use quote::{quote, quote_spanned};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Ident, LitStr, Token, bracketed, parse_macro_input};
use ulna_codegen::{Generator, Method};

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
/// Every method is generated. For who wants few, a list of them: the others take no code, and run by the textbook formulas.
///
/// ```
/// use ulna::{Arm, nalgebra::Vector2};
///
/// ulna_macros::arm!("../arms/planar_2r.toml", methods = [mass_matrix, inverse_dynamics]);
///
/// let q = Vector2::new(0.3, 1.2);
/// assert_eq!(Planar2r.dynamic_manipulability(&q), Planar2r::CHAIN.dynamic_manipulability(&q));
/// ```
///
/// Every error of the table is reported at the path, with its line in the table.
///
/// What is allowed in a table but rarely meant is a warning there.
#[proc_macro]
pub fn arm(call: TokenStream) -> TokenStream {
    let Call { table, generator } = parse_macro_input!(call as Call);
    expand(&table, &generator)
        .unwrap_or_else(|message| syn::Error::new(table.span(), message).into_compile_error())
        .into()
}

/// What stands in the macro's parentheses: `"path"`, or `"path", methods = [a, b]`.
struct Call {
    table: LitStr,
    generator: Generator,
}

impl Parse for Call {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let table = input.parse()?;
        let mut generator = Generator::new();
        if input.parse::<Option<Token![,]>>()?.is_some() && !input.is_empty() {
            let expected = "expected `methods = [...]`";
            let key: Ident = input.parse().map_err(|_| input.error(expected))?;
            if key != "methods" {
                return Err(syn::Error::new(key.span(), expected));
            }
            input.parse::<Token![=]>()?;
            let list;
            bracketed!(list in input);
            generator = generator.methods(&methods(&list)?);
            input.parse::<Option<Token![,]>>()?;
        }
        Ok(Self { table, generator })
    }
}

/// The methods of a list, or every name in it that is none.
fn methods(list: ParseStream<'_>) -> syn::Result<Vec<Method>> {
    let names = Punctuated::<Ident, Token![,]>::parse_terminated(list)?;
    let (mut methods, mut errors): (Vec<_>, Option<syn::Error>) = (Vec::new(), None);
    for name in &names {
        match Generator::method(&name.to_string()) {
            Ok(method) => methods.push(method),
            Err(unknown) => {
                let error = syn::Error::new(name.span(), unknown);
                match &mut errors {
                    Some(errors) => errors.combine(error),
                    None => errors = Some(error),
                }
            }
        }
    }
    errors.map_or(Ok(methods), Err)
}

fn expand(literal: &LitStr, generator: &Generator) -> Result<proc_macro2::TokenStream, String> {
    let path = literal.value();
    let root = std::env::var("CARGO_MANIFEST_DIR")
        .map_err(|error| format!("CARGO_MANIFEST_DIR: {error}; build with cargo"))?;
    let (model, found) =
        ulna_table::Model::lint_in(&root, &path).map_err(|errors| format!("{errors:?}"))?;
    let generated = generator.generate(&model, &path);
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
