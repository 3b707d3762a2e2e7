//! The shapes of what methods return, for a number of joints that is known at run time.

use ulna::Method;

/// Lengths of the nested arrays that a kernel returns, outermost first, part by part.
macro_rules! parts {
    (($($part:tt),+)) => {
        vec![$(lengths!($part)),+]
    };
    ($part:tt) => {
        vec![lengths!($part)]
    };
}

macro_rules! lengths {
    (R) => {
        Vec::new()
    };
    ([$inner:tt; $length:expr]) => {{
        let mut lengths: Vec<usize> = lengths!($inner);
        lengths.insert(0, $length);
        lengths
    }};
}

macro_rules! define_lengths {
    ([$method:ident] $(
        $(#[$doc:meta])*
        $variant:ident = $name:ident($($argument:ident),+) -> $output:ty
        { kernel $returns:literal $kernel:ident -> $returned:tt $(, zero from $zero:literal)? }
        $({ $($rest:tt)* })*
    )+) => {
        match $method {
            $(Method::$variant => parts!($returned),)+
        }
    };
}

/// What the method's kernel returns, each part as nested arrays: a matrix is an array of its columns. Where the task may be
/// singular, the last part is det(JJᵀ).
pub(crate) fn kernel_shape(method: Method, joints: usize) -> Vec<Vec<usize>> {
    ulna::methods! { [joints] define_lengths { method } }
}

/// The parts of a method's result, each as `[]`, `[length]`, `[rows, columns]` or `[how many, rows, columns]`.
pub(crate) fn shape(method: Method, joints: usize) -> Vec<Vec<usize>> {
    let mut parts = kernel_shape(method, joints);
    if method.zero_where_singular().is_some() {
        parts.pop();
    }
    for part in &mut parts {
        if let [.., columns, rows] = part.as_mut_slice() {
            std::mem::swap(columns, rows);
        }
    }
    parts
}

/// How many numbers each part has.
pub(crate) fn lengths(shape: &[Vec<usize>]) -> Vec<usize> {
    shape.iter().map(|part| part.iter().product()).collect()
}
