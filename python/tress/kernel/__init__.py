"""Typed, documented wrappers over the compiled core. Shapes and dtypes are checked here and nowhere below."""
