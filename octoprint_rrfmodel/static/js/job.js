/* The sub-view Job: the board's own print. */
