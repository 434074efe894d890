"""The studio: an editor of bigram sets and lines, in the browser (Xu et al. 2013, Figures 3 to 10).

:mod:`~lipwright.studio.messages` is what server and page say to each other;
:mod:`~lipwright.studio.session` is what is open, with no network in it;
:mod:`~lipwright.studio.server` carries the one to the other. Nothing of the animation is
computed here: it is the same engine as everywhere.
"""
