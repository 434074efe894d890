"""The neural engine: short-time spectra in, any controls out, by a small net.

Follows T. Frank, M. Hoch, G. Trogemann, *Automated Lip-Sync for 3D-Character Animation*
(DESIGN section 6). It hears sound alone: no words, no phones.
"""
