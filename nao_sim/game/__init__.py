"""The imitation game: sessions, turns, scores, agreement, statistics, report (thesis, appendix 4)."""
