"""Requests of users, and the job that each becomes."""
