"""What every room needs: errors, reports and parameters. Imports nothing of Tress."""
