"""What the program does with a table, from Python."""

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
    with pytest.raises(ValueError, match='language: expected "rust"'):
        load("planar_2r").generate("fortran")


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
