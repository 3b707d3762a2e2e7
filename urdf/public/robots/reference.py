"""A chain of a description by Pinocchio, from the description itself, and what the description says of its joints."""

import math
import xml.etree.ElementTree as ElementTree

import numpy as np
import pinocchio as pin

GRAVITY = np.array([0.0, 0.0, -9.81])
# Of Coulomb's friction, rad/s: a description has no word for it.
SMOOTHING = 1e-3


class Reference:
    """The joints named `joints`, all others held at 0, or at their offset if they mimic one that is; the frame of the link `base` as world,
    that of the link `tip` as tool, gravity along the base's -z. What hangs on the links of `dropped` is left out."""

    def __init__(self, description: str, base, tip, joints, dropped=()):
        robot = ElementTree.fromstring(description)
        for link in dropped:
            prune(robot, link)
        self.joints = [next(joint for joint in robot.iter("joint") if joint.get("name") == name) for name in joints]
        whole = pin.buildModelFromXML(ElementTree.tostring(robot, encoding="unicode"))
        for name in joints:
            if not whole.existJointName(name):
                raise ValueError(f"Pinocchio knows no joint {name}")
        held = [number for number in range(1, whole.njoints) if whole.names[number] not in joints]
        self.model = pin.buildReducedModel(whole, held, rest(whole, robot))
        # q of ours are the joints in the order of the chain.
        if [self.model.names[number] for number in range(1, self.model.njoints)] != list(joints):
            raise ValueError(f"Pinocchio's order is {list(self.model.names)[1:]}, the table's {list(joints)}")
        self.base, self.tip = (frame(self.model, link) for link in (base, tip))
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
        jacobian = pin.computeFrameJacobian(model, data, q, self.tip, pin.LOCAL_WORLD_ALIGNED)
        mass_matrix = np.triu(pin.crba(model, data, q))
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


def rest(model, robot):
    """Every joint at 0. One that mimics another is where the other's 0 puts it, at its offset."""
    q = pin.neutral(model)
    for joint in robot.iter("joint"):
        mimic = joint.find("mimic")
        if mimic is not None and model.existJointName(joint.get("name")):
            v = np.zeros(model.nv)
            v[model.joints[model.getJointId(joint.get("name"))].idx_v] = float(mimic.get("offset", 0.0))
            q = pin.integrate(model, q, v)
    return q


def frame(model, link):
    if not model.existFrame(link, pin.FrameType.BODY):
        raise ValueError(f"Pinocchio knows no link {link}")
    return model.getFrameId(link, pin.FrameType.BODY)


def prune(robot, link):
    """Takes out a link, the joint that it hangs on, and all beyond it."""
    for joint in list(robot.findall("joint")):
        if joint.find("child").get("link") == link:
            robot.remove(joint)
        elif joint.find("parent").get("link") == link:
            prune(robot, joint.find("child").get("link"))
    for found in list(robot.findall("link")):
        if found.get("name") == link:
            robot.remove(found)


def number(joint, element, attribute):
    """None where the description has no such element or attribute."""
    found = joint.find(element)
    text = None if found is None else found.get(attribute)
    return None if text is None else float(text)
