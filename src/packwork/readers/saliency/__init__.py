"""Pictures to containers: the part of them in which little is to be seen."""
