"""Dynamics of robot arms from a table, and what a joint that locks does to them.

    import numpy as np
    import ulna

    arm = ulna.load("arm.toml")               # or "robot.urdf", tip="hand"
    M = arm.mass_matrix(np.zeros(arm.n))      # (n, n), kg m^2
    q = np.random.uniform(-3, 3, (1000, arm.n))
    M = arm.mass_matrix(q, threads=0)         # (1000, n, n), on all cores

    scenario = ulna.Scenario.load("scenario.toml")
    study = scenario.study("5.2", time=10.0)  # every search for a compensation, with its whole motion

SI units and radians throughout. Twists and wrenches are linear first, ``[v; w]`` and ``[f; n]``, in world axes, at the tool point.
"""

from ._arm import Arm, Limits, Payload
from ._campaign import Campaign, campaign, read_campaign
from ._experiments import Operation, Plan
from ._load import arm, arms, load, parse
from ._reports import Deviation, Report, Verification
from ._scenario import Experiment, Scenario
from ._ulna import (
    CampaignError,
    DescriptionError,
    Error,
    ExperimentError,
    Finding,
    Law,
    ScenarioError,
    TableError,
    TableWarning,
    set_threads,
    threads,
)

__all__ = [
    "Arm",
    "Campaign",
    "CampaignError",
    "DescriptionError",
    "Deviation",
    "Error",
    "Experiment",
    "ExperimentError",
    "Finding",
    "Law",
    "Limits",
    "Operation",
    "Payload",
    "Plan",
    "Report",
    "Scenario",
    "ScenarioError",
    "TableError",
    "TableWarning",
    "Verification",
    "arm",
    "arms",
    "campaign",
    "load",
    "parse",
    "read_campaign",
    "set_threads",
    "threads",
]
