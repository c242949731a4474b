"""The statistical head: landmarks, fitting, scalp."""
