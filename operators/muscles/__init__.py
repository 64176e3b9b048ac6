"""Muscles: how far each is contracted, some of them by the user's own hand; and what the skin is made of."""
