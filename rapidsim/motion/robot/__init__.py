"""An arm one can buy: kinematics with limits, names, external axes; catalogue and URDF."""
