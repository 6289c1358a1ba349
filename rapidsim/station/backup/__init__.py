"""Read the station from a controller backup."""
