"""Runs of jobs: whole programs, single routines, sweeps, the question protocol."""
