"""Makes the pictures of README and documentation: `make pictures`."""
