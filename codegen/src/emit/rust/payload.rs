//! What the type of an arm with a payload at run time has beside the others'.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

/// The type.
pub(super) fn structure(name: &Ident) -> TokenStream {
    quote! {
        ///
        /// It carries a payload, nothing at first, that may change between two calls.
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct #name {
            payload: ::ulna::internal::Carried,
        }
    }
}

/// Its own methods.
pub(super) fn methods() -> TokenStream {
    quote! {
        /// The arm that carries `payload`.
        ///
        /// # Errors
        /// A payload so heavy that a link of the arm would be lost in the rounding of what it carries.
        pub fn carrying(payload: ::ulna::Payload) -> Result<Self, ::ulna::PayloadError> {
            let payload = ::ulna::internal::Carried::new(payload, &Self::CHAIN)?;
            Ok(Self { payload })
        }

        /// Carries `payload` from the next call on. Nothing is allocated.
        ///
        /// # Errors
        /// As [`carrying`](Self::carrying); the arm then carries what it did before.
        pub fn set_payload(&mut self, payload: ::ulna::Payload) -> Result<(), ::ulna::PayloadError> {
            *self = Self::carrying(payload)?;
            Ok(())
        }

        /// What the arm carries.
        pub const fn payload(&self) -> ::ulna::Payload {
            self.payload.payload()
        }
    }
}

/// The arm as data, with what it carries.
pub(super) fn chain(joints: &Literal) -> TokenStream {
    quote! {
        fn chain(&self) -> ::ulna::SerialChain<#joints> {
            Self::CHAIN.carrying(&self.payload())
        }
    }
}

/// Arms for the proof: with nothing, and with some body.
pub(super) fn examples(name: &Ident) -> [TokenStream; 2] {
    [
        quote!(super::#name::default()),
        quote! {
            super::#name::carrying(::ulna::proof::payload(&super::#name::CHAIN))
                .expect("the arm carries what is as heavy as its last link")
        },
    ]
}
