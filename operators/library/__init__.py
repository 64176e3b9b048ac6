"""The library: expressions and timelines as preset files, and .fap files, on any face."""
