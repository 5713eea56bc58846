"""Tables of estimates: made once, written as text, Markdown, LaTeX, CSV, HTML or JSON."""
