"""A board behind a single-board computer: what Duet Software Framework (DSF) serves."""
