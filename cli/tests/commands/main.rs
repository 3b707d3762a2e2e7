//! The commands, run as a user runs them: exit code, stdout, stderr, and the files that are written or not.

mod assess;
mod by_table;
mod campaign;
mod casadi;
mod check;
mod convert;
mod cost;
mod generate;
mod help;
mod import;
mod long_arms;
mod methods;
mod new;
mod reproduce;
mod shards;
mod slurm;
mod support;
mod verify;
