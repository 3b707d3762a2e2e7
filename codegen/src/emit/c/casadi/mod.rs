//! The dynamics of an arm as functions that CasADi takes from a shared library: `NAME_casadi.h` and `NAME_casadi.c`.
//!
//! `casadi.external("NAME_casadi_inverse_dynamics", "./libNAME.so")` finds there what CasADi's own code generator would have
//! written for such a function: its value, its inputs' and outputs' names and sparsities, and with the prefix `jac_` the same for its Jacobian,
//! a block for each input (checked against the code and the symbols that CasADi 3.8 writes and looks up, `casadi/core/external.cpp`).
//! The functions have names of their own: CasADi's calling convention is not that of `NAME.h`, and both stand in one library.

mod block;
mod function;
mod interface;

use ulna::{Method, Payload};
use ulna_table::Model;

use crate::Compiled;
use function::Function;

/// What is in the two files.
#[derive(Debug)]
pub(in crate::emit) struct Casadi {
    /// `NAME_casadi.h`.
    pub(in crate::emit) header: String,
    /// `NAME_casadi.c`.
    pub(in crate::emit) source: String,
}

/// The methods that it calls.
pub(in crate::emit) fn needed(model: &Model) -> Vec<Method> {
    let mut methods = vec![
        Method::InverseDynamics,
        Method::InverseDynamicsDerivatives,
        Method::MassMatrix,
        Method::ForwardDynamics,
        Method::ForwardDynamicsDerivatives,
    ];
    // What the torques are by the payload's parameters.
    methods.extend(model.has_payload().then_some(Method::Regressor));
    methods
}

/// Both files; `None` if a method that it [needs](needed) is not among the compiled ones. `origin` is the comment that says where they come from.
pub(in crate::emit) fn casadi(model: &Model, compiled: &Compiled, origin: &str) -> Option<Casadi> {
    let functions = [
        Function::inverse_dynamics(model, compiled)?,
        Function::forward_dynamics(model, compiled)?,
    ];
    Some(Casadi {
        header: header(model, &functions, origin),
        source: source(model, &functions, origin),
    })
}

fn header(model: &Model, functions: &[Function; 2], origin: &str) -> String {
    let name = model.name();
    let guard = format!("{}_CASADI_H", name.to_uppercase());
    let prototypes: String = functions.iter().map(Function::prototypes).collect();
    format!(
        "{origin}
#ifndef {guard}
#define {guard}

/* The arm's dynamics for casadi.external, in double precision. Compile with {name}.c into one shared library:
 *
 *     cc -O2 -shared -fPIC {name}.c {name}_casadi.c -o lib{name}.so -lm
 *
 *     f = casadi.external(\"{name}_casadi_forward_dynamics\", \"./lib{name}.so\")
 *
 * Inputs and outputs are vectors, Jacobians have a block for each input, by columns, without what is 0 at any state.
 * An input that is NULL is 0, an output that is NULL is not computed; iw, w and mem are not used, and may be NULL and 0.
 * No function keeps anything between calls: all may be called by several threads at once. Each returns 0.
 */

#ifdef __cplusplus
extern \"C\" {{
#endif
{prototypes}
#ifdef __cplusplus
}}
#endif

#endif
"
    )
}

fn source(model: &Model, functions: &[Function; 2], origin: &str) -> String {
    let name = model.name();
    let longest = model.joints().len().max(if model.has_payload() {
        Payload::PARAMETERS
    } else {
        0
    });
    let solved = if model.has_payload() { SOLVED } else { "" };
    let bodies: String = functions.iter().map(Function::definitions).collect();
    format!(
        "{origin}
#include \"{name}_casadi.h\"

#include <stddef.h>

#include \"{name}.h\"

/* The input that CasADi passes, or zeros where it passes none. */
static const double *given(const double *input)
{{
    static const double zeros[{longest}] = {{0}};

    return (input != NULL) ? input : zeros;
}}
{PICK}{solved}{SIZES}{bodies}"
    )
}

const PICK: &str = "
/* The entries of a matrix by columns that a sparsity has; nothing if they are not wanted.
 * A sparsity is rows, columns and a 1 if it has all; or rows, columns, where each column begins among the entries, their rows. */
static void pick(const double matrix[], const long long int sparsity[], double *entries)
{
    if (entries != NULL)
    {
        const long long int rows = sparsity[0];
        const long long int columns = sparsity[1];

        if (sparsity[2] == 1)
        {
            for (long long int k = 0; k < (rows * columns); ++k)
            {
                entries[k] = matrix[k];
            }
        }
        else
        {
            for (long long int j = 0; j < columns; ++j)
            {
                for (long long int k = sparsity[2 + j]; k < sparsity[3 + j]; ++k)
                {
                    entries[k] = matrix[(rows * j) + sparsity[3 + columns + k]];
                }
            }
        }
    }
}
";

const SOLVED: &str = "
/* -A B of a square matrix and one of as many rows, all by columns. */
static void solved(const double a[], const double b[], int rows, int columns, double result[])
{
    for (int j = 0; j < columns; ++j)
    {
        for (int i = 0; i < rows; ++i)
        {
            double sum = 0.0;

            for (int k = 0; k < rows; ++k)
            {
                sum += a[i + (rows * k)] * b[k + (rows * j)];
            }
            result[i + (rows * j)] = -sum;
        }
    }
}
";

const SIZES: &str = "
/* Lengths of what a call is passed. */
static int sizes(long long int inputs, long long int outputs, long long int *sz_arg, long long int *sz_res,
    long long int *sz_iw, long long int *sz_w)
{
    if (sz_arg != NULL)
    {
        *sz_arg = inputs;
    }
    if (sz_res != NULL)
    {
        *sz_res = outputs;
    }
    if (sz_iw != NULL)
    {
        *sz_iw = 0;
    }
    if (sz_w != NULL)
    {
        *sz_w = 0;
    }
    return 0;
}
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dump() {
        for arm in ["planar_2r", "ssrms", "geared_6"] {
            let model = Model::load(format!("../arms/{arm}.toml")).unwrap();
            let c = casadi(&model, &crate::compile(&model), "/* origin */").unwrap();
            std::fs::write(format!("/tmp/cas/{arm}_casadi.h"), c.header).unwrap();
            std::fs::write(format!("/tmp/cas/{arm}_casadi.c"), c.source).unwrap();
        }
    }
}
