//! A robot as a tree of links, made at random; its description; and where its links stand, by homogeneous matrices.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;

use nalgebra::{Matrix3, Matrix4, Rotation3, Unit, Vector3};

/// How a link's joint moves.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Fixed,
    Revolute,
    Continuous,
    Prismatic,
}

#[derive(Clone)]
pub(crate) struct Body {
    pub(crate) mass: f64,
    pub(crate) xyz: [f64; 3],
    pub(crate) rpy: [f64; 3],
    /// xx, xy, xz, yy, yz, zz about the centroid, in the turned axes.
    pub(crate) inertia: [f64; 6],
}

/// A link and the joint that it hangs on.
pub(crate) struct Link {
    pub(crate) parent: Option<usize>,
    pub(crate) kind: Kind,
    pub(crate) xyz: [f64; 3],
    pub(crate) rpy: [f64; 3],
    pub(crate) axis: [f64; 3],
    /// Which coordinate of the arm moves it.
    pub(crate) coordinate: Option<usize>,
    /// Where a joint that is none of the arm's is held: a mimic's offset.
    pub(crate) frozen: f64,
    pub(crate) body: Option<Body>,
}

/// Links, each after the one that it hangs on; the last one is the tip.
pub(crate) struct Robot {
    pub(crate) links: Vec<Link>,
}

impl Robot {
    /// An arm of `joints` joints with axes and origins anywhere.
    pub(crate) fn random(joints: usize, random: &mut Random) -> Self {
        Self::grown(joints, random, Random::anywhere)
    }

    /// The same with axes along x, y or z, origins on a lattice and turns by quarters.
    pub(crate) fn square(joints: usize, random: &mut Random) -> Self {
        Self::grown(joints, random, Random::on_a_lattice)
    }

    fn grown(joints: usize, random: &mut Random, place: fn(&mut Random) -> [[f64; 3]; 3]) -> Self {
        let mut links = vec![Link {
            parent: None,
            kind: Kind::Fixed,
            xyz: [0.0; 3],
            rpy: [0.0; 3],
            axis: [1.0, 0.0, 0.0],
            coordinate: None,
            frozen: 0.0,
            body: random.body(),
        }];
        let mut end = 0;
        let mut grow = |parent: usize, kind, coordinate: Option<usize>, random: &mut Random| {
            let [xyz, rpy, axis] = place(random);
            let held = kind != Kind::Fixed && coordinate.is_none();
            // What moves has mass; frames between need none.
            let body = match coordinate {
                Some(_) => random.some_body(),
                None => random.body(),
            };
            links.push(Link {
                parent: Some(parent),
                kind,
                xyz,
                rpy,
                axis,
                coordinate,
                frozen: if held { random.within(1.0) } else { 0.0 },
                body,
            });
            links.len() - 1
        };
        for coordinate in 0..joints {
            if random.below(2) == 0 {
                end = grow(end, Kind::Fixed, None, random);
            }
            let kind = [Kind::Revolute, Kind::Continuous, Kind::Prismatic][random.below(3)];
            end = grow(end, kind, Some(coordinate), random);
            if random.below(2) == 0 {
                let kind = [Kind::Fixed, Kind::Revolute, Kind::Prismatic][random.below(3)];
                let branch = grow(end, kind, None, random);
                grow(branch, Kind::Fixed, None, random);
            }
        }
        grow(end, Kind::Fixed, None, random);
        Self { links }
    }

    /// Where each link's frame stands in the root's.
    pub(crate) fn poses(&self, q: &[f64]) -> Vec<Matrix4<f64>> {
        let mut poses: Vec<Matrix4<f64>> = Vec::new();
        for link in &self.links {
            let Some(parent) = link.parent else {
                poses.push(Matrix4::identity());
                continue;
            };
            let q = link.coordinate.map_or(link.frozen, |i| q[i]);
            let axis = Vector3::from(link.axis).normalize();
            let motion = match link.kind {
                Kind::Fixed => Matrix4::identity(),
                Kind::Prismatic => Matrix4::new_translation(&(axis * q)),
                Kind::Revolute | Kind::Continuous => {
                    Rotation3::from_axis_angle(&Unit::new_unchecked(axis), q).to_homogeneous()
                }
            };
            poses.push(poses[parent] * origin(link.xyz, link.rpy) * motion);
        }
        poses
    }

    pub(crate) fn to_urdf(&self) -> String {
        let mut text = "<robot name=\"random\">\n".to_owned();
        for (index, link) in self.links.iter().enumerate() {
            let name = format!("l{index}");
            writeln!(text, "<link name=\"{name}\">").unwrap();
            if let Some(body) = &link.body {
                let [xx, xy, xz, yy, yz, zz] = body.inertia;
                writeln!(
                    text,
                    "<inertial>{}<mass value=\"{}\"/><inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" \
                     iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/></inertial>",
                    element(body.xyz, body.rpy),
                    body.mass
                )
                .unwrap();
            }
            text.push_str("</link>\n");
            let Some(parent) = link.parent else { continue };
            let kind = match link.kind {
                Kind::Fixed => "fixed",
                Kind::Revolute => "revolute",
                Kind::Continuous => "continuous",
                Kind::Prismatic => "prismatic",
            };
            let [x, y, z] = link.axis;
            let held = link.kind != Kind::Fixed && link.coordinate.is_none();
            let mimic = match held {
                true => format!(
                    "<mimic joint=\"j1\" multiplier=\"3\" offset=\"{}\"/>",
                    link.frozen
                ),
                false => String::new(),
            };
            writeln!(
                text,
                "<joint name=\"j{index}\" type=\"{kind}\"><parent link=\"l{parent}\"/><child link=\"{name}\"/>{}\
                 <axis xyz=\"{x} {y} {z}\"/>{mimic}</joint>",
                element(link.xyz, link.rpy)
            )
            .unwrap();
        }
        text + "</robot>\n"
    }
}

fn element([x, y, z]: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> String {
    format!("<origin xyz=\"{x} {y} {z}\" rpy=\"{roll} {pitch} {yaw}\"/>")
}

/// An `<origin>` as a homogeneous matrix.
pub(crate) fn origin(xyz: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> Matrix4<f64> {
    let turn = Rotation3::from_euler_angles(roll, pitch, yaw).to_homogeneous();
    Matrix4::new_translation(&xyz.into()) * turn
}

pub(crate) fn inertia(body: &Body) -> Matrix3<f64> {
    let [xx, xy, xz, yy, yz, zz] = body.inertia;
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// Numbers of a linear congruential generator (Knuth's MMIX).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    /// A whole number from 0 on.
    fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    /// From -size to size.
    pub(crate) fn within(&mut self, size: f64) -> f64 {
        let unit = self.next() as f64 / (1_u64 << 31) as f64;
        (2.0 * unit - 1.0) * size
    }

    fn vector(&mut self, size: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.within(size))
    }

    /// Origin, turn and axis.
    fn anywhere(&mut self) -> [[f64; 3]; 3] {
        [self.vector(0.5), self.vector(3.0), self.vector(1.0)]
    }

    fn on_a_lattice(&mut self) -> [[f64; 3]; 3] {
        let xyz = std::array::from_fn(|_| [0.0, 0.0, 0.3, -0.2][self.below(4)]);
        let rpy = std::array::from_fn(|_| [0.0, 0.0, 1.0, -1.0, 2.0][self.below(5)] * FRAC_PI_2);
        let mut axis = [0.0; 3];
        axis[self.below(3)] = [1.0, -1.0][self.below(2)];
        [xyz, rpy, axis]
    }

    /// A body, or none.
    fn body(&mut self) -> Option<Body> {
        match self.below(3) {
            0 => None,
            _ => self.some_body(),
        }
    }

    /// A body of about a third of a metre: the sum of the squares of the edges, two by two, and products that fit them.
    fn some_body(&mut self) -> Option<Body> {
        let mass = 1.0 + self.within(0.9);
        let edges = self.vector(0.2).map(|edge| 0.3 + edge);
        let [x, y, z] = edges.map(|edge| edge * edge * mass / 12.0);
        let product = 0.05 * x.min(y).min(z);
        Some(Body {
            mass,
            xyz: self.vector(0.2),
            rpy: self.vector(3.0),
            inertia: [y + z, product, -product, x + z, product, x + y],
        })
    }
}
