"""Sessions in files: documents, what they are made of, and what came after."""
