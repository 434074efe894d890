"""Makes the Mandarin bigram set: the English one and the pairs of ü (DESIGN section 3)."""
