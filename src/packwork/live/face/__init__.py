"""Services for faces with a page: things read, poured, drawn and written."""
