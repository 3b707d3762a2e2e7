"""A chain of a description by Pinocchio, from the description itself, and what the description says of its joints."""

import math
import xml.etree.ElementTree as ElementTree

import numpy as np
import pinocchio as pin

GRAVITY = np.array([0.0, 0.0, -9.81])
# Of Coulomb's friction, rad/s: a description has no word for it.
SMOOTHING = 1e-3


class Reference:
    """The joints between the links `base` and `tip` that move and mimic no other; all others held at 0, or where what they mimic puts them.
    The base's frame is the world, the tip's the tool, gravity is along the base's -z. The links of `dropped` are left out, with all on them."""

    def __init__(self, description: bytes, base, tip, dropped=()):
        robot = ElementTree.fromstring(description)
        for link in dropped:
            prune(robot, link)
        self.joints = [joint for joint in path(robot, base, tip) if joint.get("type") != "fixed" and joint.find("mimic") is None]
        self.names = [joint.get("name") for joint in self.joints]
        rename_links(robot)
        whole = pin.buildModelFromXML(ElementTree.tostring(robot, encoding="unicode"))
        held = [number for number in range(1, whole.njoints) if whole.names[number] not in self.names]
        self.model = pin.buildReducedModel(whole, held, rest(whole, robot))
        if list(self.model.names)[1:] != self.names:
            raise ValueError(f"Pinocchio's order is {list(self.model.names)[1:]}, the chain's {self.names}")
        self.base, self.tip = (frame(self.model, f"link {name}") for name in (base, tip))
        data = self.model.createData()
        pin.framesForwardKinematics(self.model, data, pin.neutral(self.model))
        self.world_from_base = data.oMf[self.base].copy()
        self.model.gravity.linear = self.world_from_base.rotation @ GRAVITY

    def values(self, q, qd, qdd):
        """What `evaluate` prints, by Pinocchio."""
        model, data = self.model, self.model.createData()
        q = pin.integrate(model, pin.neutral(model), q)
        pin.framesForwardKinematics(model, data, q)
        turned = self.world_from_base.rotation.T
        # Of a single joint Pinocchio's matrices have lost a dimension.
        jacobian = pin.computeFrameJacobian(model, data, q, self.tip, pin.LOCAL_WORLD_ALIGNED).reshape(6, model.nv)
        mass_matrix = np.triu(pin.crba(model, data, q).reshape(model.nv, model.nv))
        return {
            "pose": (self.world_from_base.inverse() * data.oMf[self.tip]).homogeneous[:3],
            "jacobian": np.vstack([turned @ jacobian[:3], turned @ jacobian[3:]]),
            "mass_matrix": mass_matrix + np.triu(mass_matrix, 1).T,
            "inverse_dynamics": pin.rnea(model, data, q, qd, qdd) + self.friction(qd),
            "gravity_torque": pin.computeGeneralizedGravity(model, data, q),
        }

    def friction(self, qd):
        """Of the description's own words; Pinocchio's inverse dynamics leaves it out."""
        torques = []
        for joint, rate in zip(self.joints, qd):
            viscous, coulomb = (number(joint, "dynamics", word) or 0.0 for word in ("damping", "friction"))
            torques.append(viscous * rate + coulomb * rate / math.hypot(rate, SMOOTHING))
        return np.array(torques)

    def states(self, how_many):
        """Random q, qd, qdd: a turn to each side, or a metre; rates and accelerations up to 1."""
        random = np.random.default_rng(2010)
        reach = np.array([1.0 if joint.get("type") == "prismatic" else math.pi for joint in self.joints])
        states = random.uniform(-1.0, 1.0, (how_many, 3, self.model.nv))
        states[:, 0] *= reach
        return states


def path(robot, base, tip):
    """The joints from one link out to another."""
    above = {joint.find("child").get("link"): joint for joint in robot.findall("joint")}
    joints = []
    while tip != base:
        if tip not in above:
            raise ValueError(f"no joints lead from {base} to {tip}")
        joints.append(above[tip])
        tip = above[tip].find("parent").get("link")
    return joints[::-1]


def rename_links(robot):
    """A joint may be called as a link is; Pinocchio takes both for frames, and cannot tell them apart."""
    for link in robot.findall("link"):
        link.set("name", f"link {link.get('name')}")
    for joint in robot.findall("joint"):
        for end in (joint.find("parent"), joint.find("child")):
            end.set("link", f"link {end.get('link')}")


def rest(model, robot):
    """Every joint at 0. One that mimics another is where the other's place puts it."""
    mimics = {joint.get("name"): joint.find("mimic") for joint in robot.findall("joint")}

    def coordinate(name, depth=0):
        mimic = mimics.get(name)
        if mimic is None or depth > len(mimics):
            return 0.0
        return float(mimic.get("multiplier", 1.0)) * coordinate(mimic.get("joint"), depth + 1) + float(mimic.get("offset", 0.0))

    v = np.zeros(model.nv)
    for number in range(1, model.njoints):
        if model.joints[number].nv == 1:
            v[model.joints[number].idx_v] = coordinate(model.names[number])
    return pin.integrate(model, pin.neutral(model), v)


def frame(model, link):
    if not model.existFrame(link, pin.FrameType.BODY):
        raise ValueError(f"Pinocchio knows no link {link}")
    return model.getFrameId(link, pin.FrameType.BODY)


def prune(robot, link):
    """Takes out a link, the joint that it hangs on, and all beyond it."""
    for joint in robot.findall("joint"):
        if joint.find("child").get("link") == link:
            robot.remove(joint)
        elif joint.find("parent").get("link") == link:
            prune(robot, joint.find("child").get("link"))
    for found in robot.findall("link"):
        if found.get("name") == link:
            robot.remove(found)


def number(joint, element, attribute):
    """None where the description has no such element or attribute."""
    found = joint.find(element)
    text = None if found is None else found.get(attribute)
    return None if text is None else float(text)
