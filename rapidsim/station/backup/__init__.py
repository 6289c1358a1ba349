"""Reads the station from a controller backup."""
