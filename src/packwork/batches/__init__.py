"""Many runs: a recipe for each row of a table, on all cores, gone on with where they ended."""
