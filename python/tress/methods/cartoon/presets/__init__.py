"""Hairdos of clumps: surfaces laid over the head by code. A new one is its file and a line in `registry`."""
