"""Words: set in fonts, coloured by data, none smaller than it may be."""
