"""Commands: small frozen values, one a gesture or edit, that make one document of another."""
