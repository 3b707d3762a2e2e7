"""An arm's table, read for the peers alone: nothing here passes through ulna.

A row of either convention is  T_i(q) = before_i * joint(q_i) * after_i  with the joint along z of its own frame.
Frames here are the joints': what stands after a joint goes into the next one's placement, or the tool's.
"""

import math
import tomllib
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

TASKS = {"position": ["x", "y", "z"], "pose": ["x", "y", "z", "rx", "ry", "rz"]}
ROWS = TASKS["pose"]


@dataclass
class Joint:
    revolute: bool
    placement: np.ndarray  # pose at q = 0 in the frame of the joint before, or the base
    mass: float
    com: np.ndarray  # in the joint's frame
    inertia: np.ndarray  # about the centroid, in the joint's axes
    armature: float  # the rotor's inertia as the joint feels it
    viscous: float
    coulomb: float
    smoothing: float  # rate over which Coulomb's friction turns its sign


@dataclass
class Arm:
    name: str
    joints: list[Joint]
    gravity: np.ndarray
    base: np.ndarray  # world_from_base
    tool: np.ndarray  # last joint_from_tool
    task: list[int]  # rows of J in w_D

    def has_friction(self):
        return any(joint.viscous or joint.coulomb for joint in self.joints)


def in_motion_alone(arm: Arm) -> Arm:
    """The same without gravity and friction."""
    joints = [replace(joint, viscous=0.0, coulomb=0.0) for joint in arm.joints]
    return replace(arm, joints=joints, gravity=0 * arm.gravity)


def sin_cos(angle):
    """Exact at quarter turns, as anyone who writes such a table by hand has them."""
    quarters = angle / (math.pi / 2)
    if abs(quarters - round(quarters)) < 1e-12:
        return [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][round(quarters) % 4]
    return math.sin(angle), math.cos(angle)


def turn(axis, angle):
    sin, cos = sin_cos(angle)
    i, j = [(1, 2), (2, 0), (0, 1)]["xyz".index(axis)]
    pose = np.eye(4)
    pose[i, i] = pose[j, j] = cos
    pose[i, j], pose[j, i] = -sin, sin
    return pose


def shift(x, y, z):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def read(path: Path) -> Arm:
    table = tomllib.loads(path.read_text())
    unit = math.radians(1) if table["angle_unit"] == "deg" else 1.0

    def placement_of(key):
        at = table.get(key, {})
        roll, pitch, yaw = (unit * angle for angle in at.get("rpy", [0, 0, 0]))
        return shift(*at.get("xyz", [0, 0, 0])) @ turn("z", yaw) @ turn("y", pitch) @ turn("x", roll)

    joints, after = [], np.eye(4)
    for row in table["joint"]:
        along_x = shift(row["a"], 0, 0) @ turn("x", unit * row["alpha"])
        along_z = shift(0, 0, row["d"]) @ turn("z", unit * row["theta"])
        if table["convention"] == "modified":
            placement, after = after @ along_x @ along_z, np.eye(4)
        else:
            placement, after = after @ along_z, along_x
        link, i = row["link"], row["link"]["inertia"]
        xy, xz, yz = (i.get(key, 0.0) for key in ("xy", "xz", "yz"))
        inertia = np.array([[i["xx"], xy, xz], [xy, i["yy"], yz], [xz, yz, i["zz"]]])
        rotation = after[:3, :3]
        motor, friction = row.get("motor", {}), row.get("friction", {})
        joints.append(
            Joint(
                revolute=row.get("kind", "revolute") == "revolute",
                placement=placement,
                mass=link["mass"],
                com=(after @ [*link["com"], 1.0])[:3],
                inertia=rotation @ inertia @ rotation.T,
                armature=float(motor.get("inertia", 0.0) * motor.get("ratio", 1.0) ** 2),
                viscous=float(friction.get("viscous", 0.0)),
                coulomb=float(friction.get("coulomb", 0.0)),
                smoothing=float(friction.get("smoothing", 1e-3)),
            )
        )
    rows = table["task"]["rows"]
    return Arm(
        name=table["name"],
        joints=joints,
        gravity=np.array(table.get("gravity", [0.0, 0.0, 0.0])),
        base=placement_of("base"),
        tool=after @ placement_of("tool"),
        task=sorted(ROWS.index(row) for row in (TASKS[rows] if isinstance(rows, str) else rows)),
    )
