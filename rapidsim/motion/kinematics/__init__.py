"""Joints to flange and back: the protocol of an arm, and what all arms share."""
