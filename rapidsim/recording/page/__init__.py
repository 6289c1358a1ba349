"""A recording as a web page that opens without a server: viewer and data in one file."""
