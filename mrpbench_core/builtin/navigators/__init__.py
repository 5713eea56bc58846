"""How robots follow what is released to them."""
