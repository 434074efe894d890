"""Bigram curves learnt from recorded faces."""

from lipwright.engines.bigram.fit.fitting import FitReport, fit_set
from lipwright.engines.bigram.fit.takes import FaceTake

__all__ = ["FaceTake", "FitReport", "fit_set"]
