/* The sub-view Model: the whole object model as a tree. */
