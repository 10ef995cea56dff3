"""The same work given to what people use today."""
