"""Words to regions: fonts, their letters, and how those are set in lines."""
