"""Export of a recording as a web page: viewer and data in one file."""
