"""Schedules: who says when each phone sounds. One module per source."""
