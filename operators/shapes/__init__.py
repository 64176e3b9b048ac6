"""Shape keys with the names that engines and trackers know."""
