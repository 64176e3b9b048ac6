"""Parts of the face's mesh: told apart, shown as colours, corrected by vertex groups."""
