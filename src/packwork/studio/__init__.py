"""The studio: a page, served from this machine, on which a layout flows while it is worked on."""
