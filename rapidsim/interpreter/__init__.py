"""Program to running code: code objects, memory, error handling; knows no robot."""
