"""Fixtures of the studio's tests."""

from tests.studio.made import desk

__all__ = ["desk"]
