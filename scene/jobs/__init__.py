"""Whole jobs for the command line: from words (`jobs`), from a FAP stream (`playing`), on any head (`subjects`)."""
