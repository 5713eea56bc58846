"""The search for runs that break a property, and for the smallest one of each kind."""
