"""The comparison of two candidates on a published protocol."""
