//! The base parameters as a constant of the generated type: which columns of the regressor are theirs.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::BaseParameters;

/// `pub const BASE_PARAMETERS: [(usize, usize); …]`.
pub(super) fn base_parameters(base: &BaseParameters) -> TokenStream {
    let count = Literal::usize_unsuffixed(base.list().len());
    let columns = base.list().iter().map(|base| {
        let link = Literal::usize_unsuffixed(base.link);
        let column = Literal::usize_unsuffixed(base.parameter.index());
        quote!((#link, #column))
    });
    quote! {
        /// The base (minimal) inertial parameters: each one's link and its column in the link's block of the regressor, both from 0.
        pub const BASE_PARAMETERS: [(usize, usize); #count] = [#(#columns),*];
    }
}
