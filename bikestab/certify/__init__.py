"""Proofs over boxes of designs, speeds and parameters: everywhere stable, nowhere stable, or undecided."""
