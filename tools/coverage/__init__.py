"""Makes docs/coverage.md: which pairs English needs, beside the published figures."""
