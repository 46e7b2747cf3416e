"""The (λ, σ) plane: where stable intervals appear, vanish or change, and the surface above it."""
