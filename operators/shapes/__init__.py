"""Shape keys with the names that engines and trackers know.

ops      make the shape keys
props    which are made
"""
