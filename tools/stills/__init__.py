"""Stills of characters that say the same line, side by side: ``python -m tools.stills``."""
