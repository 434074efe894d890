"""Makes the default English bigram set from phonetic knowledge (DESIGN section 4)."""
