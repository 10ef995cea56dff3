"""What benchmarks share: the frozen set, runs, medians, manifests."""
