//! Which columns of a matrix depend on those before them, and how: Gaussian elimination in 106 bits.

use ulna::Real as _;

use crate::double_double::DoubleDouble;

/// A column's entries are of the order of 1 or less. What is left of one that depends on others is some 1e-30,
/// and where those nearly depend on each other up to 1e-16; what is left below this is no more than a double's rounding.
const DEPENDENT: f64 = 1e-14;

/// A factor that is rounding.
const NOTHING: f64 = 1e-13;

/// What a column is to those before it.
#[derive(Debug)]
pub(super) enum Dependency {
    /// No combination of them.
    Independent,
    /// Their sum with these factors, one for each column of the matrix.
    On(Vec<DoubleDouble>),
}

/// Takes the columns one by one, the rows in the order of their largest entries.
pub(super) fn eliminate(mut rows: Vec<Vec<DoubleDouble>>, columns: usize) -> Vec<Dependency> {
    let mut pivots: Vec<usize> = Vec::new();
    let mut found = Vec::with_capacity(columns);
    for column in 0..columns {
        let done = pivots.len();
        let size = |row: &Vec<DoubleDouble>| row[column].abs();
        // Of equal ones the first: the order must not depend on how the search goes.
        let largest = rows[done..].iter().enumerate().fold(
            (0, DoubleDouble::default()),
            |largest, (place, row)| {
                if size(row) > largest.1 {
                    (place, size(row))
                } else {
                    largest
                }
            },
        );
        if largest.1 <= DEPENDENT {
            found.push(Dependency::On(factors(&rows, &pivots, column, columns)));
            continue;
        }
        found.push(Dependency::Independent);
        rows.swap(done, done + largest.0);
        let (above, below) = rows.split_at_mut(done + 1);
        let pivot = &above[done];
        for row in below.iter_mut().filter(|row| row[column] != 0.0) {
            let factor = row[column] / pivot[column];
            for (x, y) in row[column..].iter_mut().zip(&pivot[column..]) {
                *x = *x - factor * *y;
            }
            row[column] = DoubleDouble::default();
        }
        pivots.push(column);
    }
    found
}

/// Solves for a column in terms of the pivots' columns, which are triangular by now.
fn factors(
    rows: &[Vec<DoubleDouble>],
    pivots: &[usize],
    column: usize,
    columns: usize,
) -> Vec<DoubleDouble> {
    let mut factors = vec![DoubleDouble::default(); columns];
    for (row, pivot) in rows.iter().zip(pivots).rev() {
        let rest = pivots.iter().fold(row[column], |rest, other| {
            if other > pivot {
                rest - row[*other] * factors[*other]
            } else {
                rest
            }
        });
        let factor = rest / row[*pivot];
        factors[*pivot] = if factor.abs() <= DoubleDouble::of(NOTHING) {
            DoubleDouble::default()
        } else {
            factor
        };
    }
    factors
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix<const R: usize, const C: usize>(rows: [[f64; C]; R]) -> Vec<Vec<DoubleDouble>> {
        rows.map(|row| row.map(DoubleDouble::of).to_vec()).to_vec()
    }

    fn dependent(found: &[Dependency]) -> Vec<Option<Vec<f64>>> {
        let numbers = |dependency: &Dependency| match dependency {
            Dependency::Independent => None,
            Dependency::On(factors) => Some(factors.iter().map(|x| x.to_f64()).collect()),
        };
        found.iter().map(numbers).collect()
    }

    #[test]
    fn a_column_is_found_to_be_a_sum_of_those_before_it() {
        let rows = matrix([
            [0.0, 1.0, 2.0, 3.0],
            [0.0, 2.0, 1.0, 0.0],
            [0.0, 1.0, 1.0, 1.0],
            [0.0, 0.5, 3.0, 5.5],
        ]);
        let found = dependent(&eliminate(rows, 4));
        let expected = [
            Some(vec![0.0; 4]),
            None,
            None,
            Some(vec![0.0, -1.0, 2.0, 0.0]),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn what_differs_in_the_last_digits_of_a_double_is_no_other_column() {
        let rows = matrix([[1.0, 1.0 + 1e-15], [0.5, 0.5], [0.25, 0.25]]);
        assert!(dependent(&eliminate(rows, 2))[1].is_some());
        let rows = matrix([[1.0, 1.0 + 1e-12], [0.5, 0.5], [0.25, 0.25]]);
        assert!(dependent(&eliminate(rows, 2))[1].is_none());
    }
}
