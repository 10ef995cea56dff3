"""The paper's evaluation, re-run."""
