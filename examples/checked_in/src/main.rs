//! An arm compiled by the command line into a file that is checked in: its code can be read and reviewed,
//! and neither a generator nor its dependencies are built.
//!
//! `src/planar_2r.rs` was written in this folder by
//! `ulna generate ../../arms/planar_2r.toml --methods mass_matrix,inverse_dynamics,dynamic_manipulability_gradient --output src/planar_2r.rs`.
//! The same command with `--check` fails if the table or the generator has changed since.

mod planar_2r;

use planar_2r::Planar2r;
use ulna::Arm;
use ulna::nalgebra::Vector2;

fn main() {
    let q = Vector2::new(0.3, -1.2);
    let (w_d, gradient) = Planar2r.dynamic_manipulability_gradient(&q);
    println!("M = {:?}", Planar2r.mass_matrix(&q).as_slice());
    println!("w_D = {w_d:?}, its gradient = {:?}", gradient.as_slice());
}
