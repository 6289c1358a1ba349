"""Output of kin, follow, frames and robots."""
