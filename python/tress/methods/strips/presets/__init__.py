"""Hairdos made of edits, one a file. A new one is its file and a line in `registry`."""
