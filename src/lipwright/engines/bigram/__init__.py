"""The bigram engine (Xu et al. 2013; DESIGN section 4)."""
