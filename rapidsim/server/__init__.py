"""A controller over the network: Robot Web Services in front of a controller that stays on."""
