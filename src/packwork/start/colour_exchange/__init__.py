"""Items exchanged until what is seen from afar is nearest to a picture."""
