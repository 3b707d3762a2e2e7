//! TOML text → [`ArmTable`]: an arm's table as it is written, every value with its place in the text.
//!
//! After this stage keys, types, lengths and words are right. Units, conventions and physics are the
//! [model](crate::model)'s business. A `None` stands for a value that is absent or has been reported.

use crate::diagnostics::{Diagnostic, Sink};
use crate::format;
use crate::lint::Lint;
use crate::model::{called, is_word};
use crate::toml_reader::{self, ARM_TABLE, Choice, Fields, Key, Located, Value};
use ulna::{JointKind, TaskRow};

/// Who wrote a table's text. A program gives rotations as matrices and angles in radians, and has no file to mend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Author {
    /// Somebody with an editor.
    Person,
    /// [`Model::new`](crate::Model::new), for a program.
    Program,
}

impl Author {
    fn base(self) -> &'static Key {
        match self {
            Self::Person => &format::BASE,
            Self::Program => &format::DESCRIBED_BASE,
        }
    }

    fn tool(self) -> &'static Key {
        match self {
            Self::Person => &format::TOOL,
            Self::Program => &format::DESCRIBED_TOOL,
        }
    }
}

/// An arm's table, field by field.
pub(crate) struct ArmTable {
    pub(crate) author: Author,
    pub(crate) name: Option<Located<String>>,
    pub(crate) convention: Option<Located<Convention>>,
    pub(crate) angle_unit: Option<Located<AngleUnit>>,
    pub(crate) gravity: Option<Vector>,
    /// The lints that are switched off.
    pub(crate) allow: Vec<Lint>,
    pub(crate) task: Option<Located<Vec<TaskRow>>>,
    pub(crate) base: Option<PlacementTable>,
    pub(crate) tool: Option<PlacementTable>,
    /// Whether the arm has a payload at run time.
    pub(crate) payload: bool,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleUnit {
    /// 1 is π/180 rad.
    Degrees,
    /// As they are.
    Radians,
}

impl AngleUnit {
    /// Reads the unit, which every file with angles in it must name.
    pub fn read(fields: &mut Fields<'_>) -> Option<Self> {
        Some(Self::located(fields)?.value)
    }

    fn located(fields: &mut Fields<'_>) -> Option<Located<Self>> {
        fields.value(&format::ANGLE_UNIT)?.choice()
    }

    /// As a table names it.
    pub(crate) fn word(self) -> &'static str {
        let mut words = Self::WORDS.iter();
        words
            .find(|word| word.value == self)
            .map_or("", |word| word.word)
    }
}

/// Rows of J under one name.
#[derive(Clone, Copy)]
pub(crate) struct RowSet(pub(crate) &'static [TaskRow]);

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
    pub(crate) name: Option<Located<String>>,
    pub(crate) kind: JointKind,
    pub(crate) theta: Option<Located<f64>>,
    pub(crate) d: Option<Located<f64>>,
    pub(crate) a: Option<Located<f64>>,
    pub(crate) alpha: Option<Located<f64>>,
    pub(crate) rated_torque: Option<Located<f64>>,
    pub(crate) limits: Option<LimitsTable>,
    pub(crate) motor: Option<MotorTable>,
    pub(crate) friction: Option<FrictionTable>,
    pub(crate) link: Option<LinkTable>,
}

/// A joint's `limits`.
pub(crate) struct LimitsTable {
    pub(crate) lower: Option<Located<f64>>,
    pub(crate) upper: Option<Located<f64>>,
    pub(crate) velocity: Option<Located<f64>>,
}

/// A joint's `motor`.
pub(crate) struct MotorTable {
    pub(crate) inertia: Option<Located<f64>>,
    pub(crate) ratio: Option<Located<f64>>,
}

/// A joint's `friction`.
pub(crate) struct FrictionTable {
    pub(crate) viscous: Option<Located<f64>>,
    pub(crate) coulomb: Option<Located<f64>>,
    pub(crate) smoothing: Option<Located<f64>>,
}

/// One `[joint.link]`.
pub(crate) struct LinkTable {
    pub(crate) mass: Option<Located<f64>>,
    pub(crate) com: Option<Vector>,
    pub(crate) inertia: Option<Located<InertiaTable>>,
    /// Whether an inertia that no body can have is meant.
    pub(crate) accept_inertia: Option<Located<bool>>,
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
        let format = match author {
            Author::Person => &format::TABLE,
            Author::Program => &format::DESCRIPTION,
        };
        toml_reader::read(text, &ARM_TABLE, format, sink, |fields| Self {
            author,
            name: string(fields, &format::NAME),
            convention: fields.value(&format::CONVENTION).and_then(Value::choice),
            angle_unit: AngleUnit::located(fields),
            gravity: numbers(fields, &format::GRAVITY),
            allow: fields
                .value(&format::ALLOW)
                .map(read_allow)
                .unwrap_or_default(),
            task: fields
                .value(&format::TASK)
                .and_then(|value| value.table("[task]", |task| read_rows(task, sink)))
                .flatten(),
            base: fields.value(author.base()).and_then(|base| {
                base.table("[base]", |base| {
                    read_placement(base, author, &format::BASE_XYZ)
                })
            }),
            tool: fields.value(author.tool()).and_then(|tool| {
                tool.table("[tool]", |tool| {
                    read_placement(tool, author, &format::TOOL_XYZ)
                })
            }),
            payload: fields
                .value(&format::PAYLOAD)
                .and_then(|payload| payload.table("[payload]", read_payload))
                .unwrap_or(false),
            joints: fields
                .value(&format::JOINTS)
                .and_then(|joints| read_joints(joints, sink)),
        })
    }
}

/// `rows` of `[task]`: a word, or a list of rows without repetition.
fn read_rows(task: &mut Fields<'_>, sink: &Sink) -> Option<Located<Vec<TaskRow>>> {
    let rows = task.value(&format::ROWS)?;
    let Located { span, name, .. } = rows.location();
    let value = if rows.is_string() {
        let RowSet(rows) = rows.choice()?.value;
        rows.to_vec()
    } else {
        let items = rows.items("\"position\", \"pose\" or a list of rows")?;
        let read: Vec<Option<Located<TaskRow>>> = items.into_iter().map(Value::choice).collect();
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

/// The lints of a list; names that are none have been reported.
fn read_allow(allow: Value<'_>) -> Vec<Lint> {
    let names = allow.items("a list of lints").unwrap_or_default();
    let read = names.into_iter().filter_map(Value::choice);
    read.map(|lint: Located<Lint>| lint.value).collect()
}

fn read_placement(placement: &mut Fields<'_>, author: Author, xyz: &'static Key) -> PlacementTable {
    PlacementTable {
        xyz: numbers(placement, xyz),
        turn: match author {
            Author::Person => numbers(placement, &format::RPY).map(Turn::RollPitchYaw),
            Author::Program => placement
                .value(&format::ROTATION)
                .and_then(read_rotation)
                .map(|matrix| Turn::Matrix(matrix.into())),
        },
    }
}

fn read_payload(payload: &mut Fields<'_>) -> bool {
    let runtime = payload.value(&format::RUNTIME).and_then(Value::flag);
    runtime.is_some_and(|runtime| runtime.value)
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
    // Messages call a joint by its number and, where it has one, its name.
    let owner = |(index, row): (usize, &Value<'_>)| {
        let name = row.word_of(&format::JOINT_NAME);
        called(index, name.filter(|name| is_word(name)))
    };
    let owners: Vec<String> = rows.iter().enumerate().map(owner).collect();
    Value::tables(rows, |number| owners[number - 1].clone(), read_joint)
}

fn read_joint(fields: &mut Fields<'_>, owner: &str) -> JointTable {
    JointTable {
        name: string(fields, &format::JOINT_NAME),
        kind: fields
            .value(&format::KIND)
            .and_then(Value::choice)
            .map_or(format::DEFAULT_KIND, |kind| kind.value),
        theta: number(fields, &format::THETA),
        d: number(fields, &format::D),
        a: number(fields, &format::A),
        alpha: number(fields, &format::ALPHA),
        rated_torque: number(fields, &format::RATED),
        limits: fields.value(&format::LIMITS).and_then(|limits| {
            limits.table(&format!("the limits of {owner}"), |fields| LimitsTable {
                lower: number(fields, &format::LOWER),
                upper: number(fields, &format::UPPER),
                velocity: number(fields, &format::VELOCITY),
            })
        }),
        motor: fields.value(&format::MOTOR).and_then(|motor| {
            motor.table(&format!("the motor of {owner}"), |fields| MotorTable {
                inertia: number(fields, &format::ROTOR),
                ratio: number(fields, &format::RATIO),
            })
        }),
        friction: fields.value(&format::FRICTION).and_then(|friction| {
            friction.table(&format!("the friction of {owner}"), |fields| {
                FrictionTable {
                    viscous: number(fields, &format::VISCOUS),
                    coulomb: number(fields, &format::COULOMB),
                    smoothing: number(fields, &format::SMOOTHING),
                }
            })
        }),
        link: fields
            .value(&format::LINK)
            .and_then(|link| link.table(owner, |fields| read_link(fields, owner))),
    }
}

fn read_link(fields: &mut Fields<'_>, owner: &str) -> LinkTable {
    LinkTable {
        mass: number(fields, &format::MASS),
        com: numbers(fields, &format::COM),
        inertia: fields.value(&format::INERTIA).and_then(|inertia| {
            let place = inertia.location();
            let value = inertia.table(&format!("the inertia of {owner}"), read_inertia)?;
            Some(place.map(|()| value))
        }),
        accept_inertia: fields.value(&format::ACCEPT_INERTIA).and_then(Value::flag),
    }
}

fn read_inertia(fields: &mut Fields<'_>) -> InertiaTable {
    InertiaTable {
        moments: [&format::XX, &format::YY, &format::ZZ].map(|key| number(fields, key)),
        products: [&format::XY, &format::XZ, &format::YZ].map(|key| number(fields, key)),
    }
}

fn string(fields: &mut Fields<'_>, key: &'static Key) -> Option<Located<String>> {
    let string = fields.value(key).and_then(Value::string)?;
    Some(string.map(str::to_owned))
}

fn number(fields: &mut Fields<'_>, key: &'static Key) -> Option<Located<f64>> {
    fields.value(key).and_then(Value::number)
}

fn numbers(fields: &mut Fields<'_>, key: &'static Key) -> Option<Vector> {
    fields.value(key).and_then(Value::numbers)
}
