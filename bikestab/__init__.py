"""Where a bicycle or motorcycle runs straight by itself: the region of stable (λ, σ, V)."""

__version__ = "0.1.0"
