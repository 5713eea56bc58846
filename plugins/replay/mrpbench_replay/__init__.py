"""A run as one HTML file that plays it back in any browser, and as a GIF."""
