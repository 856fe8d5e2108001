/* The first-run wizard. */
