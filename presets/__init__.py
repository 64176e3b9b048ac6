"""Presets: TOML tables a user may copy and edit. No code lives here; the format is in docs/formats.md."""
