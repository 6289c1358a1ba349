"""What a controller does that geometry cannot tell: the parameters of the motion model."""
