"""Built-in crowds."""
