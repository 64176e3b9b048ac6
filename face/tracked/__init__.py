"""What trackers saw: points become FAPs in that person's own units (`landmarks`); files of any format (`captured`)."""
