//! TOML text → [`ArmTable`]: an arm's table as it is written, every value with its place in the text.
//!
//! After this stage keys, types, lengths and words are right. Units, conventions and physics are the
//! [model](crate::model)'s business. A `None` stands for a value that is absent or has been reported.

use crate::diagnostics::{Diagnostic, Sink};
use crate::toml_reader::{self, Fields, Located, Value};
use ulna::{JointKind, TaskRow};

/// Who wrote a table's text. A program gives rotations as matrices and angles in radians, and has no file to mend.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Author {
    /// Somebody with an editor.
    Person,
    /// [`Model::new`](crate::Model::new), for a program.
    Program,
}

/// An arm's table, field by field.
pub(crate) struct ArmTable {
    pub(crate) author: Author,
    pub(crate) name: Option<Located<String>>,
    pub(crate) convention: Option<Convention>,
    pub(crate) angle_unit: Option<AngleUnit>,
    pub(crate) gravity: Option<Vector>,
    pub(crate) task: Option<Located<Vec<TaskRow>>>,
    pub(crate) base: Option<PlacementTable>,
    pub(crate) tool: Option<PlacementTable>,
    pub(crate) joints: Option<Vec<JointTable>>,
}

/// Three numbers, each read by itself.
pub(crate) type Vector = [Option<Located<f64>>; 3];

/// Which of the two Denavit–Hartenberg conventions the rows follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convention {
    /// Craig: `T_i = Rx(alpha) Tx(a) Rz(theta) Tz(d)`.
    Modified,
    /// Denavit and Hartenberg: `T_i = Rz(theta) Tz(d) Tx(a) Rx(alpha)`.
    Standard,
}

/// The unit of every angle in a table.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum AngleUnit {
    /// 1 is π/180 rad.
    Degrees,
    /// As they are.
    Radians,
}

impl AngleUnit {
    /// Reads the unit, which every file with angles in it must name.
    pub fn read(fields: &mut Fields<'_>) -> Option<Self> {
        let unit = fields.required(
            "angle_unit",
            "angle_unit = \"deg\"` or `angle_unit = \"rad\"",
        )?;
        let unit = unit.choice(&[("deg", Self::Degrees), ("rad", Self::Radians)])?;
        Some(unit.value)
    }
}

/// `[base]` or `[tool]`.
pub(crate) struct PlacementTable {
    pub(crate) xyz: Option<Vector>,
    pub(crate) turn: Option<Turn>,
}

/// How a placement is turned.
pub(crate) enum Turn {
    /// About fixed x, y, z, in this order.
    RollPitchYaw(Vector),
    /// By the rows of the rotation matrix.
    Matrix(Box<Located<[Vector; 3]>>),
}

/// One `[[joint]]`.
pub(crate) struct JointTable {
    pub(crate) kind: JointKind,
    pub(crate) theta: Option<Located<f64>>,
    pub(crate) d: Option<Located<f64>>,
    pub(crate) a: Option<Located<f64>>,
    pub(crate) alpha: Option<Located<f64>>,
    pub(crate) rated_torque: Option<Located<f64>>,
    pub(crate) link: Option<LinkTable>,
}

/// One `[joint.link]`.
pub(crate) struct LinkTable {
    pub(crate) mass: Option<Located<f64>>,
    pub(crate) com: Option<Vector>,
    pub(crate) inertia: Option<Located<InertiaTable>>,
}

/// The six numbers of an inertia tensor.
pub(crate) struct InertiaTable {
    /// `xx`, `yy`, `zz`.
    pub(crate) moments: Vector,
    /// `xy`, `xz`, `yz`.
    pub(crate) products: Vector,
}

impl ArmTable {
    /// As far as generated code is measured (`benches/growth`): its size grows with the third power.
    pub(crate) const MAX_JOINTS: usize = 32;

    /// Reads a table. `None` if `text` is no TOML; everything that is wrong goes to `sink`.
    pub(crate) fn read(text: &str, author: Author, sink: &Sink) -> Option<Self> {
        toml_reader::read(text, sink, |fields| Self {
            author,
            name: fields
                .required("name", "name = \"my_arm\"")
                .and_then(Value::string)
                .map(|name| Located {
                    value: name.value.to_owned(),
                    span: name.span,
                    name: name.name,
                }),
            convention: fields
                .required(
                    "convention",
                    "convention = \"modified\"` or `convention = \"standard\"",
                )
                .and_then(|value| {
                    value.choice(&[
                        ("modified", Convention::Modified),
                        ("standard", Convention::Standard),
                    ])
                })
                .map(|convention| convention.value),
            angle_unit: AngleUnit::read(fields),
            gravity: fields
                .optional("gravity", "gravity = [0.0, 0.0, -9.81]")
                .and_then(Value::numbers),
            task: fields
                .required("task", "[task]` and below it `rows = \"position\"")
                .and_then(|value| value.table("[task]", |task| read_rows(task, sink)))
                .flatten(),
            base: read_placement(fields, author, "base", "[base]"),
            tool: read_placement(fields, author, "tool", "[tool]"),
            joints: fields
                .required("joint", "[[joint]]` once for each joint, base first")
                .and_then(|joints| read_joints(joints, sink)),
        })
    }
}

/// `rows` of `[task]`: a word, or a list of rows without repetition.
fn read_rows(task: &mut Fields<'_>, sink: &Sink) -> Option<Located<Vec<TaskRow>>> {
    let rows = task.required("rows", "rows = \"position\"")?;
    let Located { span, name, .. } = rows.location();
    let value = if rows.is_string() {
        let words = [
            ("position", &TaskRow::ALL[..3]),
            ("pose", &TaskRow::ALL[..]),
        ];
        rows.choice(&words)?.value.to_vec()
    } else {
        let names = TaskRow::ALL.map(|row| (row.name(), row));
        let items = rows.items("\"position\", \"pose\" or a list of rows")?;
        let read: Vec<_> = items.into_iter().map(|row| row.choice(&names)).collect();
        // With a wrong row the count would be wrong too, and has been reported.
        let read = read.into_iter().collect::<Option<Vec<_>>>()?;
        let mut rows = Vec::new();
        for row in read {
            if rows.contains(&row.value) {
                let message = format!("{name} lists {:?} twice", row.value.name());
                sink.push(
                    Diagnostic::error(row.span, message)
                        .label("repeated")
                        .help("write each row once; their order does not matter"),
                );
            } else {
                rows.push(row.value);
            }
        }
        rows
    };
    Some(Located { value, span, name })
}

fn read_placement(
    fields: &mut Fields<'_>,
    author: Author,
    key: &'static str,
    owner: &str,
) -> Option<PlacementTable> {
    fields
        .optional(
            key,
            "xyz = [0.0, 0.0, 0.0]` below a line `[base]` or `[tool]",
        )?
        .table(owner, |placement| PlacementTable {
            xyz: placement
                .optional("xyz", "xyz = [0.0, 0.0, 0.0]")
                .and_then(Value::numbers),
            turn: match author {
                Author::Person => placement
                    .optional("rpy", "rpy = [0.0, 0.0, 0.0]")
                    .and_then(Value::numbers)
                    .map(Turn::RollPitchYaw),
                Author::Program => placement
                    .optional("rotation", "rotation = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]")
                    .and_then(read_rotation)
                    .map(|matrix| Turn::Matrix(matrix.into())),
            },
        })
}

/// Three rows of three numbers: [`Model::new`](crate::Model::new) writes no other.
fn read_rotation(rotation: Value<'_>) -> Option<Located<[Vector; 3]>> {
    let place = rotation.location();
    let rows = rotation.items("an array of three rows")?;
    let rows: Option<Vec<Vector>> = rows.into_iter().map(Value::numbers).collect();
    let rows = rows?.try_into().ok()?;
    Some(place.map(|()| rows))
}

fn read_joints(joints: Value<'_>, sink: &Sink) -> Option<Vec<JointTable>> {
    let Located { span, .. } = joints.location();
    let mut rows = joints.items("a list of joints, each under its own [[joint]]")?;
    if rows.is_empty() {
        sink.push(
            Diagnostic::error(span, "an arm without joints")
                .label("empty")
                .help("write `[[joint]]` once for each joint, base first"),
        );
        return None;
    }
    let count = rows.len();
    if let Some(excess) = rows.get(ArmTable::MAX_JOINTS) {
        let max = ArmTable::MAX_JOINTS;
        let message = format!("{count} joints; {max} are the most that are supported");
        sink.push(
            Diagnostic::error(excess.location().span, message).label(format!("joint {}", max + 1)),
        );
        rows.truncate(max);
    }
    Value::tables(rows, |i| format!("joint {i}"), read_joint)
}

fn read_joint(fields: &mut Fields<'_>, owner: &str) -> JointTable {
    let kinds = [
        ("revolute", JointKind::Revolute),
        ("prismatic", JointKind::Prismatic),
    ];
    JointTable {
        kind: fields
            .optional("kind", "kind = \"revolute\"")
            .and_then(|kind| kind.choice(&kinds))
            .map_or(JointKind::Revolute, |kind| kind.value),
        theta: number(fields, "theta", "theta = 0.0"),
        d: number(fields, "d", "d = 0.0"),
        a: number(fields, "a", "a = 0.0"),
        alpha: number(fields, "alpha", "alpha = 0.0"),
        rated_torque: fields
            .optional("rated_torque", "rated_torque = 100.0")
            .and_then(Value::number),
        link: fields
            .required("link", "[joint.link]` with mass, com and inertia below it")
            .and_then(|link| link.table(owner, |fields| read_link(fields, owner))),
    }
}

fn read_link(fields: &mut Fields<'_>, owner: &str) -> LinkTable {
    LinkTable {
        mass: number(fields, "mass", "mass = 1.0"),
        com: fields
            .required("com", "com = [0.0, 0.0, 0.0]")
            .and_then(Value::numbers),
        inertia: fields
            .required("inertia", "inertia = { xx = 1.0, yy = 1.0, zz = 1.0 }")
            .and_then(|inertia| {
                let Located { span, name, .. } = inertia.location();
                let value = inertia.table(&format!("the inertia of {owner}"), read_inertia)?;
                Some(Located { value, span, name })
            }),
    }
}

fn read_inertia(fields: &mut Fields<'_>) -> InertiaTable {
    InertiaTable {
        moments: [
            number(fields, "xx", "xx = 1.0"),
            number(fields, "yy", "yy = 1.0"),
            number(fields, "zz", "zz = 1.0"),
        ],
        products: [("xy", "xy = 0.0"), ("xz", "xz = 0.0"), ("yz", "yz = 0.0")]
            .map(|(key, example)| fields.optional(key, example).and_then(Value::number)),
    }
}

fn number(
    fields: &mut Fields<'_>,
    key: &'static str,
    example: &'static str,
) -> Option<Located<f64>> {
    fields.required(key, example).and_then(Value::number)
}
