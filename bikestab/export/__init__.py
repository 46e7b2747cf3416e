"""Meshes and tables for other programs."""
