"""The choice between candidates by a race on paired seeds."""
