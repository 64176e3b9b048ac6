"""Reading what a face shows: beliefs in emotions, FAPs and features, now and over time."""
