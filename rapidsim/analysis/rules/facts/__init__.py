"""Derived facts about a program that rules share."""
