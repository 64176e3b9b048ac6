"""The emotion: word, variant, activation."""
