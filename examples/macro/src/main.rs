//! An arm compiled by a macro: no build script, and a rebuild whenever the table changes.

ulna_macros::arm!("../../arms/planar_2r.toml");

use ulna::Arm;
use ulna::nalgebra::Vector2;

fn main() {
    let q = Vector2::new(0.3, -1.2);
    let (w_d, gradient) = Planar2r.dynamic_manipulability_gradient(&q);
    println!("M = {:?}", Planar2r.mass_matrix(&q).as_slice());
    println!("w_D = {w_d:?}, its gradient = {:?}", gradient.as_slice());
}
