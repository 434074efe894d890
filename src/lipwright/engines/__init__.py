"""Engines: from speech to controls over time."""
