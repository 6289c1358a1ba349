"""The virtual controller: tasks on one clock, path queue, files; joins program and motion."""
