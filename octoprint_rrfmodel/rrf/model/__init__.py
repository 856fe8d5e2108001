"""The object model: its grammar, how replies change it, the snapshot."""
