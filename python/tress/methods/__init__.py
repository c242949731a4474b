"""Ways to make hair: each method returns a `Diff` on a `Document`."""
