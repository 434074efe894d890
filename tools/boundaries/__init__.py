"""Learns where phones meet from synthesised speech, whose times are exact (DESIGN 10)."""
