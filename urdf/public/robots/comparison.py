"""How far two lists of values are apart."""

import numpy as np

QUANTITIES = {"pose": "pose", "jacobian": "J", "mass_matrix": "M", "inverse_dynamics": "tau", "gravity_torque": "g"}
ROADS = ("generated", "textbook")


def differences(ours, reference):
    """The largest difference of each quantity, over all states and entries, divided by its largest entry in all states; where all of a
    quantity is smaller than a millionth of its unit, as the gravity of an arm that turns upright, undivided."""
    found = {}
    for quantity in QUANTITIES:
        theirs = np.array([values[quantity] for values in reference])
        scale = np.abs(theirs).max()
        own = np.array([values[quantity] for values in ours])
        if own.shape != theirs.shape:
            raise ValueError(f"{quantity}: {own.shape} for {theirs.shape}")
        largest = np.abs(own - theirs).max()
        found[quantity] = float(largest / scale if scale > 1e-6 else largest)
    return found
