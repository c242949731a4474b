"""Records, `Document`, `Diff` and `evaluate`: what hair is, apart from how it was made or is shown."""
