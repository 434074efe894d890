"""The tables and the figure of Cao et al. 2004 on recordings, as a page of the documentation."""
