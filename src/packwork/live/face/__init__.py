"""What faces with a page need of all below: things read, poured, drawn and written."""
