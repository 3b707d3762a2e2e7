"""Section 5 of the paper, as far as it can be repeated: joint 2 of the SSRMS locks, and the impact torque is suppressed.

    python examples/section_5.py [SCENARIO] [PICTURE]
"""

# %% The scenario: an arm, its motion, the lock, experiments
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import ulna

root = Path(__file__).resolve().parents[2]
scenario = ulna.Scenario.load(sys.argv[1] if len(sys.argv) > 1 else root / "scenarios" / "paper_like.toml")
picture = sys.argv[2] if len(sys.argv) > 2 else "section_5.png"
laws = {"eq16": "Eq. 16", "eq20": "Eq. 20", "optimal": "least impact, force kept"}

# %% Table 2: the impact torque joint by joint at each failure time, without compensation and with it
section = scenario.experiments[0].section
studies = [scenario.study(section, time) for time in scenario.failure_times]
for study in studies:
    print(f"lock at {study['failure_time']:g} s, N m")
    print("  without  ", study["cases"]["eq16"]["impact_before"].round(2))
    for law, label in laws.items():
        print(f"  {law:9}", study["cases"][law]["impact_after"].round(2))

# %% Figure 4: torques over time; and what every law leaves
study = studies[len(studies) // 2]
time, joints = study["failure_time"], [0, 2]
figure, axes = plt.subplots(1, len(joints) + 1, figsize=(13, 3.8), layout="constrained")
for axis, joint in zip(axes, joints):
    series = study["cases"]["eq16"]["series"]
    axis.plot(series["time"], series["planned"][:, joint], "k", label="without compensation")
    for law, label in laws.items():
        series = study["cases"][law]["series"]
        axis.plot(series["time"], series["torque"][:, joint], label=label)
    axis.axvline(time, color="0.7", linestyle=":")
    axis.set(title=f"joint {joint + 1}, lock at {time:g} s", xlabel="time in s", ylabel="torque in N m")
axes[0].legend(fontsize="small")
places = np.arange(scenario.arm.n)
bars = [("without", study["cases"]["eq16"]["impact_before"], "k")]
bars += [(label, study["cases"][law]["impact_after"], None) for law, label in laws.items()]
for shift, (label, impact, colour) in zip(np.linspace(-0.3, 0.3, len(bars)), bars):
    axes[-1].bar(places + shift, impact, 0.2, color=colour, label=label)
axes[-1].set(title=f"impact of the lock, experiment {section}", xlabel="joint (2 locks)", ylabel="N m", xticks=places, xticklabels=places + 1)
figure.savefig(picture, dpi=110)
print("wrote", picture)
