"""What the program does with a table, from Python."""

import ctypes
import shutil
import subprocess

import numpy as np
import pytest

import ulna

from conftest import ROOT, TABLE, load


def test_code_is_that_of_the_program():
    """Among the examples a file of it is checked in, of three methods."""
    written = (ROOT / "examples" / "checked_in" / "src" / "planar_2r.rs").read_text(encoding="utf-8")
    methods = ["mass_matrix", "inverse_dynamics", "dynamic_manipulability_gradient"]
    assert load("planar_2r").generate("rust", methods=methods) == written
    assert len(load("planar_2r").generate()) > len(written)
    with pytest.raises(ValueError, match="unknown method `mass_matirx`: did you mean `mass_matrix`"):
        load("planar_2r").generate(methods=["mass_matirx"])
    with pytest.raises(ValueError, match='language: expected "rust" or "c", found'):
        load("planar_2r").generate("fortran")


def test_c_computes_what_python_does(tmp_path):
    """Where there is a C compiler."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler")
    arm = load("planar_2r")
    header, source = arm.generate("c", methods=["mass_matrix", "gravity_torque"])
    (tmp_path / "planar_2r.h").write_text(header, encoding="utf-8")
    (tmp_path / "planar_2r.c").write_text(source, encoding="utf-8")
    library = tmp_path / "planar_2r.so"
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", tmp_path / "planar_2r.c", "-o", library, "-lm"], check=True)
    q = np.array([0.3, -0.7])
    matrix = np.zeros(4)
    pointer = ctypes.POINTER(ctypes.c_double)
    ctypes.CDLL(str(library)).planar_2r_mass_matrix(q.ctypes.data_as(pointer), matrix.ctypes.data_as(pointer))
    np.testing.assert_allclose(matrix.reshape(2, 2).T, arm.mass_matrix(q), rtol=1e-14)
    assert "float" in arm.generate("c", precision="float")[0] and "planar_2r_inverse_dynamics" in arm.generate("c")[0]
    with pytest.raises(ValueError, match="function_length: expected 20 or more, found 3"):
        arm.generate("c", function_length=3)


def test_every_method_has_its_cost():
    cost = load("planar_2r").cost()
    assert cost["arm"] == "planar_2r" and list(cost["quantities"]) == list(TABLE)
    for counts in cost["quantities"].values():
        assert counts["total"] == sum(count for name, count in counts.items() if name not in ("total", "sin_cos"))
    assert [*load("planar_2r").cost(methods=["mass_matrix"])["quantities"]] == ["mass_matrix"]


def test_an_arm_is_verified():
    found = load("planar_2r").verify(10)
    assert found.passes
    for report in (found.emitted, found.textbook, found.differences):
        assert report.passes and report.states == 10 and str(report) in str(found)
        assert all(it.passes and 0.0 <= it.error <= it.tolerance for it in report.deviations)
    assert {it.method for it in found.emitted.deviations} >= set(TABLE)
    with pytest.raises(ValueError, match="samples: expected 1 or more, found 0"):
        load("planar_2r").verify(0)


def test_payloads_that_no_body_has_are_refused():
    arm = load("geared_6")
    with pytest.raises(ValueError, match="a payload of -1 kg"):
        arm.carrying(-1.0)
    with pytest.raises(ValueError, match="is not that of a rigid body"):
        arm.carrying(1.0, inertia=[[1, 0, 0], [0, 1, 0], [0, 0, 5]])
    with pytest.raises(ValueError, match=r"com: expected shape \(3,\), found \(2,\)"):
        arm.carrying(1.0, [0.0, 0.0])
    with pytest.raises(ValueError, match="runtime = true"):
        load("ssrms").carrying(1.0)
    assert arm.payload is None and arm.carrying(1.0).payload.mass == 1.0
