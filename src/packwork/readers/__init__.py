"""Files to items and containers; the gate stands before every parser."""
