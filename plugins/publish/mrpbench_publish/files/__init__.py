"""Bundles: published results as one zip file, a BagIt bag (RFC 8493) whose payload is an RO-Crate."""
