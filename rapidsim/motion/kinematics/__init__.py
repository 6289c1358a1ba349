"""Forward and inverse kinematics: the protocol of an arm, and what all arms share."""
