/* What is told once when it begins, and taken back when it is over. */
