"""Controller on the network: Robot Web Services as the frontend of a controller that stays on."""
