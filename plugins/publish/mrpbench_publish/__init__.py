"""Published results: `files` is the format of bundles, `bundles` writes and verifies them, `site` shows them."""
