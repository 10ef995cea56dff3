"""DXFs of CAD programs: entities to lines, lines to rings, rings to items."""
