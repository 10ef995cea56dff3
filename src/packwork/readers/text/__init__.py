"""Words to containers: letters that stand apart, set in lines."""

PREFIX = "text:"
"""What a container made of words begins with."""
