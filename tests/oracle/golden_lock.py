"""What a lock of each joint changes in all joint torques, to 40 digits, at the configurations of golden_pinocchio.py.

By its definition, with numbers of 80 digits: Lagrange's torques M qdd + c(q, qd) of the motion before the lock of joint k,
minus those of the motion after it, in which qd_k and qdd_k are 0. M is that of golden_mpmath.py, which reads the tables
itself; its slopes are central differences with a step of 1e-25, whose error is of order 1e-50, and
    c_i = sum over j, l of (dM_ij/dq_l - dM_jl/dq_i / 2) qd_j qd_l.
Gravity is the same before and after.
Writes data/<arm>.lock.jsonl beside this file: one configuration a line, with
    lock_impacts    N x N, column by column: column k for a lock of joint k, before minus after

    python3 -m venv .venv && .venv/bin/pip install mpmath==1.3.0
    .venv/bin/python tests/oracle/golden_lock.py
"""

import json
import sys
import tomllib

from mpmath import mpf, nstr

from golden_mpmath import ARMS, HERE, STEP, Arm


def mass_matrix_and_slopes(arm, q):
    def mass_matrix(i, step):
        moved = list(q)
        moved[i] += step
        return arm.jacobian_and_mass_matrix(moved)[1]

    slopes = [(mass_matrix(i, STEP) - mass_matrix(i, -STEP)) / (2 * STEP) for i in range(len(q))]
    return mass_matrix(0, mpf(0)), slopes


def torque(mass_matrix, slopes, qd, qdd):
    n = range(len(qd))
    rate = sum((slopes[i] * qd[i] for i in n), mass_matrix * 0)
    energy_slope = [sum(slopes[i][j, k] * qd[j] * qd[k] for j in n for k in n) / 2 for i in n]
    return [sum(mass_matrix[i, j] * qdd[j] + rate[i, j] * qd[j] for j in n) - energy_slope[i] for i in n]


def lock_impacts(arm, q, qd, qdd):
    mass_matrix, slopes = mass_matrix_and_slopes(arm, q)
    before = torque(mass_matrix, slopes, qd, qdd)
    columns = []
    for k in range(len(q)):
        held = [[mpf(0) if i == k else x for i, x in enumerate(motion)] for motion in (qd, qdd)]
        after = torque(mass_matrix, slopes, *held)
        columns += [x - y for x, y in zip(before, after)]
    return columns


def main():
    for path in sorted(ARMS.glob("*.toml")):
        if sys.argv[1:] and path.stem not in sys.argv[1:]:
            continue
        arm = Arm(tomllib.loads(path.read_text()))
        configurations = (HERE / "data" / f"{path.stem}.jsonl").read_text().splitlines()
        with open(HERE / "data" / f"{path.stem}.lock.jsonl", "w") as out:
            for line in configurations:
                state = json.loads(line)
                q, qd, qdd = ([mpf(x) for x in state[name]] for name in ("q", "qd", "qdd"))
                columns = ",".join(nstr(x, 20) for x in lock_impacts(arm, q, qd, qdd))
                out.write(f'{{"lock_impacts":[{columns}]}}\n')
        print(f"{path.stem}: {len(configurations)} configurations")


if __name__ == "__main__":
    main()
