"""Almost clean layouts to exactly clean ones: compaction by linear programmes."""
