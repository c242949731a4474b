"""Edits: pure functions from a `Document` to a `Diff`."""
