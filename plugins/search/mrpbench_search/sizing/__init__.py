"""The smallest fleet that serves a stream of orders."""
