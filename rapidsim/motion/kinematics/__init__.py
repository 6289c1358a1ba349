"""Forward and inverse kinematics: the protocol of an arm, and the code all arms share."""
