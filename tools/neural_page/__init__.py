"""The publication's experiment with the neural engine, on recordings: a page with its figures."""
