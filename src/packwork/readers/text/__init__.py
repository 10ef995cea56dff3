"""Words to regions: fonts, their letters, and how those are set in lines."""

PREFIX = "text:"
"""What a container made of words begins with."""
