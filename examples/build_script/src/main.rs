//! An arm compiled by the build script, which writes `planar_2r.rs` into `OUT_DIR`.

include!(concat!(env!("OUT_DIR"), "/planar_2r.rs"));

use ulna::Arm;
use ulna::nalgebra::Vector2;

fn main() {
    let q = Vector2::new(0.3, -1.2);
    let (w_d, gradient) = Planar2r.dynamic_manipulability_gradient(&q);
    println!("M = {:?}", Planar2r.mass_matrix(&q).as_slice());
    println!("w_D = {w_d:?}, its gradient = {:?}", gradient.as_slice());
}
