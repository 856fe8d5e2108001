/* The sub-view Machine, below: what the machine has besides heaters, fans and axes. */
