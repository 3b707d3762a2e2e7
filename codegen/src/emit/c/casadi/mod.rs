//! The dynamics of an arm as functions that CasADi takes from a shared library.
//!
//! `casadi.external("NAME_casadi_inverse_dynamics", "./libNAME.so")` finds there what CasADi's own code generator would have
//! written for such a function: its value, its inputs' and outputs' names and sparsities, and with the prefix `jac_` the same for its Jacobian,
//! a block for each input. (Checked against the code that CasADi 3.8 writes, and against the symbols that it looks up: `casadi/core/external.cpp`.)
//!
//! The functions have names of their own, since CasADi's way to call a function is not that of the others, and both stand in one library.

mod block;
mod function;
mod interface;

use ulna::{Method, Payload};

use super::interface::{File, guarded};
use super::lines::comment;
use super::options::Precision;
use super::target::Target;
use crate::Compiled;
use function::Function;

/// The methods that it calls; one more if the arm has a payload.
pub(super) fn needed(has_payload: bool) -> Vec<Method> {
    let mut methods = vec![
        Method::InverseDynamics,
        Method::InverseDynamicsDerivatives,
        Method::MassMatrix,
        Method::ForwardDynamics,
        Method::ForwardDynamicsDerivatives,
    ];
    // What the torques are by the payload's parameters.
    methods.extend(has_payload.then_some(Method::Regressor));
    methods
}

/// The two files, which include the arm's own header. None in single precision, which CasADi does not speak, nor where a method that they
/// [need](needed) is not compiled.
///
/// They are files of their own because nothing in `NAME.c` should be called from there and from elsewhere (MISRA C:2012, rule 8.7).
pub(super) fn further(target: &Target<'_>, compiled: &Compiled, about: &[String]) -> Vec<File> {
    let functions = Function::inverse_dynamics(target, compiled)
        .zip(Function::forward_dynamics(target, compiled));
    match functions {
        Some((inverse, forward)) if target.options.precision == Precision::Double => {
            let functions = [inverse, forward];
            let name = target.own("casadi");
            vec![
                (format!("{name}.h"), header(target, &functions, about)),
                (format!("{name}.c"), source(target, &functions, about)),
            ]
        }
        _ => Vec::new(),
    }
}

fn header(target: &Target<'_>, functions: &[Function; 2], about: &[String]) -> String {
    let name = target.model.name();
    let build = format!("cc -O2 -shared -fPIC {name}.c {name}_casadi.c -o lib{name}.so -lm");
    let load = format!(
        "casadi.external(\"{}\", \"./lib{name}.so\")",
        target.own("casadi_forward_dynamics")
    );
    let convention = [
        "Inverse and forward dynamics as casadi.external takes them from a shared library:",
        "",
        &format!("    {build}"),
        &format!("    {load}"),
        "",
        "Inputs and outputs are vectors. A Jacobian has a block for each input, by columns, without what is 0",
        "at every state. An input that is NULL is 0, an output that is NULL is not computed; iw, w and mem are",
        "not used. Every function returns 0, and may be called by several threads at once.",
    ]
    .map(str::to_owned);
    let prototypes: String = functions.iter().map(Function::prototypes).collect();
    guarded(
        &target.own("casadi_h"),
        &(comment(about) + &comment(&convention)),
        &prototypes,
    )
}

fn source(target: &Target<'_>, functions: &[Function; 2], about: &[String]) -> String {
    let name = target.model.name();
    let definitions: String = functions.iter().map(Function::definitions).collect();
    format!(
        "{about}#include \"{name}_casadi.h\"\n\n#include <stddef.h>\n\n#include \"{name}.h\"\n\n{helpers}{definitions}",
        about = comment(about),
        helpers = helpers(target),
    )
}

/// What the functions share.
fn helpers(target: &Target<'_>) -> String {
    let joints = target.joints().len();
    let has_payload = target.model.has_payload();
    let longest = if has_payload {
        joints.max(Payload::PARAMETERS)
    } else {
        joints
    };
    let zeros = format!(
        "/* An input, or zeros where none is passed. */
static const double *given(const double *input)
{{
    static const double zeros[{longest}] = {{ 0 }};

    return (input != NULL) ? input : zeros;
}}
"
    );
    let solved = if has_payload { SOLVED } else { "" };
    zeros + PICK + solved + SIZES
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
            long long int k;
            for (k = 0; k < (rows * columns); k++)
            {
                entries[k] = matrix[k];
            }
        }
        else
        {
            long long int j;
            for (j = 0; j < columns; j++)
            {
                long long int k;
                for (k = sparsity[2 + j]; k < sparsity[3 + j]; k++)
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
    int j;
    for (j = 0; j < columns; j++)
    {
        int i;
        for (i = 0; i < rows; i++)
        {
            double sum = 0.0;
            int k;
            for (k = 0; k < rows; k++)
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
