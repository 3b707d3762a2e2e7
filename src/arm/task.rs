//! [`TaskRows`]: the rows of the Jacobian that make up a task.

/// One row of the geometric Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TaskRow {
    /// Linear velocity along world x.
    X,
    /// Linear velocity along world y.
    Y,
    /// Linear velocity along world z.
    Z,
    /// Angular velocity about world x.
    Rx,
    /// Angular velocity about world y.
    Ry,
    /// Angular velocity about world z.
    Rz,
}

impl TaskRow {
    /// All rows, in the Jacobian's order.
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Z, Self::Rx, Self::Ry, Self::Rz];

    /// The name in a table.
    pub const fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
            Self::Rx => "rx",
            Self::Ry => "ry",
            Self::Rz => "rz",
        }
    }

    /// The row's index in the Jacobian, 0 to 5.
    pub const fn index(self) -> usize {
        self as usize
    }
}

/// The rows of the geometric Jacobian that make up a task: a set, in the Jacobian's order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TaskRows(u8);

impl TaskRows {
    /// The three linear rows.
    pub const POSITION: Self = Self(0b00_0111);
    /// All six rows.
    pub const POSE: Self = Self(0b11_1111);

    /// The set of `rows`.
    pub const fn new(rows: &[TaskRow]) -> Self {
        let mut bits = 0;
        let mut i = 0;
        while i < rows.len() {
            bits |= 1 << rows[i].index();
            i += 1;
        }
        Self(bits)
    }

    /// Whether `row` belongs to the task.
    pub const fn contains(self, row: TaskRow) -> bool {
        self.0 & (1 << row.index()) != 0
    }

    /// How many rows.
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether there is no row.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The rows, in the Jacobian's order.
    pub fn iter(self) -> impl Iterator<Item = TaskRow> {
        TaskRow::ALL
            .into_iter()
            .filter(move |row| self.contains(*row))
    }
}
