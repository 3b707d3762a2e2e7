"""From files and texts to arms, and the words in which they are refused."""

import copy
import pickle
import warnings

import numpy as np
import pytest

import ulna

from conftest import ROOT, URDF, load, states

TABLE = (ROOT / "arms" / "planar_2r.toml").read_text(encoding="utf-8")


def test_a_table_tells_of_its_arm():
    arm = load("geared_6")
    assert (arm.name, arm.n, repr(arm)) == ("geared_6", 6, "<ulna.Arm geared_6: 6 joints>")
    assert arm.joint_names[0] == "turntable" and arm.joint_kinds[:2] == ["revolute", "prismatic"]
    assert arm.limits.lower.shape == arm.limits.upper.shape == arm.limits.velocity.shape == (6,)
    assert (arm.limits.lower < arm.limits.upper).all()
    assert arm.gravity.tolist() == [0.0, 0.0, -9.81]
    assert arm.task == ["x", "y", "z", "rx", "ry", "rz"]
    assert arm.base[:3, 3].tolist() == [-0.2, 0.35, 0.6] and arm.tool[:3, 3].tolist() == [0.03, -0.015, 0.14]
    assert np.allclose(arm.base[:3, :3] @ arm.base[:3, :3].T, np.eye(3))
    assert arm.table == (ROOT / "arms" / "geared_6.toml").read_text(encoding="utf-8")
    assert np.isinf(load("planar_2r").limits.upper).all()
    assert load("ssrms").rated_torque.shape == (7,)


def test_a_description_becomes_an_arm():
    arm = ulna.load(URDF, tip="hand", name="with_hand")
    assert (arm.name, arm.n, arm.joint_names) == ("with_hand", 3, ["turn", "shoulder", "elbow"])
    assert arm.rated_torque.tolist() == [120.0, 120.0, 60.0]
    assert arm.limits.lower.tolist() == [-np.inf, -2.0, -2.6]
    assert any("finger" in note for note in arm.notes)
    text = URDF.read_text(encoding="utf-8")
    assert ulna.parse(text, URDF, tip="hand", name="with_hand").table == arm.table
    again = ulna.parse(arm.table)
    q = states(arm, 5).q
    assert np.array_equal(again.mass_matrix(q), arm.mass_matrix(q))
    bare = ulna.load(URDF, drop=["hand"])
    assert not np.array_equal(bare.mass_matrix(q), arm.mass_matrix(q))


def test_every_error_of_a_table_is_told_at_once_with_its_place():
    text = TABLE.replace('"modified"', '"craig"').replace("mass = ", "mas = ", 1)
    with pytest.raises(ulna.TableError) as caught:
        ulna.parse(text, "wrong.toml")
    shown = str(caught.value)
    findings = caught.value.findings
    assert isinstance(caught.value, ValueError) and len(findings) >= 2
    for found in findings:
        line = text.splitlines()[found.line - 1]
        assert found.severity == "error" and found.message in shown and line in shown
        assert f"wrong.toml:{found.line}:{found.column}" in shown
    assert "error: " in shown and "did you mean `mass`?" in shown


def test_a_description_is_refused_with_every_end_that_there_is():
    with pytest.raises(ulna.DescriptionError, match="finger_left") as caught:
        ulna.load(URDF)
    assert caught.value.findings
    with pytest.raises(ulna.DescriptionError, match="did you mean `hand`"):
        ulna.load(URDF, tip="hnd")


def test_a_file_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(ulna.TableError, match=r"nowhere\.toml"):
        ulna.load(tmp_path / "nowhere.toml")


def test_what_is_rarely_meant_is_a_warning_where_it_was_asked_for():
    text = TABLE.replace("mass = ", "mass = 1000", 1)
    with pytest.warns(ulna.TableWarning, match="switches this off") as caught:
        ulna.parse(text)
    assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ulna.TableWarning):
            ulna.parse(text)


def test_options_of_descriptions_are_not_for_tables():
    with pytest.raises(TypeError, match=r"tip: is for robot descriptions \(\.urdf\), and arm\.toml is a table"):
        ulna.parse(TABLE, tip="hand")
    with pytest.raises(TypeError, match="drop: expected a list of names, found the name 'hand' alone"):
        ulna.load(URDF, drop="hand")


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda arm: pickle.loads(pickle.dumps(arm))])
def test_an_arm_goes_to_other_processes(again):
    arm = load("geared_6").carrying(2.5, [0.1, 0.0, 0.2])
    copied = again(arm)
    q = states(arm, 3).q
    assert repr(copied) == "<ulna.Arm geared_6: 6 joints, carrying 2.5 kg>"
    assert np.array_equal(copied.mass_matrix(q), arm.mass_matrix(q))
