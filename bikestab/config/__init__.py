"""What a scan's config is, and how it is read from YAML."""
