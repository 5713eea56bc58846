"""The results folder: records, invocations and recordings on disk."""
