"""`rapidsim kin`: forward and inverse kinematics and the Jacobian of one pose."""
