"""A config → its volume: cut into tiles, computed, kept, put together, checked."""
