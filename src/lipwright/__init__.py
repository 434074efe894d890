"""Lipwright turns speech, typed or recorded, into editable facial animation."""
