"""Golden numbers for arms of arms/ that were converted from robot descriptions: Pinocchio on the descriptions themselves.

Reads the files that each table names, from clones of their repositories at the commits below, by a reading of its own; the tables
are not looked at. So a wrong frame, sign or shift in a table shows. Angles that are rounded there (1.5708) are taken for the quarter
turns that are meant, and lengths below a nanometre for 0, as in the tables.

Writes data/library/<arm>.jsonl beside this file, a configuration a line:
    q, qd, qdd              the arguments; q is the maker's
    pose                    of the tool point in the base, the first three rows
    mass_matrix             the upper triangle, row by row
    inverse_dynamics        at q, qd, qdd
    gravity_torque          at q

    python3 -m venv .venv && .venv/bin/pip install pin==4.1.0 pyyaml
    .venv/bin/python tests/oracle/golden_library.py FOLDER

FOLDER holds clones, each as owner+name (or owner+name/repo): UniversalRobots+Universal_Robots_ROS2_Description, frankaemika+franka_ros,
lbr-stack+lbr_fri_ros2_stack, Kinovarobotics+ros_kortex.
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import numpy as np
import pinocchio as pin
import yaml

CONFIGURATIONS = 10
HERE = pathlib.Path(__file__).resolve().parent


def text(repository, commit, path):
    clone = pathlib.Path(sys.argv[1]) / repository.replace("/", "+")
    clone = clone / "repo" if (clone / "repo").exists() else clone
    return subprocess.run(["git", "-C", clone, "show", f"{commit}:{path}"], check=True, capture_output=True, text=True).stdout


def number(word):
    """A number of a URDF, or pi or a part of it in a xacro's ${...}."""
    expression = word.strip("${} ")
    if re.fullmatch(r"-?pi(/\d+)?", expression):
        return math.pi * (-1 if expression.startswith("-") else 1) / int(expression.partition("/")[2] or 1)
    return float(expression)


def numbers(element, key):
    words = element.get(key, "0 0 0") if element is not None else "0 0 0"
    return [number(word) for word in words.split()]


def meant(angle):
    turns = round(angle / (math.pi / 2))
    return turns * (math.pi / 2) if abs(angle - turns * (math.pi / 2)) < 1e-4 else angle


def placement(xyz, rpy):
    xyz = [0.0 if abs(x) < 1e-9 else x for x in xyz]
    rotation = pin.rpy.rpyToMatrix(*(meant(angle) for angle in rpy))
    # Quarter turns have entries of 0 and 1 but for rounding.
    return pin.SE3(np.where(np.abs(rotation - np.round(rotation)) < 1e-15, np.round(rotation), rotation), np.array(xyz))


def body(mass, xyz, rpy, entries):
    tensor = np.array([[entries[key] for key in row] for row in (("xx", "xy", "xz"), ("xy", "yy", "yz"), ("xz", "yz", "zz"))], float)
    turn = placement([0.0] * 3, rpy).rotation
    return pin.Inertia(float(mass), np.array(xyz, float), turn @ tensor @ turn.T)


def urdf_body(link):
    inertial = link.find("inertial")
    origin = inertial.find("origin")
    entries = {key[1:]: number(value) for key, value in inertial.find("inertia").attrib.items()}
    return body(number(inertial.find("mass").get("value")), numbers(origin, "xyz"), numbers(origin, "rpy"), entries)


def fixed(joint):
    origin = joint.find("origin")
    return placement(numbers(origin, "xyz"), numbers(origin, "rpy"))


def urdf_joint(joint):
    return fixed(joint), np.array(numbers(joint.find("axis"), "xyz"))


def first_by_name(root, tag):
    found = {}
    for element in root.iter(tag):
        found.setdefault(element.get("name"), element)
    return found


def ur5e():
    """The controller's base frame is `base_link_inertia`; `tool0` is the frame of wrist 3."""
    repository = ("UniversalRobots/Universal_Robots_ROS2_Description", "2221ec0")
    kinematics = yaml.safe_load(text(*repository, "config/ur5e/default_kinematics.yaml"))["kinematics"]
    parameters = yaml.safe_load(text(*repository, "config/ur5e/physical_parameters.yaml"))["inertia_parameters"]
    chain = []
    for name in ("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"):
        row, turn = kinematics[name], parameters["rotation"][name]
        before = placement([row[k] for k in "xyz"], [row[k] for k in ("roll", "pitch", "yaw")])
        com = parameters["center_of_mass"][f"{name}_cog"]
        entries = {key[1:]: value for key, value in parameters["tensor"][name].items()}
        link = body(parameters[f"{name}_mass"], [com[k] for k in "xyz"], [turn[k] for k in ("roll", "pitch", "yaw")], entries)
        chain.append((before, np.array([0.0, 0.0, 1.0]), link))
    return chain, pin.SE3.Identity()


def franka_panda():
    folder, repository = "franka_description/robots/common", ("frankaemika/franka_ros", "c11f000")
    joints = first_by_name(ElementTree.fromstring(text(*repository, f"{folder}/franka_arm.xacro")), "joint")
    links = yaml.safe_load(text(*repository, f"{folder}/inertial.yaml"))
    chain = []
    for i in range(1, 8):
        before, axis = urdf_joint(joints["${arm_id}_joint%d" % i])
        link = links[f"link{i}"]
        origin = [[float(x) for x in link["origin"][key].split()] for key in ("xyz", "rpy")]
        chain.append((before, axis, body(link["mass"], *origin, link["inertia"])))
    return chain, fixed(joints["${arm_id}_joint8"])


def described(xacro, joint_names, link_names, tip):
    root = ElementTree.fromstring(xacro)
    joints, links = first_by_name(root, "joint"), first_by_name(root, "link")
    chain = [(*urdf_joint(joints[joint]), urdf_body(links[link])) for joint, link in zip(joint_names, link_names)]
    return chain, fixed(joints[tip])


def iiwa_14():
    xacro = text("lbr-stack/lbr_fri_ros2_stack", "218d723", "lbr_description/urdf/iiwa14/iiwa14_description.xacro")
    name = "${robot_name}_"
    joints, links = ([f"{name}{what}{i}" for i in range(1, 8)] for what in ("A", "link_"))
    return described(xacro, joints, links, f"{name}joint_ee")


def gen3():
    """The link `bracelet_link` stands twice: first the one with the vision module."""
    xacro = text("Kinovarobotics/ros_kortex", "6cd75d4", "kortex_description/arms/gen3/7dof/urdf/gen3_macro.xacro")
    parts = ("shoulder", "half_arm_1", "half_arm_2", "forearm", "spherical_wrist_1", "spherical_wrist_2", "bracelet")
    joints = [f"${{prefix}}joint_{i}" for i in range(1, 8)]
    return described(xacro, joints, [f"${{prefix}}{part}_link" for part in parts], "${prefix}end_effector")


def build(chain, tip):
    model = pin.Model()
    model.gravity.linear = np.array([0.0, 0.0, -9.81])
    parent = 0
    for index, (before, axis, link) in enumerate(chain, 1):
        parent = model.addJoint(parent, pin.JointModelRevoluteUnaligned(axis), before, f"joint{index}")
        model.appendBodyToJoint(parent, link, pin.SE3.Identity())
    return model, model.addFrame(pin.Frame("tool", parent, 0, tip, pin.FrameType.OP_FRAME))


def main():
    (HERE / "data" / "library").mkdir(exist_ok=True)
    for arm in (ur5e, franka_panda, iiwa_14, gen3):
        model, tool = build(*arm())
        data = model.createData()
        random = np.random.default_rng(560)
        with open(HERE / "data" / "library" / f"{arm.__name__}.jsonl", "w") as out:
            for _ in range(CONFIGURATIONS):
                q, qd, qdd = random.uniform(-1.0, 1.0, (3, model.nv)) * [[math.pi], [2.0], [5.0]]
                pin.framesForwardKinematics(model, data, q)
                values = {
                    "q": q,
                    "qd": qd,
                    "qdd": qdd,
                    "pose": data.oMf[tool].homogeneous[:3].ravel(),
                    "mass_matrix": pin.crba(model, data, q)[np.triu_indices(model.nv)],
                    "inverse_dynamics": pin.rnea(model, data, q, qd, qdd),
                    "gravity_torque": pin.computeGeneralizedGravity(model, data, q),
                }
                json.dump({name: list(map(float, value)) for name, value in values.items()}, out, separators=(",", ":"))
                out.write("\n")
        print(f"{arm.__name__}: {CONFIGURATIONS} configurations")


if __name__ == "__main__":
    main()
