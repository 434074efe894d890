"""Labels that others made: one module per format."""
