"""docs/casadi.md."""

import datetime
import platform

import casadi as ca

from .compare import HESSIANS, Arm


def page(arms: list[Arm]) -> str:
    parts = [HEAD.format(date=datetime.date.today(), casadi=ca.__version__, machine=processor(), python=platform.python_version())]
    return "\n".join(parts + [section(one) for one in arms])


def section(one: Arm) -> str:
    task = one.task
    lines = [
        f"## {one.name}: {len(task.start)} joints, {task.seconds:g} s in {task.intervals} intervals\n",
        "| | Hessian | iterations, external | own | optimum, external | own | solving, s, external | own | building, s, external | own |",
        "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|",
    ]
    for pair in one.pairs:
        a, b = pair.external, pair.own
        ends = [f"{s.iterations}{'' if s.status.startswith('Solve') else ' (' + s.status.replace('_', ' ') + ')'}" for s in (a, b)]
        lines.append(
            f"| {pair.formulation} | {HESSIANS[pair.hessian]} | {ends[0]} | {ends[1]} | {a.optimum:.9g} | {b.optimum:.9g} |"
            f" {a.solve:.2f} | {b.solve:.2f} | {a.build:.2f} | {b.build:.2f} |"
        )
    lines += ["", "A call from within CasADi, µs of the processor (2,000 mapped into one):", "", "| | external | own |", "|---|--:|--:|"]
    for name in ("inverse dynamics", "forward dynamics"):
        for kind in ("value", "Jacobian"):
            times = [one.calls[name, kind, who] for who in ("external", "own")]
            lines.append(f"| {name}, {kind} | {times[0]:.2f} | {times[1]:.2f} |")
    lines += [
        "", f"Values and Jacobians differ by at most {one.difference:.0e} of the largest entry, at 50 random states.",
        f"C code that CasADi writes of an expression with the function and its Jacobians, linked with the library, is off by {one.generated:.0e}.",
        "",
    ]
    return "\n".join(lines)


def processor():
    with open("/proc/cpuinfo") as file:
        return next((line.split(":")[1].strip() for line in file if line.startswith("model name")), platform.machine())


HEAD = """\
# An arm in CasADi

    ulna generate arms/ssrms.toml --language c --abi casadi --output DIR
    cd DIR && cc -O2 -shared -fPIC ssrms.c ssrms_casadi.c -o libssrms.so -lm

```python
import casadi
options = {{"jacobian_options": {{"enable_fd": True}}}}  # only for second derivatives, see below
forward_dynamics = casadi.external("ssrms_casadi_forward_dynamics", "./libssrms.so", options)
inverse_dynamics = casadi.external("ssrms_casadi_inverse_dynamics", "./libssrms.so", options)
```

Two functions, `(q, qd, tau) -> qdd` and `(q, qd, qdd) -> tau`, that go wherever a function of CasADi's goes; an arm with `[payload] runtime = true` has a fourth
input `payload`, its ten inertial parameters as `NAME_payload` writes them. Their Jacobians by all inputs, the payload among them, are exact and compiled as well
(`jac_NAME_casadi_...`, which CasADi finds by itself), and so sparse as the arm is. The plain functions of `NAME.h` are in the same library under their own
names: CasADi's way to call a function is another one, hence the `casadi` in its names.

**Second derivatives** are not generated. An exact Hessian of the Lagrangian (IPOPT's default) fails with `Derivatives cannot be calculated for jac_...`.
What works:

- `{{"ipopt": {{"hessian_approximation": "limited-memory"}}}}`, or an SQP method of Gauss and Newton's, which take first derivatives alone;
- the option `jacobian_options` above: CasADi then takes differences of the exact Jacobian (`enable_fd` on the function itself does nothing, since that has a Jacobian).
  The last lines of the tables are such Hessians.

**acados** takes the function as part of an expression for the model: the C code that CasADi writes for it calls `ssrms_casadi_forward_dynamics` and its Jacobian,
and is linked with the library (`model_external_shared_lib_dir` and `model_external_shared_lib_name` of the solver's options). Tried here is that code,
not acados itself.

# The same problem twice

Written by `python3 examples/casadi/run.py` on {date}: CasADi {casadi} with the IPOPT of its wheel, Python {python}, {machine}, `cc -O2`; other programs ran beside it.
From rest to rest, least squares of the torques, each in units of the largest that the straight way takes, and of the distance from the straight way.
`shooting` is multiple shooting with the forward dynamics (Runge and Kutta, fourth order), `transcription` has the accelerations among its variables and the
inverse dynamics in its cost. `own` is the textbook in CasADi's SX: Newton and Euler's torques, M by composite rigid bodies, solved by LDL factors,
run by CasADi's interpreter; compiled by its code generator, the same formulations are compared in `benches/peers/results.md`. Tolerance 1e-6. Times are those of the processor.
Limited-memory steps gather rounding errors, so that they reach the same optimum after another number of iterations.
With a limited-memory Hessian the transcription of ssrms ends within 1,000 iterations neither way, and is left out.
"""
