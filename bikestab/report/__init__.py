"""One interactive page of volumes, for a browser without any network."""
