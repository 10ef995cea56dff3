"""Pages of docs anew from their manifests."""
