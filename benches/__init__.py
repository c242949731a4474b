"""Speed (`python -m benches`) and quality (`python -m benches.eval`)."""
