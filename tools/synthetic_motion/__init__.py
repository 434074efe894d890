"""Makes the built-in motion database: takes of no face, spoken and moved by code."""
