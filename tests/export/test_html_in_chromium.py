"""The HTML page, as a user has it: opened from disk in Chromium."""

from __future__ import annotations



