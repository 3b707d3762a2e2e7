//! Campaigns of cases, in one go or in shards on as many machines as there are.
//!
//! A case is a function of the scenario, the seed and its number alone, so that whoever makes a shard needs to talk to nobody,
//! and the shards one after the other are the file of one run, byte for byte.
//!
//! # Where to go
//!
//! - [`Campaign`]: a scenario with its arm; [`Campaign::row`] makes a case. Its [`Identity`] says what decides a row beside the number.
//! - [`Part`]: all cases or one shard of them, in a folder. [`make`] makes it there, goes on with what there is, and is [watched](Watch);
//!   [`Shipped::make`] makes it in memory, for another machine's folder, and [`Shipped::store`] puts it there; [`is_there`] tells whether
//!   it needs to be made at all.
//! - [`merge`](merge()): the shards together, with everything that is wrong with them at once.
//!
//! Beside rows stands their record: which campaign they are of, which cases, how many of them are good, and a SHA-256. Rows without it, those
//! of another campaign, and rows that were changed are refused, each time with a sentence that says what to do.

mod arithmetic;
mod campaign;
mod file;
mod hashed;
mod identity;
mod make;
mod merge;
mod part;
mod record;
mod row;
mod shipped;

pub use campaign::Campaign;
pub use file::is_there;
pub use identity::Identity;
pub use make::{Made, Silent, Watch, make};
pub use merge::{Merged, merge};
pub use part::Part;
pub use row::{CaseCells, LawCells, Row};
pub use shipped::Shipped;
