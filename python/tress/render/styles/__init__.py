"""Shading styles: `shade(gbuffer, scene, params)`, one a file."""
