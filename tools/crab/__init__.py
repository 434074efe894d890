"""Makes the crab's bigram set, in its own poses (DESIGN sections 4 and 7)."""
