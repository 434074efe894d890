"""The motion engine: speech motion from segments of recorded takes (DESIGN section 5).

After Cao, Faloutsos, Kohler, Pighin: *Real-time Speech Motion Synthesis from Recorded
Motions* (SCA 2004). Capture → takes → database and graph → search → joining → motion.
"""
