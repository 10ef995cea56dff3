"""What a gesture reaches: its neighbourhood flows, and is finished exactly among all others."""
