"""What happens under the skin, drawn over the face: muscles, strain, paths."""
