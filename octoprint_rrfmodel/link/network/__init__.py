"""A board that hangs on the network; OctoPrint 2.0 alone can have one."""
