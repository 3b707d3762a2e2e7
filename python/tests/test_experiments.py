"""Locks, plans, searches, simulations and scenarios, beside what methods say and what the program writes."""

import numpy as np
import pytest

import ulna

from conftest import ROOT, load, states

PAPER = ROOT / "scenarios" / "paper_like.toml"


@pytest.fixture(scope="module")
def scenario():
    return ulna.Scenario.load(PAPER)


@pytest.fixture(scope="module")
def operation(scenario):
    return scenario.operation("5.2", 10.0)


def test_the_impact_of_one_joint_is_a_column_of_lock_impacts(arm):
    q, qd, qdd, *_ = states(arm, 6)
    columns = arm.lock_impacts(q, qd, qdd)
    for joint in range(arm.n):
        impact = arm.impact_torque(q, qd, qdd, [joint])
        np.testing.assert_allclose(impact, columns[:, :, joint], rtol=1e-9, atol=1e-9 * np.abs(columns).max())


def test_the_impact_of_several_is_a_difference_of_inverse_dynamics():
    arm = load("ssrms")
    q, qd, qdd, _, wrench = states(arm, 6)
    held = np.ones(arm.n)
    held[[1, 4]] = 0.0
    difference = arm.inverse_dynamics(q, qd, qdd) - arm.inverse_dynamics(q, qd * held, qdd * held)
    np.testing.assert_allclose(arm.impact_torque(q, qd, qdd, [1, 4]), difference, rtol=1e-9, atol=1e-8)
    step = wrench[0]
    with_force = arm.impact_torque(q, qd, qdd, [1, 4], wrench_step=step)
    pulled = np.einsum("src,r->sc", arm.geometric_jacobian(q), step)
    np.testing.assert_allclose(with_force, difference + pulled, rtol=1e-9, atol=1e-8)
    force, moment = arm.structure_loads(q, qd, qdd, [1, 4])
    assert force.shape == moment.shape == (6, 7, 3)
    np.testing.assert_allclose(moment[:, :, 2], difference, rtol=1e-9, atol=1e-8)
    one = arm.impact_torque(q[0], qd[0], qdd[0], [1, 4])
    assert one.shape == (7,) and np.array_equal(one, arm.impact_torque(q, qd, qdd, [1, 4])[0])


def test_joints_that_are_none_are_refused():
    arm = load("planar_2r")
    with pytest.raises(ulna.ExperimentError, match="joint 3 fails, the arm has 2"):
        arm.impact_torque([0, 0], [0, 0], [0, 0], [2])
    with pytest.raises(ValueError, match=r"wrench_step: expected shape \(3,\) or \(6,\), found \(2,\)"):
        arm.impact_torque([0, 0], [0, 0], [0, 0], [1], wrench_step=[1.0, 2.0])


def test_a_plan_goes_from_rest_to_rest():
    arm = load("planar_2r")
    plan = arm.plan([0.2, 0.4], [0.8, 1.2], duration=10.0, blend=2.0, profile="quintic")
    times = np.linspace(0.0, plan.duration, 2001)
    q, qd, qdd = plan.states(times)
    np.testing.assert_allclose(q[[0, -1]], [[0.2, 0.4], [0.8, 1.2]], atol=1e-12)
    np.testing.assert_allclose(qd[[0, -1]], 0.0, atol=1e-12)
    np.testing.assert_allclose(np.gradient(q, times, axis=0)[1:-1], qd[1:-1], atol=1e-4)
    np.testing.assert_allclose(np.gradient(qd, times, axis=0)[1:-1], qdd[1:-1], atol=1e-3)
    along = arm.plan([0.2, 0.9], displacement=[0.1, 0.0, 0.0], duration=10.0, blend=2.0)
    q, _, _ = along.states([0.0, 10.0])
    tool = arm.forward_kinematics(q)[:, :3, 3]
    np.testing.assert_allclose(tool[1] - tool[0], [0.1, 0.0, 0.0], atol=1e-6)
    with pytest.raises(ulna.ExperimentError, match="joint 1"):
        arm.plan([0.0, 0.0], [1.0, 1.0], duration=10.0, blend=2.0, max_acceleration=1e-3)
    with pytest.raises(ValueError, match='profile: expected "trapezoid" or "quintic" or "s_curve", found "cubic"'):
        arm.plan([0.0, 0.0], [1.0, 1.0], duration=10.0, blend=2.0, profile="cubic")
    with pytest.raises(TypeError, match="either goal or displacement"):
        arm.plan([0.0, 0.0], duration=10.0, blend=2.0)


def test_a_scenario_tells_what_is_in_it(scenario):
    assert (scenario.name, scenario.arm.name, scenario.arm.n) == ("paper_like", "ssrms", 7)
    assert scenario.failed_joints == [1] and scenario.failure_times == [3.0, 10.0, 18.0]
    first = scenario.experiments[0]
    assert first.section == "5.2" and first.force[:3, 0].tolist() == [20.0] * 3 and first.rated_torque is None
    assert scenario.plan().duration == 20.0


def test_a_scenario_is_refused_with_every_error():
    text = PAPER.read_text(encoding="utf-8").replace('"trapezoid"', '"trapezium"').replace('arm = "ssrms"', 'arm = "ssrm"')
    with pytest.raises(ulna.ScenarioError) as caught:
        ulna.Scenario.parse(text, "wrong.toml")
    shown = str(caught.value)
    assert 'did you mean "ssrms"?' in shown and "trapezium" in shown and "wrong.toml:" in shown
    assert len(caught.value.findings) == 2


def test_the_lock_of_a_scenario_is_that_of_its_plan(scenario, operation):
    """The step of Eq. 18 from the plan's state, by the arm's own methods."""
    q, qd, qdd = scenario.plan().states([10.0])
    impact = scenario.arm.impact_torque(q, qd, qdd, scenario.failed_joints)[0]
    np.testing.assert_allclose(operation.step, -impact, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("method", ["eq16", "eq20", "optimal"])
def test_searches_lower_the_healthy_impact(operation, method):
    found = operation.search(method)
    before = np.linalg.norm(np.delete(operation.step, 1))
    assert found["healthy_impact"] < before
    np.testing.assert_allclose(np.linalg.norm(np.delete(found["impact"], 1)), found["healthy_impact"])
    again = operation.assess(found["law"])
    assert found["law"].kind == method
    np.testing.assert_allclose(again["impact"], found["impact"], rtol=1e-6, atol=1e-6 * before)
    if method == "eq16":
        law = ulna.Law.eq16(found["law"].coefficients.tolist())
        assert np.array_equal(operation.assess(law)["impact"], again["impact"])
    if method == "optimal":
        assert np.linalg.norm(found["force_error_before"]) < 1e-6 * before
        law = ulna.Law.optimal(*found["law"].free_torques)
        assert np.array_equal(operation.assess(law)["impact"], again["impact"])


def test_a_lock_of_ones_own_is_that_of_the_scenario(scenario, operation):
    own = scenario.plan().lock([1], 10.0, force=[20, 20, 20], sample_period=scenario.cycle)
    assert np.array_equal(own.step, operation.step)
    assert np.array_equal(own.search("eq16")["law"].coefficients, operation.search("eq16")["law"].coefficients)
    powers = np.zeros((6, 2))
    powers[:3, 0] = 20.0
    assert np.array_equal(scenario.plan().lock([1], 10.0, force=powers, sample_period=scenario.cycle).step, own.step)
    with pytest.raises(ulna.ExperimentError, match="must lie within the motion"):
        scenario.plan().lock([1], 30.0)


def test_a_study_holds_the_papers_cases(scenario):
    study = scenario.study("5.2", 10.0)
    assert [*study["cases"]] == ["eq16_steps", "eq16", "eq20_steps", "eq20", "optimal"]
    case = study["cases"]["eq16"]
    # Within a factor of the paper's Table 2, to which the scenario was fitted: 0.5 to 1.8.
    paper = np.array([30.18, 66.72, 20.48, 1.24, 0.67, 3.04])
    ratio = case["impact_before"][:6] / paper
    assert ((ratio > 0.5) & (ratio < 1.8)).all()
    assert case["healthy_impact_after"] < case["healthy_impact_before"] and case["infeasible"] is None
    series = case["series"]
    assert series["torque"].shape == series["planned"].shape == (len(series["time"]), 7)
    assert series["force_error"].shape == (len(series["time"]), 6)
    # The torque is what the controller gives: at the first time it is that of a cycle.
    q, qd, qdd = scenario.plan().states(series["time"][:1])
    cycle = scenario.arm.control_cycle(
        q[0], qd[0], qdd[0], ulna.Law.eq16(case["coefficients"].tolist()), wrench=[20, 20, 20], rated_torque=np.inf
    )
    np.testing.assert_allclose(cycle["torque"], series["torque"][0], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(cycle["planned"], series["planned"][0], rtol=1e-9, atol=1e-9)
    assert cycle["status"] == "nominal"
    with pytest.raises(ulna.ExperimentError, match="there are 5.2"):
        scenario.study("6.1", 10.0)


def test_a_lock_is_simulated(operation):
    run = operation.simulate(start=9.9, end=10.2, brake_time=0.05)
    samples = len(run["time"])
    assert run["ending"] == "complete" and run["q"].shape == run["joint_torque"].shape == (samples, 7)
    assert abs(run["energy_error"]) < 1e-6 and abs(run["momentum_error"]) < 1e-6
    assert np.abs(run["qd"][run["time"] > 10.051][:, 1]).max() < 1e-9
    assert run["impact"]["torque_step"].shape == (7,)
    again = operation.simulate(operation.search("eq20")["law"], start=9.9, end=10.2, brake_time=0.05)
    assert not np.array_equal(again["motor"], run["motor"][: len(again["motor"])])


def test_a_scenario_is_assessed():
    text = PAPER.read_text(encoding="utf-8")
    for many, few in [("failure_times = 79", "failure_times = 2"), ("locks_at_once = 2", 'locks_at_once = 1\nlaws = ["eq16"]')]:
        assert many in text
        text = text.replace(many, few)
    found = ulna.Scenario.parse(text, PAPER).assess(threads=0)
    assert found["arm"] == "ssrms" and found["laws"][0]["law"] == "none"
    for law in found["laws"]:
        cases = law["cases"]
        assert len(cases["joints"]) == len(cases["time"]) == len(cases["before"])
        assert law["worst_ratio"] >= law["median_ratio"]
    assert found["laws"][0]["worst_ratio"] == 1.0


def test_the_arms_that_come_with_the_package_are_those_of_the_repository():
    folder = sorted(path.stem for path in (ROOT / "arms").glob("*.toml"))
    assert ulna.arms() == folder
    for name in folder:
        assert ulna.arm(name).table == (ROOT / "arms" / f"{name}.toml").read_text(encoding="utf-8")
    with pytest.raises(ValueError, match='no arm is called "srms": did you mean "ssrms"?'):
        ulna.arm("srms")


def test_experiments_take_no_payload_at_run_time():
    arm = load("geared_6").carrying(1.0)
    with pytest.raises(ulna.ExperimentError, match="without a payload at run time"):
        arm.plan(np.zeros(6), np.ones(6), duration=10.0, blend=2.0)
