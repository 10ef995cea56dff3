"""Words as fonts shape them: letters that join, marks that stack, any direction."""
