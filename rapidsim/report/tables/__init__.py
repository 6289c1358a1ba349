"""What kin, follow, frames and robots print."""
