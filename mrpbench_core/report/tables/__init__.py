"""Tables of estimates, and their text as Markdown and LaTeX."""
