"""A robot as a product: kinematics with limits, names, external axes; catalogue and URDF."""
