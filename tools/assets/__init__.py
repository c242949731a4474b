"""Builds the assets of `tress.head` from two wheels: `python -m tools.assets`."""
