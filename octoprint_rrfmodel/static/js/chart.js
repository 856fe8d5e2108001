/* The sub-view Chart: an hour of temperatures. */
