//! Where what is made goes: files, written whole or not at all, by `ulna-files`; the standard output.

pub(crate) use ulna_files::{Files, check_folder, refuse_special, write_new, write_whole};

pub(crate) use crate::stdout::Stdout;
